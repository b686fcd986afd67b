// SPDX-License-Identifier: Apache-2.0
#ifndef TYNDALL_CORE_FRAME_GLSL
#define TYNDALL_CORE_FRAME_GLSL

#include "core/numerics.glsl"

/// Right-handed orthonormal columns (tangent, bitangent, axis) about a unit `axis`. [Duff17] "Building an
/// Orthonormal Basis, Revisited", JCGT 6(1), listing 3.
mat3 frameAbout(vec3 axis) {
  const float s = axis.z >= 0.0 ? 1.0 : -1.0;
  const float a = -1.0 / (s + axis.z);
  const float b = axis.x * axis.y * a;
  const vec3 tangent = vec3(1.0 + s * axis.x * axis.x * a, s * b, -s * axis.x);
  const vec3 bitangent = vec3(b, s + axis.y * axis.y * a, -axis.y);
  return mat3(tangent, bitangent, axis);
}

/// Unit direction at polar angle theta about a unit `axis` with azimuth 2 pi `turns`. Takes 1 - cos theta in [0, 2]:
/// near the axis the cosine itself has lost the angle.
vec3 directionAbout(vec3 axis, float oneMinusCos, float turns) {
  const float sinTheta = safeSqrt(oneMinusCos * (2.0 - oneMinusCos));
  const vec2 azimuth = cosSinTurns(turns);
  return frameAbout(axis) * vec3(sinTheta * azimuth, 1.0 - oneMinusCos);
}

/// 1 - cos of the angle between two unit vectors, by their difference: relative error stays small at small angles.
float oneMinusCosBetween(vec3 a, vec3 b) {
  const vec3 difference = a - b;
  return 0.5 * dot(difference, difference);
}

#endif

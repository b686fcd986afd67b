// SPDX-License-Identifier: Apache-2.0
// Uniform points on simple sets, each beside its pdf. xi are uniform in [0, 1).
#ifndef TYNDALL_CORE_WARP_GLSL
#define TYNDALL_CORE_WARP_GLSL

#include "core/frame.glsl"

vec3 uniformSphereSample(vec2 xi) { return directionAbout(vec3(0.0, 0.0, 1.0), 2.0 * xi.x, xi.y); }
/// [1/sr]
float uniformSpherePdf() { return kInvFourPi; }

/// Directions within a cone about a unit `axis`, uniform in solid angle. `oneMinusCosMax` = 1 - cos of the half
/// angle, in (0, 2]; take it as 2 sin^2(half angle / 2), in double on the host for narrow cones.
vec3 uniformConeSample(vec3 axis, float oneMinusCosMax, vec2 xi) {
  return directionAbout(axis, oneMinusCosMax * xi.x, xi.y);
}
/// [1/sr] inside the cone.
float uniformConePdf(float oneMinusCosMax) { return kInvTwoPi / oneMinusCosMax; }
/// Whether `w` lies in the cone; both unit. Float directions resolve about 1e-7 radians.
bool insideCone(vec3 axis, float oneMinusCosMax, vec3 w) { return oneMinusCosBetween(axis, w) <= oneMinusCosMax; }

/// Uniform in the unit disc.
vec2 uniformDiscSample(vec2 xi) { return sqrt(xi.x) * cosSinTurns(xi.y); }
/// Per unit area.
float uniformDiscPdf() { return kInvPi; }

/// Directions on the side of +z with density proportional to their cosine.
vec3 cosineHemisphereSample(vec2 xi) { return vec3(uniformDiscSample(xi), sqrt(1.0 - xi.x)); }
/// [1/sr] for cosine = z >= 0.
float cosineHemispherePdf(float cosine) { return cosine * kInvPi; }

#endif

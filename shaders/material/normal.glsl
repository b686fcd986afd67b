// SPDX-License-Identifier: Apache-2.0
#ifndef TYNDALL_MATERIAL_NORMAL_GLSL
#define TYNDALL_MATERIAL_NORMAL_GLSL

/// The world-space unit normal to shade by. `worldFromTangent` has the columns tangent, bitangent and interpolated
/// normal; `normalTangent` from a normal map, (0, 0, 1) without; `wo` unit, away from the surface.
/// A normal that turns away from wo although the surface itself (`geometricNormal`, unit) does not, or the reverse,
/// would show a surface's other side. It is pushed along wo until its cosine with wo is 0.01, or the geometric normal's
/// where that is less: the nearest such normal, continuous in all arguments, and none that was right is changed.
vec3 perturbNormal(vec3 normalTangent, mat3 worldFromTangent, vec3 geometricNormal, vec3 wo) {
  const vec3 sum = worldFromTangent * normalTangent;
  const float squared = dot(sum, sum);
  const vec3 normal = squared > 1e-20 ? sum * inversesqrt(squared) : geometricNormal;
  const float geometricCosine = dot(geometricNormal, wo);
  const vec3 seen = geometricCosine < 0.0 ? -wo : wo; // the geometric normal's side of the line of sight
  const float lacking = min(0.01, abs(geometricCosine)) - dot(normal, seen);
  if (!(lacking > 0.0)) {
    return normal;
  }
  const vec3 pushed = normal + lacking * seen;
  const float pushedSquared = dot(pushed, pushed);
  return pushedSquared > 1e-20 ? pushed * inversesqrt(pushedSquared) : geometricNormal;
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Directions on a square: the octahedron |x| + |y| + |z| = 1 unfolded about +z, its lower half outwards (Meyer et al.
// 2010). Opposite halves of each edge of the square are the same directions, so that a table whose outermost nodes lie
// on the edges is continuous across them.
#ifndef TYNDALL_CORE_OCTAHEDRAL_GLSL
#define TYNDALL_CORE_OCTAHEDRAL_GLSL

vec2 signNotZero(vec2 v) { return mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v, vec2(0.0))); }

/// Place in [-1, 1]^2 of a direction of any length; the middle for a zero vector.
vec2 octahedralFromDirection(vec3 direction) {
  const float sum = abs(direction.x) + abs(direction.y) + abs(direction.z);
  const vec2 place = direction.xy / max(sum, 1e-30);
  return direction.z >= 0.0 ? place : (1.0 - abs(place.yx)) * signNotZero(place);
}

/// Unit direction of a place in [-1, 1]^2.
vec3 directionFromOctahedral(vec2 place) {
  const float z = 1.0 - abs(place.x) - abs(place.y);
  const vec2 xy = z >= 0.0 ? place : (1.0 - abs(place.yx)) * signNotZero(place);
  return normalize(vec3(xy, z));
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Optical depth towards a light by interpolation between the nodes of a LightCache. An approximation inside the grid:
// estimators use it as a control variate and correct it by an exact walk.
#ifndef TYNDALL_LIGHT_CACHE_GLSL
#define TYNDALL_LIGHT_CACHE_GLSL

#include "core/octahedral.glsl"
#include "interop/light_cache.h"
#include "medium/shape.glsl"

// A column of nodes in voxel space: node j lies at origin + j * step.
struct LightColumn {
  vec3 origin;
  vec3 step;
};

LightColumn lightCacheColumn(LightCache cache, ivec2 node) {
  LightColumn column;
  const vec2 ab = vec2(node);
  if (cache.kind == kCacheOctahedral) {
    const vec3 direction = directionFromOctahedral(2.0 * ab / vec2(cache.count.xy - 1) - 1.0);
    column.origin = cache.origin0 + cache.firstRadius * direction;
    column.step = cache.radiusStep * direction;
  } else {
    column.origin = cache.origin0 + ab.x * cache.originA + ab.y * cache.originB;
    column.step = cache.step0 + ab.x * cache.stepA + ab.y * cache.stepB;
  }
  return column;
}

// Lattice coordinates (a, b, j) of a point in voxel space.
vec3 lightCachePlace(LightCache cache, vec3 voxelPoint) {
  if (cache.kind == kCacheOctahedral) {
    const vec3 offset = voxelPoint - cache.origin0;
    const vec2 square = octahedralFromDirection(offset);
    return vec3((0.5 * square + 0.5) * vec2(cache.count.xy - 1),
                (length(offset) - cache.firstRadius) / cache.radiusStep);
  }
  const vec4 place = cache.latticeFromVoxel * vec4(voxelPoint, 1.0);
  return vec3(place.xy / place.w, place.z);
}

// Optical depth between the light and a point inside the grid's bounds: trilinear between nodes.
float lightCacheDepth(LightCache cache, vec3 voxelPoint) {
  const vec3 place = clamp(lightCachePlace(cache, voxelPoint), vec3(0.0), vec3(cache.count - 1));
  const ivec3 node = min(ivec3(place), cache.count - 2);
  const vec3 f = place - vec3(node);
  const uint b = uint(cache.count.x);
  const uint j = b * uint(cache.count.y);
  const uint first = uint(node.x) + b * uint(node.y) + j * uint(node.z);
  const vec4 low = vec4(cache.depths.at[first], cache.depths.at[first + b], cache.depths.at[first + j],
                        cache.depths.at[first + j + b]);
  const vec4 high = vec4(cache.depths.at[first + 1u], cache.depths.at[first + b + 1u], cache.depths.at[first + j + 1u],
                         cache.depths.at[first + j + b + 1u]);
  const vec4 alongA = mix(low, high, f.x);
  const vec2 alongB = mix(alongA.xz, alongA.yw, f.y);
  return mix(alongB.x, alongB.y, f.z);
}

// Optical depth of the grid between any world-space point and the light `distance` away along the unit `toLight`
// (kInfiniteDistance: a sun). A point outside the bounds has the depth of where its ray to the light enters them.
float lightDepthFrom(CellGrid grid, LightCache cache, vec3 worldPoint, vec3 toLight, float distance) {
  const vec3 origin = grid.voxelFromWorld * vec4(worldPoint, 1.0);
  const vec3 direction = mat3(grid.voxelFromWorld) * toLight;
  const vec2 interval = boxInterval(origin, direction, grid.boundsMin, grid.boundsMax, distance);
  if (interval.x >= interval.y) {
    return 0.0;
  }
  // Held inside: far from the grid the entry point is rounded coarsely.
  return lightCacheDepth(cache, clamp(origin + interval.x * direction, grid.boundsMin, grid.boundsMax));
}

#endif

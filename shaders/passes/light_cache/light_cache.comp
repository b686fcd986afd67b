#version 460
// SPDX-License-Identifier: Apache-2.0
// Walks a column of a light cache from the light's side and writes the optical depth at each node; light_cache_io.h is
// the contract. Within a cell the depth is the closed-form integral of the field's cubic, so that nodes are exact.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "light/cache.glsl"
#include "light_cache_io.h"
#include "tracker/cells.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { LightCacheInputs io; };

void main() {
  if (gl_GlobalInvocationID.x >= io.columnCount) {
    return;
  }
  LightCache cache = io.caches.at[io.cache];
  CellGrid grid = io.grids.at[cache.grid];
  const uint index = io.firstColumn + gl_GlobalInvocationID.x;
  const uint plane = uint(cache.count.x) * uint(cache.count.y);
  const uint width = uint(cache.count.x);
  const LightColumn column = lightCacheColumn(cache, ivec2(index % width, index / width));
  // The walk's t counts nodes.
  const float depthPerNode = cache.sigmaT * length(mat3(cache.worldFromVoxel) * column.step);
  CellWalk walk = cellWalkBegin(grid, column.origin, column.step, 0.0, kInfiniteDistance);
  float depth = 0.0;
  float t = walk.tEnter;
  int j = 0;
  bool inside = walk.tEnter < walk.tLeave;
  [[dont_unroll]] while (inside && j < cache.count.z) {
    const CellStep look = cellLook(walk, grid);
    const float tExit = max(look.tExit, t);
    const bool empty = look.block == kEmptyBrick;
    const vec4 cubic = empty ? vec4(0.0) : cellCubic(walk, grid, look.block, t, tExit);
    const float scale = depthPerNode * (tExit - t);
    [[dont_unroll]] while (j < cache.count.z && float(j) < tExit) {
      const float fraction = max((float(j) - t) / (tExit - t), 0.0); // 0: before the grid
      cache.depths.at[index + uint(j) * plane] = depth + scale * cubicIntegral(cubic, fraction);
      ++j;
    }
    depth += scale * cubicIntegral(cubic, 1.0);
    t = tExit;
    inside = cellStep(walk, grid, look);
  }
  [[dont_unroll]] for (; j < cache.count.z; ++j) { cache.depths.at[index + uint(j) * plane] = depth; }
}

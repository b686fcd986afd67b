#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/bench/bench_io.h"

layout(constant_id = 0) const uint kFormatMask = 7u;

#include "medium/atlas.glsl"
#include "medium/shape.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { BareLookupInputs io; };

void main() {
  const uint invocation = gl_GlobalInvocationID.x;
  if (invocation >= io.count) {
    return;
  }
  const uint packed = io.pixels.at[invocation];
  const uvec2 pixel = uvec2(packed & 0xffffu, packed >> 16);
  Rng rng = rngSeed(pixel, 0u, 0u);
  Grid grid = io.scene.at[0].grids.at[0];
  Camera camera = io.scene.at[0].camera;
  const vec2 raster = (vec2(pixel) + 0.5) / vec2(io.scene.at[0].imageSize);
  const vec3 direction = normalize(camera.corner + raster.x * camera.rasterX + raster.y * camera.rasterY);
  const vec3 origin = grid.voxelFromWorld * vec4(camera.origin, 1.0);
  const vec3 step = mat3(grid.voxelFromWorld) * direction;
  const vec2 interval = boxInterval(origin, step, grid.boundsMin, grid.boundsMax, kInfiniteDistance);
  if (interval.x >= interval.y) {
    io.sums.at[invocation] = 0.0;
    return;
  }
  const float scale = io.meanStep / length(step);
  float t = interval.x;
  float sum = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < io.lookups; ++i) {
    t += -log1pAccurate(-rngFloat(rng)) * scale;
    t = t >= interval.y ? interval.x : t;
    const vec3 point = clamp(origin + t * step, vec3(0.0), vec3(grid.brickCount * kBrickEdge) - 1.0);
    sum += gridOneTap(grid, ivec3(point) / kBrickEdge, point, rng);
  }
  io.sums.at[invocation] = sum;
}

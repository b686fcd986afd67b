#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/bench/lane_io.h"

#include "core/sobol.glsl"
#include "tracker/cells.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { LaneInputs io; };

void main() {
  const uint invocation = gl_GlobalInvocationID.x;
  if (invocation >= io.count) {
    return;
  }
  const uint packed = io.pixels.at[invocation];
  const uvec2 pixel = uvec2(packed & 0xffffu, packed >> 16);
  Camera camera = io.scene.at[0].camera;
  CellGrid grid = io.march.at[0].grids.at[0];
  float sum = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < io.samples; ++i) {
    const Sobol sobol = sobolBegin(pixel, i, io.seed);
    const vec2 raster = (vec2(pixel) + vec2(sobolFloat(sobol, 0u), sobolFloat(sobol, 1u))) / vec2(io.scene.at[0].imageSize);
    const vec3 direction = normalize(camera.corner + raster.x * camera.rasterX + raster.y * camera.rasterY);
    uint steps = 0u;
    sum += cellOpticalDepth(grid, 1.0, camera.origin, direction, vec2(0.0, kInfiniteDistance), kInfiniteDistance, steps);
    io.uses.at[invocation * io.samples + i] = LaneUse(steps, 0u);
  }
  io.sums.at[invocation] = sum;
}

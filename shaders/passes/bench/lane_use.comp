#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/bench/lane_io.h"

#define SPEC(type, name, id, value) layout(constant_id = id) const type name = value;
TYNDALL_MARCH_SPEC(SPEC)
#undef SPEC
const uint kFormatMask = 0u; // no atlas is read

#include "passes/march/ray.glsl"

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
  loadScene(io.scene, io.march);
  float sum = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < io.samples; ++i) {
    const Sobol sobol = sobolBegin(pixel, i, io.seed);
    Rng rng = rngSeed(pixel, i, io.seed);
    const vec2 offset = vec2(sobolFloat(sobol, kDimPixel), sobolFloat(sobol, kDimPixel + 1u));
    const vec2 raster = (vec2(pixel) + offset) / vec2(io.scene.at[0].imageSize);
    const vec3 direction = normalize(camera.corner + raster.x * camera.rasterX + raster.y * camera.rasterY);
    const MarchResult result = marchRay(io.scene, io.march, camera.origin, direction, sobol, rng);
    io.uses.at[invocation * io.samples + i] = LaneUse(result.steps, result.cells);
    sum += result.scattered.x;
  }
  io.sums.at[invocation] = sum;
}

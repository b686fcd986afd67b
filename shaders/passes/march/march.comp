#version 460
// SPDX-License-Identifier: Apache-2.0
// The pass `march`; its contract is march_io.h, its light transport ray.glsl.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/march/march_io.h"

#define SPEC(type, name, id, value) layout(constant_id = id) const type name = value;
TYNDALL_MARCH_SPEC(SPEC)
#undef SPEC
const uint kFormatMask = 0u; // no atlas is read

#include "passes/march/pixel.glsl"
#include "passes/march/ray.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { MarchInputs io; };

vec3 cameraOrigin(Camera camera, vec2 raster) {
  return kOrthographic ? camera.origin + raster.x * camera.rasterX + raster.y * camera.rasterY : camera.origin;
}

vec3 cameraDirection(Camera camera, vec2 raster) {
  const vec3 offset = raster.x * camera.rasterX + raster.y * camera.rasterY;
  return normalize(kOrthographic ? camera.corner : camera.corner + offset);
}

vec2 pixelOffset(Sobol sobol) { return vec2(sobolFloat(sobol, kDimPixel), sobolFloat(sobol, kDimPixel + 1u)); }

// Adds a finished sample to the batch. A sample that is not finite is dropped and counted.
void addSample(inout PixelSums sums, MarchResult result, vec3 direction) {
  vec3 background = vec3(0.0);
  if (kBackground && result.transmittance > 0.0) {
    background = result.transmittance * distantBackground(io.scene, direction);
  }
  const vec3 total = result.scattered + background;
  if (!isFinite(total) || !isFinite(result.transmittance) || !isFinite(result.depth)) {
    atomicAdd(io.counters.at[0].nonFinite, 1u);
    return;
  }
  for (int c = 0; c < 3; ++c) {
    sums.moments[c] += result.scattered[c];
    sums.extras[c] += background[c];
    sums.extras[5 + c] += result.albedo[c];
  }
  sums.moments[3] += result.transmittance;
  sums.extras[3] += result.depth;
  sums.extras[4] += result.opacity;
}

void main() {
  const uint invocation = gl_GlobalInvocationID.x;
  if (invocation >= io.count) {
    return;
  }
  const uint packed = io.pixels.at[invocation];
  const uvec2 pixel = uvec2(packed & 0xffffu, packed >> 16);
  Camera camera = io.scene.at[0].camera;
  loadScene(io.scene, io.march);
  const vec2 middle = (vec2(pixel) + 0.5) / vec2(io.scene.at[0].imageSize);
  beginPixel(io.scene, io.march, cameraOrigin(camera, middle), cameraDirection(camera, middle));
  PixelSums sums = io.sums.at[invocation];
  if (io.resume == 0u) {
    for (int i = 0; i < 4; ++i) {
      sums.moments[i] = 0.0;
    }
    for (int i = 0; i < 8; ++i) {
      sums.extras[i] = 0.0;
    }
  }
  uint cells = 0u;
  uint steps = 0u;
  uint corrections = 0u;
  [[dont_unroll]] for (uint i = 0u; i < io.sampleCount; ++i) {
    const uint index = io.firstSample + i;
    const Sobol sobol = sobolBegin(pixel, index, io.seed);
    Rng rng = rngSeed(pixel, index, io.seed);
    const vec2 raster = (vec2(pixel) + pixelOffset(sobol)) / vec2(io.scene.at[0].imageSize);
    const vec3 origin = cameraOrigin(camera, raster);
    const vec3 direction = cameraDirection(camera, raster);
    const MarchResult result = marchRay(io.scene, io.march, origin, direction, sobol, rng);
    addSample(sums, result, direction);
    cells += result.cells;
    steps += result.steps;
    corrections += result.corrections;
    if (result.cut) {
      atomicAdd(io.counters.at[0].cut, 1u);
    }
  }
  io.sums.at[invocation] = sums;
  if (kCount) {
    atomicAdd(io.counters.at[0].cells, cells);
    atomicAdd(io.counters.at[0].steps, steps);
    atomicAdd(io.counters.at[0].corrections, corrections);
  }
}

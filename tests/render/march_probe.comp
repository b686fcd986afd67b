#version 460
// SPDX-License-Identifier: Apache-2.0
// Marches and walks along given rays; see march_probe_io.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "march_probe_io.h"

#define SPEC(type, name, id, value) layout(constant_id = id) const type name = value;
TYNDALL_MARCH_SPEC(SPEC)
#undef SPEC
const uint kFormatMask = 0u; // no atlas is read

#include "passes/march/ray.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { MarchProbeInputs io; };

// Planted: a ray that grazes a plane finds itself in the same cell again and again, or in its neighbour.
float statelessDepth(CellGrid grid, float sigmaT, vec3 worldOrigin, vec3 worldDirection, inout uint steps) {
  const vec3 origin = grid.voxelFromWorld * vec4(worldOrigin, 1.0);
  const vec3 direction = mat3(grid.voxelFromWorld) * worldDirection;
  float tau = 0.0;
  float t = 0.0;
  [[dont_unroll]] while (steps < kStatelessBound) {
    const CellWalk walk = cellWalkBegin(grid, origin, direction, t, kInfiniteDistance);
    if (walk.tEnter >= walk.tLeave) {
      break;
    }
    const CellStep look = cellLook(walk, grid);
    const float tExit = max(look.tExit, walk.tEnter);
    if (look.block != kEmptyBrick) {
      const vec4 cubic = cellCubic(walk, grid, look.block, walk.tEnter, tExit);
      tau += sigmaT * (tExit - walk.tEnter) * cubicIntegral(cubic, 1.0);
    }
    t = tExit;
    ++steps;
  }
  return tau;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= io.count) {
    return;
  }
  const MarchProbeRay ray = io.rays.at[i];
  loadScene(io.scene, io.march);
  MarchProbeResult result = MarchProbeResult(0.0, 1.0, 0.0, 0u, 0u);
  if (io.mode == kProbeDepth) {
    result.depth = cellOpticalDepth(slotGrids[0], media[0].sigmaT, ray.origin, ray.direction,
                                    vec2(0.0, kInfiniteDistance), kInfiniteDistance, result.steps);
  } else if (io.mode == kProbeStateless) {
    result.depth = statelessDepth(slotGrids[0], media[0].sigmaT, ray.origin, ray.direction, result.steps);
  } else {
    const uvec2 pixel = uvec2(i & 0xffffu, i >> 16);
    [[dont_unroll]] for (uint s = 0u; s < io.sampleCount; ++s) {
      const uint index = io.firstSample + s;
      const Sobol sobol = sobolBegin(pixel, index, io.seed);
      Rng rng = rngSeed(pixel, index, io.seed);
      const MarchResult marched = marchRay(io.scene, io.march, ray.origin, ray.direction, sobol, rng);
      result.scattered += marched.scattered.x;
      result.transmittance = marched.transmittance;
      result.steps = max(result.steps, marched.steps);
      result.cut += uint(marched.cut);
    }
  }
  io.results.at[i] = result;
}

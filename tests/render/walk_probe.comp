#version 460
// SPDX-License-Identifier: Apache-2.0
// Walks along given rays, with the shipped tracker; see walk_probe_io.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "walk_probe_io.h"

#define SPEC(type, name, id, value) layout(constant_id = id) const type name = value;
TYNDALL_TRACE_SPEC(SPEC)
#undef SPEC
const bool kChromatic = false;

#include "tracker/walk.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { WalkInputs io; };

void main() {
  const uint invocation = gl_GlobalInvocationID.x;
  if (invocation >= io.rayCount * io.invocationsPerRay) {
    return;
  }
  const WalkRay ray = io.rays.at[invocation / io.invocationsPerRay];
  WalkResult result = WalkResult(0.0, 0.0, 0u, 0u, 0u);
  [[dont_unroll]] for (uint i = 0u; i < io.walks; ++i) {
    Rng rng = rngSeed(uvec2(invocation, 0u), i, io.seed);
    Walk walk = walkBegin(ray.origin, ray.direction, ray.tMax, io.mode, io.scene.at[0].homogeneousCount);
    WalkCounts counts = WalkCounts(0u, 0u, 1u << 30);
    if (io.firstXi < 1.0) {
      Grid grid = io.scene.at[0].grids.at[io.scene.at[0].media.at[walk.medium].densityGrid];
      walkEnter(walk, grid, rng);
      walk.tau = opticalDepthAt(io.firstXi * rngFloat(rng));
    }
    walkAdvance(walk, io.scene, rng, counts);
    const bool hit = walk.tHit >= 0.0;
    const float transmittance = !kWeighted && io.mode == kWalkCollide ? (hit ? 0.0 : 1.0) : walk.transmittance;
    result.transmittance += transmittance;
    result.transmittanceSquared += transmittance * transmittance;
    result.hits += uint(hit);
    result.lookups += counts.lookups;
    result.exceeded += counts.exceeded;
    if (io.writeDistances != 0u) {
      io.distances.at[invocation * io.walks + i] = walk.tHit;
    }
  }
  io.results.at[invocation] = result;
}

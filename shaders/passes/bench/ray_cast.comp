#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/bench/ray_cast_io.h"

const bool kSpheres = false;
const bool kInstances = false;
const uint kPlantedBug = 0u;

#include "geometry/ray.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { RayCastInputs io; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= io.count) {
    return;
  }
  const SurfaceHit hit =
      surfaceCast(io.surfaces, io.rays.at[i].origin, io.rays.at[i].direction, io.rays.at[i].tMax, io.anyHit != 0u);
  io.hits.at[i] = BenchHit(hit.t, hit.primitive);
}

#version 460
// SPDX-License-Identifier: Apache-2.0
// Maps points to their previous places; see motion_probe_io.h.
#extension GL_GOOGLE_include_directive : require

#include "motion_probe_io.h"

#include "geometry/motion.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { MotionProbeInputs io; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < io.count) {
    const MovedPoint moved = io.points.at[i];
    io.previous.at[i].point = previousPlace(io.surfaces, moved.motion, moved.point);
  }
}

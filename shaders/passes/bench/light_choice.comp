#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/bench/light_choice_io.h"

layout(constant_id = 0) const uint kLightSelection = 0u; // kSelect*

#include "light/tree.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { LightChoiceInputs io; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= io.count) {
    return;
  }
  Rng rng = rngSeed(uvec2(i % io.width, i / io.width), 0u, 0u);
  const vec2 place = (vec2(i % io.width, i / io.width) + 0.5) / float(io.width);
  LightReceiver receiver;
  receiver.point = io.corner + place.x * io.edgeU + place.y * io.edgeV;
  receiver.normal = normalize(cross(io.edgeU, io.edgeV));
  receiver.twoSided = false;
  float sum = 0.0;
  [[dont_unroll]] for (uint choice = 0u; choice < io.choices; ++choice) {
    const EmitterChoice chosen = chooseEmitter(io.emitters, receiver, rngFloat(rng), rng);
    sum += chosen.pdf * float(chosen.emitter);
  }
  io.sums.at[i] = sum;
}

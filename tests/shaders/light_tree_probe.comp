#version 460
// SPDX-License-Identifier: Apache-2.0
// light/tree.glsl: choices (kMode 0), the probabilities of given emitters (kMode 1), or choices alone (kMode 2).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
layout(constant_id = 1) const uint kLightSelection = 0u;
#include "light/tree.glsl"
#include "light_tree_probe_io.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(push_constant, scalar) uniform Push { TreeProbe probe; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= probe.count) {
    return;
  }
  const TreeReceiver given = probe.receivers.at[i / probe.perReceiver];
  const LightReceiver receiver = LightReceiver(given.point, given.normal, given.twoSided != 0u);
  EmitterChoice choice;
  if (kMode != 1u) {
    Rng rng = rngSeed(uvec2(i, 31u), 5u, 1u);
    const float xi = rngFloat(rng);
    choice = chooseEmitter(probe.emitters, receiver, xi, rng);
  } else {
    choice.emitter = i % probe.perReceiver;
    choice.pdf = 0.0;
  }
  const float again = kMode == 2u ? 0.0 : emitterChoicePdf(probe.emitters, choice.emitter, receiver);
  probe.choices.at[i] = TreeChoice(choice.emitter, choice.pdf, again);
}

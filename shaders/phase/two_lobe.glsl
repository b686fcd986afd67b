// SPDX-License-Identifier: Apache-2.0
// Two Henyey-Greenstein lobes: parameters = (g1, g2, weight of g1 in [0, 1]).
#ifndef TYNDALL_PHASE_TWO_LOBE_GLSL
#define TYNDALL_PHASE_TWO_LOBE_GLSL

#include "phase/henyey_greenstein.glsl"

float twoLobeEval(Phase phase, vec3 dIn, vec3 dOut) {
  return mix(henyeyGreensteinLobeEval(phase.parameters.y, dIn, dOut),
             henyeyGreensteinLobeEval(phase.parameters.x, dIn, dOut), phase.parameters.z);
}

vec3 twoLobeSample(Phase phase, vec3 dIn, inout Rng rng) {
  const float g = rngFloat(rng) < phase.parameters.z ? phase.parameters.x : phase.parameters.y;
  return henyeyGreensteinLobeSample(g, dIn, rngFloat2(rng));
}

float twoLobeMeanCosine(Phase phase) { return mix(phase.parameters.y, phase.parameters.x, phase.parameters.z); }

#endif

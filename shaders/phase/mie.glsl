// SPDX-License-Identifier: Apache-2.0
// Water droplets: Henyey-Greenstein and Draine mixed, parameters = (gHG, gDraine, alpha, weight of Draine), made from
// the droplets' diameter by mieParameters (src/light/mie.h). [Jendersie23]
#ifndef TYNDALL_PHASE_MIE_GLSL
#define TYNDALL_PHASE_MIE_GLSL

#include "phase/draine.glsl"

float mieEval(Phase phase, vec3 dIn, vec3 dOut) {
  return mix(henyeyGreensteinLobeEval(phase.parameters.x, dIn, dOut),
             draineLobeEval(phase.parameters.y, phase.parameters.z, dIn, dOut), phase.parameters.w);
}

vec3 mieSample(Phase phase, vec3 dIn, inout Rng rng) {
  if (rngFloat(rng) < phase.parameters.w) {
    return draineLobeSample(phase.parameters.y, phase.parameters.z, dIn, rng);
  }
  return henyeyGreensteinLobeSample(phase.parameters.x, dIn, rngFloat2(rng));
}

float mieMeanCosine(Phase phase) {
  return mix(phase.parameters.x, draineLobeMeanCosine(phase.parameters.y, phase.parameters.z), phase.parameters.w);
}

#endif

// SPDX-License-Identifier: Apache-2.0
// The phase function as light transport evaluates it: with the bugs that tests plant there. The includer declares
// kPhaseMask and `const uint kPlantedBug`.
#ifndef TYNDALL_PHASE_PLANTED_GLSL
#define TYNDALL_PHASE_PLANTED_GLSL

#include "interop/planted_bugs.h"
#include "phase/phase.glsl"

/// [1/sr]; dIn and dOut unit.
float evalPhase(Phase phase, vec3 dIn, vec3 dOut) {
  const float value = phaseEval(phase, kPlantedBug == kBugPhaseSign ? -dIn : dIn, dOut);
  return kPlantedBug == kBugNoInverse4Pi ? value * kFourPi : value;
}

#endif

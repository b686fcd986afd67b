// SPDX-License-Identifier: Apache-2.0
// Phase functions: p(dIn, dOut) per steradian, normalised to 1 over the sphere. Both directions are the way the light
// (or the path) travels: dOut = dIn is straight on, and g > 0 is forward scattering. Sampling is exact, so that
// phaseEval is the pdf of phaseSample.
// The includer declares `const uint kPhaseMask`, bit id of phase/list.h set for each model in the scene, usually a
// specialization constant: the other models cost nothing.
#ifndef TYNDALL_PHASE_PHASE_GLSL
#define TYNDALL_PHASE_PHASE_GLSL

#include "phase/draine.glsl"
#include "phase/henyey_greenstein.glsl"
#include "phase/isotropic.glsl"
#include "phase/list.h"
#include "phase/mie.glsl"
#include "phase/rayleigh.glsl"
#include "phase/two_lobe.glsl"

// clang-format off
#define TYNDALL_PHASE_CASE(id, call) case id: if ((kPhaseMask & (1u << id)) != 0u) { return call; } break;

/// [1/sr]; dIn and dOut unit.
float phaseEval(Phase phase, vec3 dIn, vec3 dOut) {
  switch (phase.id) {
#define X(Name, prefix, id, sceneName, parameters) TYNDALL_PHASE_CASE(id, prefix##Eval(phase, dIn, dOut))
    TYNDALL_PHASE_LIST(X)
#undef X
  }
  return 0.0;
}

/// Unit dOut with pdf phaseEval(phase, dIn, dOut).
vec3 phaseSample(Phase phase, vec3 dIn, inout Rng rng) {
  switch (phase.id) {
#define X(Name, prefix, id, sceneName, parameters) TYNDALL_PHASE_CASE(id, prefix##Sample(phase, dIn, rng))
    TYNDALL_PHASE_LIST(X)
#undef X
  }
  return dIn;
}

/// The mean of dot(dIn, dOut), in (-1, 1).
float phaseMeanCosine(Phase phase) {
  switch (phase.id) {
#define X(Name, prefix, id, sceneName, parameters) TYNDALL_PHASE_CASE(id, prefix##MeanCosine(phase))
    TYNDALL_PHASE_LIST(X)
#undef X
  }
  return 0.0;
}

#undef TYNDALL_PHASE_CASE
// clang-format on

#endif

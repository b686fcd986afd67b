// SPDX-License-Identifier: Apache-2.0
// Isotropic: no parameters.
#ifndef TYNDALL_PHASE_ISOTROPIC_GLSL
#define TYNDALL_PHASE_ISOTROPIC_GLSL

#include "core/rng.glsl"
#include "core/warp.glsl"
#include "interop/phase.h"

float isotropicEval(Phase phase, vec3 dIn, vec3 dOut) { return kInvFourPi; }
vec3 isotropicSample(Phase phase, vec3 dIn, inout Rng rng) { return uniformSphereSample(rngFloat2(rng)); }
float isotropicMeanCosine(Phase phase) { return 0.0; }

#endif

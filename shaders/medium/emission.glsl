// SPDX-License-Identifier: Apache-2.0
// The emission coefficient j [W/(m3 sr)] of grid media.
#ifndef TYNDALL_MEDIUM_EMISSION_GLSL
#define TYNDALL_MEDIUM_EMISSION_GLSL

#include "interop/scene.h"
#include "light/blackbody.glsl"

// Emission of a grid medium where its emission grid has `value` and its extinction is `sigmaT`. Not linear in the value.
vec3 emissionOf(Medium medium, vec3Ptr blackbody, float value, float sigmaT) {
  vec3 j = medium.emission;
  if (medium.emissionKind == kEmissionBlackbody) {
    j *= blackbodyRadiance(blackbody, medium.temperatureScale * value + medium.temperatureOffset);
  } else {
    j *= max(value, 0.0);
  }
  return medium.emissionTied != 0u ? j * sigmaT * medium.colour * (1.0 - medium.albedo) : j;
}

#endif

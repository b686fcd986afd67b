// SPDX-License-Identifier: Apache-2.0
// Rayleigh scattering of unpolarised light, depolarisation neglected: 3 / (16 pi) (1 + cos^2). No parameters.
#ifndef TYNDALL_PHASE_RAYLEIGH_GLSL
#define TYNDALL_PHASE_RAYLEIGH_GLSL

#include "core/frame.glsl"
#include "core/rng.glsl"
#include "interop/phase.h"

float rayleighEval(Phase phase, vec3 dIn, vec3 dOut) {
  const float cosTheta = dot(dIn, dOut);
  return 0.75 * kInvFourPi * (1.0 + cosTheta * cosTheta);
}

vec3 rayleighSample(Phase phase, vec3 dIn, inout Rng rng) {
  const vec2 xi = rngFloat2(rng);
  // The CDF is (c^3 + 3 c + 4) / 8: Cardano's root of c^3 + 3 c = 2 z, [Frisvad11].
  const float z = 4.0 * xi.x - 2.0;
  const float magnitude = abs(z);
  const float root = pow(magnitude + sqrt(magnitude * magnitude + 1.0), 1.0 / 3.0);
  float cosTheta = root - 1.0 / root;
  // pow is a few per cent off near 1, where the root is small; one Newton step removes that.
  const float square = cosTheta * cosTheta;
  cosTheta -= (cosTheta * (square + 3.0) - 2.0 * magnitude) / (3.0 * square + 3.0);
  cosTheta = min(cosTheta, 1.0) * sign(z);
  return directionAbout(dIn, 1.0 - cosTheta, xi.y);
}

float rayleighMeanCosine(Phase phase) { return 0.0; }

#endif

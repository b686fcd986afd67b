// SPDX-License-Identifier: Apache-2.0
// Draine: Henyey-Greenstein times (1 + alpha cos^2), parameters = (g, alpha >= 0). Rayleigh at g = 0, alpha = 1;
// Cornette-Shanks at alpha = 1. [Draine03] "Scattering by Interstellar Dust Grains. I".
#ifndef TYNDALL_PHASE_DRAINE_GLSL
#define TYNDALL_PHASE_DRAINE_GLSL

#include "phase/henyey_greenstein.glsl"

/// The mean of 1 + alpha cos^2 over Henyey-Greenstein of g.
float draineNormalisation(float g, float alpha) { return 1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0; }

float draineLobeEval(float g, float alpha, vec3 dIn, vec3 dOut) {
  const float cosTheta = dot(dIn, dOut);
  return henyeyGreensteinLobeEval(g, dIn, dOut) * (1.0 + alpha * cosTheta * cosTheta) / draineNormalisation(g, alpha);
}

/// Exact by rejection from Henyey-Greenstein: (1 + alpha cos^2) / (1 + alpha) is a probability. It accepts at least
/// a third, so 64 proposals fail with probability below 1e-11; the closed-form inverse of [Jendersie23] loses its
/// digits at small g instead.
vec3 draineLobeSample(float g, float alpha, vec3 dIn, inout Rng rng) {
  float oneMinusCos = 0.0;
  for (int i = 0; i < 64; ++i) {
    const vec2 xi = rngFloat2(rng);
    oneMinusCos = henyeyGreensteinOneMinusCos(g, xi.x);
    const float cosTheta = 1.0 - oneMinusCos;
    if (xi.y * (1.0 + alpha) < 1.0 + alpha * cosTheta * cosTheta) {
      break;
    }
  }
  return directionAbout(henyeyGreensteinAxis(g, dIn), oneMinusCos, rngFloat(rng));
}

/// The moments of Henyey-Greenstein: <c> = g, <c^2> = (1 + 2 g^2) / 3, <c^3> = g (3 + 2 g^2) / 5.
float draineLobeMeanCosine(float g, float alpha) {
  return g * (1.0 + alpha * (3.0 + 2.0 * g * g) / 5.0) / draineNormalisation(g, alpha);
}

float draineEval(Phase phase, vec3 dIn, vec3 dOut) {
  return draineLobeEval(phase.parameters.x, phase.parameters.y, dIn, dOut);
}

vec3 draineSample(Phase phase, vec3 dIn, inout Rng rng) {
  return draineLobeSample(phase.parameters.x, phase.parameters.y, dIn, rng);
}

float draineMeanCosine(Phase phase) { return draineLobeMeanCosine(phase.parameters.x, phase.parameters.y); }

#endif

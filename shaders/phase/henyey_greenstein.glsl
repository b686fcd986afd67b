// SPDX-License-Identifier: Apache-2.0
// Henyey-Greenstein: parameters.x = g, the mean cosine, |g| <= 0.9999.
// [Henyey41] "Diffuse radiation in the Galaxy", eq. (2), written in o = 1 - cos theta: near |g| = 1 the cosine of two
// float directions has lost the peak, their difference has not.
#ifndef TYNDALL_PHASE_HENYEY_GREENSTEIN_GLSL
#define TYNDALL_PHASE_HENYEY_GREENSTEIN_GLSL

#include "core/frame.glsl"
#include "core/rng.glsl"
#include "interop/phase.h"

/// The direction that the peak points to. HG of -g is HG of g about the opposite direction.
vec3 henyeyGreensteinAxis(float g, vec3 dIn) { return g < 0.0 ? -dIn : dIn; }

/// [1/sr] for 1 - cos about henyeyGreensteinAxis.
float henyeyGreensteinDensity(float g, float oneMinusCos) {
  const float h = abs(g);
  const float k = 1.0 - h;
  const float denominator = k * k + 2.0 * h * oneMinusCos;
  // k (2 - k) = 1 - g^2, which itself would lose four digits at g = 0.9999.
  return kInvFourPi * k * (2.0 - k) / (denominator * sqrt(denominator));
}

/// 1 - cos about henyeyGreensteinAxis, by inversion; regular at g = 0.
float henyeyGreensteinOneMinusCos(float g, float xi) {
  const float h = abs(g);
  const float k = 1.0 - h;
  const float denominator = k + 2.0 * h * xi;
  const float t = k * (2.0 - k) / denominator;
  return clamp(k * (1.0 - xi) * (t + k) / denominator, 0.0, 2.0);
}

float henyeyGreensteinLobeEval(float g, vec3 dIn, vec3 dOut) {
  return henyeyGreensteinDensity(g, oneMinusCosBetween(henyeyGreensteinAxis(g, dIn), dOut));
}

vec3 henyeyGreensteinLobeSample(float g, vec3 dIn, vec2 xi) {
  return directionAbout(henyeyGreensteinAxis(g, dIn), henyeyGreensteinOneMinusCos(g, xi.x), xi.y);
}

float henyeyGreensteinEval(Phase phase, vec3 dIn, vec3 dOut) {
  return henyeyGreensteinLobeEval(phase.parameters.x, dIn, dOut);
}

vec3 henyeyGreensteinSample(Phase phase, vec3 dIn, inout Rng rng) {
  return henyeyGreensteinLobeSample(phase.parameters.x, dIn, rngFloat2(rng));
}

float henyeyGreensteinMeanCosine(Phase phase) { return phase.parameters.x; }

#endif

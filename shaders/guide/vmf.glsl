// SPDX-License-Identifier: Apache-2.0
// The von Mises-Fisher distribution of directions about `mu` with concentration kappa in [0, 1e7]:
// p(w) = kappa exp(kappa mu.w) / (4 pi sinh kappa) [1/sr]. Equations (80)-(82) of docs/theory.md.
#ifndef TYNDALL_GUIDE_VMF_GLSL
#define TYNDALL_GUIDE_VMF_GLSL

#include "core/frame.glsl"

// Density at mu itself [1/sr]: x / (1 - exp(-x)) over 4 pi, x = 2 kappa, by its series where the difference cancels.
float vmfPeak(float kappa) {
  const float x = 2.0 * kappa;
  const float series = 1.0 + x * (0.5 + x * (1.0 / 12.0 - x * x * (1.0 / 720.0)));
  return kInvFourPi * (x < 0.25 ? series : x / (1.0 - exp(-x)));
}

// Density of the unit direction w [1/sr]. 1 - mu.w comes from the difference of the vectors: the dot product has lost a
// narrow lobe's angles. No special case at kappa = 0 [Tokuyoshi23].
float vmfPdf(vec3 mu, float kappa, vec3 w) { return vmfPeak(kappa) * exp(-kappa * oneMinusCosBetween(mu, w)); }

// A direction from xi in (0, 1)^2 by inversion; 1 - cos is what is drawn, for the same reason [Jakob12].
vec3 vmfSample(vec3 mu, float kappa, vec2 xi) {
  float oneMinusCos = 2.0 * xi.y;
  if (kappa > 3e-8) {
    oneMinusCos = clamp(-log1pAccurate(-xi.y * oneMinusExp(2.0 * kappa)) / kappa, 0.0, 2.0);
  }
  return normalize(directionAbout(mu, oneMinusCos, xi.x));
}

// The concentration whose mean of 1 - cos is `oneMinusCos` > 0 [Banerjee05, (4.4)]: within 4.9 %, its own mean cosine
// within 1.8 %. Written so that nothing cancels at narrow lobes. Means beyond 1 give 0, the uniform distribution.
float vmfKappa(float oneMinusCos) {
  const float e = min(oneMinusCos, 1.0);
  return (2.0 - e * e * (3.0 - e)) / (e * (2.0 - e));
}

#endif

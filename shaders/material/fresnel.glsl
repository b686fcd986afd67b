// SPDX-License-Identifier: Apache-2.0
// Reflectances of smooth interfaces for unpolarised light. `cosine` is of the angle of incidence, [0, 1].
#ifndef TYNDALL_MATERIAL_FRESNEL_GLSL
#define TYNDALL_MATERIAL_FRESNEL_GLSL

#include "core/numerics.glsl"

/// (1 - cosine)^5 of [Schlick94]: the share of the way from normal to grazing incidence.
float schlickWeight(float cosine) {
  const float m = clamp(1.0 - cosine, 0.0, 1.0);
  const float m2 = m * m;
  return m2 * m2 * m;
}

/// 1 - schlickWeight, with all its digits at grazing incidence: 1 - m^5 = (1 - m)(1 + m + m^2 + m^3 + m^4).
float schlickThrough(float cosine) {
  const float m = clamp(1.0 - cosine, 0.0, 1.0);
  return min(cosine, 1.0) * (1.0 + m * (1.0 + m * (1.0 + m * (1.0 + m))));
}

/// [Schlick94], with reflectance 1 at grazing incidence.
vec3 schlickFresnel(vec3 normalIncidence, float cosine) {
  return mix(normalIncidence, vec3(1.0), schlickWeight(cosine));
}

/// Cosine of the refracted ray by Snell's law, 0 where all light is reflected. `eta` > 0: index on the far side over
/// the near side. Sines are not formed: at eta = 1 the cosine is what it was, to the bit.
float refractedCosine(float cosine, float eta) { return safeSqrt((eta - 1.0) * (eta + 1.0) + cosine * cosine) / eta; }

/// Fresnel's formula, theory (22). `cosine` > 0; `beyond` = refractedCosine(cosine, eta).
float dielectricFresnel(float cosine, float beyond, float eta) {
  const float parallel = (eta * cosine - beyond) / (eta * cosine + beyond);
  const float perpendicular = (cosine - eta * beyond) / (cosine + eta * beyond);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

/// Fresnel's formula with the complex index eta + i k, both relative to the near side, per channel, in real numbers.
/// [Born99] section 14.2, with a2b2 = a^2 + b^2 of (a + i b)^2 = (eta + i k)^2 - sin^2.
vec3 conductorFresnel(float cosine, vec3 eta, vec3 k) {
  const float cos2 = cosine * cosine;
  const float sin2 = 1.0 - cos2;
  const vec3 difference = eta * eta - k * k - sin2;
  const vec3 a2b2 = sqrt(difference * difference + 4.0 * eta * eta * k * k);
  const vec3 a = sqrt(max(0.5 * (a2b2 + difference), vec3(0.0)));
  const vec3 sum = a2b2 + cos2;
  const vec3 twice = 2.0 * a * cosine;
  // The bounds are met where index and angle say 0 / 0: eta = 1, k = 0 at grazing incidence.
  const vec3 perpendicular = (sum - twice) / max(sum + twice, vec3(1e-20));
  const vec3 sumP = a2b2 * cos2 + sin2 * sin2;
  const vec3 twiceP = twice * sin2;
  const vec3 parallel = perpendicular * (sumP - twiceP) / max(sumP + twiceP, vec3(1e-20));
  return max(0.5 * (perpendicular + parallel), vec3(0.0)); // eta = 1 and almost no k: rounding may go below
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Glass, water: GGX microfacets that reflect and refract [Walter07], or a smooth interface; theory (21), (22) and (24).
// Radiance is transported: what arrives by refraction is scaled by (index on wo's side / index on wi's side)^2.
#ifndef TYNDALL_MATERIAL_DIELECTRIC_GLSL
#define TYNDALL_MATERIAL_DIELECTRIC_GLSL

#include "material/fresnel.glsl"
#include "material/ggx.glsl"
#include "material/types.glsl"

/// Refracting half vectors come from the difference o + eta i, so that their error is that of the directions over
/// |eta - 1|: nearly equal indices bend a lobe too little for floats to show its width.
bool dielectricIsDelta(Bsdf b) {
  const float smallerStep = abs(b.etaRatio - 1.0) / max(b.etaRatio, 1.0); // of eta and 1 / eta
  return b.alpha * min(smallerStep, 1.0) < kLeastAlpha;
}

/// Index beyond over the index on wo's side.
float dielectricEta(Bsdf b, vec3 wo) { return wo.z < 0.0 ? 1.0 / b.etaRatio : b.etaRatio; }

/// Density of refracted directions over that of h, theory (24): eta^2 cosineIn / (eta dot(i, h) + dot(o, h))^2. With
/// Snell's law the root is -(eta^2 - 1) / (dot(o, h) + eta cosineIn), cosineIn = |dot(i, h)|, without the cancellation.
float refractionJacobian(float cosineOut, float cosineIn, float eta) {
  const float inverseRoot = (cosineOut + eta * cosineIn) / ((eta - 1.0) * (eta + 1.0));
  return eta * eta * cosineIn * inverseRoot * inverseRoot;
}

/// (f |cos wi|, pdf)
vec4 dielectricEvalPdf(Bsdf b, vec3 wo, vec3 wi) {
  if (dielectricIsDelta(b) || min(abs(wo.z), abs(wi.z)) < kLeastCosine) {
    return vec4(0.0);
  }
  const float eta = dielectricEta(b, wo);
  const bool transmitted = wo.z * wi.z < 0.0;
  const vec3 o = vec3(wo.xy, abs(wo.z));
  const float below = transmitted ? -1.0 : 1.0;
  const vec3 i = vec3(wi.xy, below * abs(wi.z));
  vec3 h = normalize(o + (transmitted ? eta : 1.0) * i);
  h = h.z < 0.0 ? -h : h;
  const float cosineOut = min(dot(o, h), 1.0);
  const float cosineIn = min(below * dot(i, h), 1.0);
  if (min(cosineOut, cosineIn) < 1e-7) { // a facet seen from behind
    return vec4(0.0);
  }
  // Both cosines are known: near total reflection one would come from the other with half its digits.
  const float beyond = transmitted ? cosineIn : refractedCosine(cosineOut, eta);
  const float reflectance = dielectricFresnel(cosineOut, beyond, eta);
  float pdf = ggxVisiblePdf(o, h, b.alpha);
  vec3 weight = vec3(ggxMasking(o, vec3(i.xy, abs(i.z)), b.alpha));
  if (transmitted) {
    pdf *= (1.0 - reflectance) * refractionJacobian(cosineOut, cosineIn, eta);
    weight *= b.colour / (eta * eta);
  } else {
    pdf *= reflectance / (4.0 * cosineOut);
  }
  return pdf * vec4(weight, 1.0);
}

/// Takes reflection with the probability of Fresnel's formula.
BsdfSample dielectricSample(Bsdf b, vec3 wo, inout Rng rng) {
  BsdfSample s = bsdfAbsorbed();
  if (abs(wo.z) < kLeastCosine) {
    return s;
  }
  const float eta = dielectricEta(b, wo);
  const vec3 o = vec3(wo.xy, abs(wo.z));
  s.delta = dielectricIsDelta(b);
  vec3 h = vec3(0.0, 0.0, 1.0);
  if (!s.delta) {
    h = ggxVisibleNormal(o, b.alpha, rngFloat2(rng));
  }
  const float cosine = clamp(dot(o, h), 1e-7, 1.0);
  const float beyond = refractedCosine(cosine, eta);
  const float reflectance = dielectricFresnel(cosine, beyond, eta);
  s.transmitted = rngFloat(rng) >= reflectance;
  s.weight = vec3(1.0);
  float probability = reflectance;
  float jacobian = 0.25 / cosine;
  vec3 i = 2.0 * cosine * h - o;
  if (s.transmitted) {
    // Snell's law: cosine / eta - beyond, without the cancellation near eta = 1.
    const float step = (1.0 - eta) * (1.0 + eta) / (eta * (cosine + eta * beyond));
    i = step * h - o / eta;
    s.weight = b.colour / (eta * eta);
    probability = 1.0 - reflectance;
    jacobian = s.delta ? 0.0 : refractionJacobian(cosine, beyond, eta);
  }
  i = normalize(i);
  s.valid = (s.transmitted ? -i.z : i.z) >= kLeastCosine;
  if (s.valid && !s.delta) {
    s.weight *= ggxMasking(o, vec3(i.xy, abs(i.z)), b.alpha);
    s.pdf = probability * ggxVisiblePdf(o, h, b.alpha) * jacobian;
  }
  s.wi = vec3(i.xy, wo.z < 0.0 ? -i.z : i.z);
  return s;
}

#endif

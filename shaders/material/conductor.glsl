// SPDX-License-Identifier: Apache-2.0
// A metal, opaque: nothing on the side of -z. GGX microfacets that are mirrors; theory (21) and (23).
#ifndef TYNDALL_MATERIAL_CONDUCTOR_GLSL
#define TYNDALL_MATERIAL_CONDUCTOR_GLSL

#include "material/fresnel.glsl"
#include "material/ggx.glsl"
#include "material/types.glsl"

bool conductorIsDelta(Bsdf b) { return b.alpha < kLeastAlpha; }

/// By eta and k where a channel absorbs, else by Schlick's formula from the colour.
vec3 conductorReflectance(Bsdf b, float cosine) {
  if (max(b.k.x, max(b.k.y, b.k.z)) > 0.0) {
    return conductorFresnel(cosine, b.eta, b.k);
  }
  return schlickFresnel(b.colour, cosine);
}

/// (f |cos wi|, pdf)
vec4 conductorEvalPdf(Bsdf b, vec3 wo, vec3 wi) {
  if (conductorIsDelta(b) || min(wo.z, wi.z) < kLeastCosine) {
    return vec4(0.0);
  }
  const vec3 h = normalize(wo + wi);
  const float cosine = clamp(dot(wo, h), 1e-7, 1.0);
  const float pdf = ggxVisiblePdf(wo, h, b.alpha) / (4.0 * cosine);
  return pdf * vec4(conductorReflectance(b, cosine) * ggxMasking(wo, wi, b.alpha), 1.0);
}

BsdfSample conductorSample(Bsdf b, vec3 wo, inout Rng rng) {
  BsdfSample s = bsdfAbsorbed();
  if (wo.z < kLeastCosine) {
    return s;
  }
  s.delta = conductorIsDelta(b);
  vec3 h = vec3(0.0, 0.0, 1.0);
  if (!s.delta) {
    h = ggxVisibleNormal(wo, b.alpha, rngFloat2(rng));
  }
  const float cosine = clamp(dot(wo, h), 1e-7, 1.0);
  s.wi = normalize(2.0 * cosine * h - wo);
  s.weight = conductorReflectance(b, cosine);
  s.valid = s.wi.z >= kLeastCosine;
  if (s.valid && !s.delta) {
    s.weight *= ggxMasking(wo, s.wi, b.alpha);
    s.pdf = ggxVisiblePdf(wo, h, b.alpha) / (4.0 * cosine);
  }
  return s;
}

#endif

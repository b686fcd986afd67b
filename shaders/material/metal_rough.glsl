// SPDX-License-Identifier: Apache-2.0
// glTF's metallic-roughness [Gltf21], opaque: nothing on the side of -z. Metallic blends a metal whose reflectance is
// the colour with a diffuse base of that colour under a dielectric coat; theory (25). Never a delta: alpha >=
// kLeastAlpha.
#ifndef TYNDALL_MATERIAL_METAL_ROUGH_GLSL
#define TYNDALL_MATERIAL_METAL_ROUGH_GLSL

#include "material/fresnel.glsl"
#include "material/ggx.glsl"
#include "material/types.glsl"

bool metalRoughIsDelta(Bsdf b) { return false; }

/// Of the microfacets, both of the coat and of the metal.
vec3 metalRoughReflectance(Bsdf b, float cosine) {
  return schlickFresnel(mix(vec3(b.coatF0), b.colour, b.metallic), cosine);
}

/// f of the base. It gets what the coat lets through on the way in and out, over the mean of that [Kelemen01]: a smooth
/// coat and a white base reflect all light together, at every angle. That factor is 21 / 20 by Schlick's formula; 1.047
/// because a rough coat reflects more than a smooth one at 50 degrees, and no coat may make energy.
vec3 metalRoughBase(Bsdf b, float cosineOut, float cosineIn) {
  const float through = schlickThrough(cosineOut) * schlickThrough(cosineIn);
  return b.colour * ((1.0 - b.metallic) * (1.0 - b.coatF0) * 1.047 * kInvPi * through);
}

/// Probability that a sample is one of the microfacets': their share of what is reflected, about.
float metalRoughShare(Bsdf b, float cosineOut) {
  const vec3 facets = metalRoughReflectance(b, cosineOut);
  const vec3 base = b.colour * ((1.0 - b.metallic) * (1.0 - b.coatF0) * schlickThrough(cosineOut));
  const float facetSum = facets.x + facets.y + facets.z;
  const float baseSum = base.x + base.y + base.z;
  return baseSum > 0.0 ? clamp(facetSum / (facetSum + baseSum), 0.1, 1.0) : 1.0;
}

/// (f |cos wi|, pdf)
vec4 metalRoughEvalPdf(Bsdf b, vec3 wo, vec3 wi) {
  if (min(wo.z, wi.z) < kLeastCosine) {
    return vec4(0.0);
  }
  const float alpha = max(b.alpha, kLeastAlpha);
  const float share = metalRoughShare(b, wo.z);
  const vec3 h = normalize(wo + wi);
  const float cosine = clamp(dot(wo, h), 1e-7, 1.0);
  const float facetPdf = ggxVisiblePdf(wo, h, alpha) / (4.0 * cosine);
  const vec3 facets = metalRoughReflectance(b, cosine) * (ggxMasking(wo, wi, alpha) * facetPdf);
  const vec3 base = metalRoughBase(b, wo.z, wi.z) * wi.z;
  return vec4(facets + base, mix(cosineHemispherePdf(wi.z), facetPdf, share));
}

BsdfSample metalRoughSample(Bsdf b, vec3 wo, inout Rng rng) {
  BsdfSample s = bsdfAbsorbed();
  if (wo.z < kLeastCosine) {
    return s;
  }
  const bool facet = rngFloat(rng) < metalRoughShare(b, wo.z);
  const vec2 xi = rngFloat2(rng);
  if (facet) {
    const vec3 h = ggxVisibleNormal(wo, max(b.alpha, kLeastAlpha), xi);
    s.wi = normalize(2.0 * dot(wo, h) * h - wo);
  } else {
    s.wi = cosineHemisphereSample(xi);
  }
  const vec4 evalPdf = metalRoughEvalPdf(b, wo, s.wi);
  s.pdf = evalPdf.w;
  s.valid = s.pdf > 0.0;
  if (s.valid) {
    s.weight = evalPdf.rgb / s.pdf;
  }
  return s;
}

#endif

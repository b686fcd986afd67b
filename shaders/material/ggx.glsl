// SPDX-License-Identifier: Apache-2.0
// Microfacets distributed by GGX [Walter07], isotropic, with Smith's masking. Directions have z > 0 here; a direction
// below the surface is passed mirrored. Everything is written by what keeps digits at small alpha and grazing angles:
// squares of sines as x^2 + y^2, never 1 - z^2.
#ifndef TYNDALL_MATERIAL_GGX_GLSL
#define TYNDALL_MATERIAL_GGX_GLSL

#include "core/numerics.glsl"

/// cos (1 + 2 Lambda(w)), Smith's Lambda [Heitz14] eq. (72); >= w.z.
float ggxSpread(vec3 w, float alpha) { return sqrt(w.z * w.z + alpha * alpha * dot(w.xy, w.xy)); }

/// Density of normals h that wo sees [1/sr], theory (21): D(h) G1(wo) dot(wo, h) / wo.z.
float ggxVisiblePdf(vec3 wo, vec3 h, float alpha) {
  const float squared = alpha * alpha;
  const float root = dot(h.xy, h.xy) + squared * h.z * h.z;
  const float density = squared * kInvPi / (root * root);
  return density * 2.0 * max(dot(wo, h), 0.0) / (wo.z + ggxSpread(wo, alpha));
}

/// A normal with pdf ggxVisiblePdf. [Dupuy23]: half vectors of a uniform spherical cap are the visible normals of
/// a hemisphere. The cap's height is kept as its distance from the pole, which has digits where normals crowd.
vec3 ggxVisibleNormal(vec3 wo, float alpha, vec2 xi) {
  const vec3 stretched = normalize(vec3(alpha * wo.xy, wo.z));
  const float fromPole = xi.y * (1.0 + stretched.z); // 1 - z of the cap's point, in (0, 2)
  const float sine = safeSqrt(fromPole * (2.0 - fromPole));
  // Its z and that of `stretched` sum to (1 - xi.y)(1 + stretched.z), positive as xi.y < 1.
  const vec3 h = vec3(sine * cosSinTurns(xi.x) + stretched.xy, (1.0 - xi.y) * (1.0 + stretched.z));
  return normalize(vec3(alpha * h.xy, h.z));
}

/// G2(wo, wi) / G1(wo) with heights correlated [Heitz14] eq. (99), in [0, 1]: what a sample by visible normals weighs
/// beside Fresnel's factor.
float ggxMasking(vec3 wo, vec3 wi, float alpha) {
  const float spreadOut = ggxSpread(wo, alpha);
  const float spreadIn = ggxSpread(wi, alpha);
  return wi.z * (wo.z + spreadOut) / (wi.z * spreadOut + wo.z * spreadIn);
}

#endif

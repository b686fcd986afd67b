// SPDX-License-Identifier: Apache-2.0
// Scattering at a surface (theory, "Surfaces"): value, pdf and sampler of the models in material/list.h, the texture
// lookups done (material/resolve.glsl). Conventions of directions and of radiance: material/types.glsl.
// `null` has none of this: rays pass, and the caller sees to that.
// The includer declares `const uint kMaterialMask`, bit id of material/list.h set for each model in the scene, usually
// a specialization constant: the other models cost nothing.
#ifndef TYNDALL_MATERIAL_BSDF_GLSL
#define TYNDALL_MATERIAL_BSDF_GLSL

#include "material/conductor.glsl"
#include "material/dielectric.glsl"
#include "material/diffuse.glsl"
#include "material/metal_rough.glsl"
#include "material/types.glsl"

bool nullIsDelta(Bsdf b) { return true; }
vec4 nullEvalPdf(Bsdf b, vec3 wo, vec3 wi) { return vec4(0.0); }
BsdfSample nullSample(Bsdf b, vec3 wo, inout Rng rng) { return bsdfAbsorbed(); }

// clang-format off
#define TYNDALL_MATERIAL_CASE(id, call) case id: if ((kMaterialMask & (1u << id)) != 0u) { return call; } break;

/// Whether bsdfSample draws from directions alone, that no light's sample can meet. Depends on the material, not on wo.
bool bsdfIsDelta(Bsdf b) {
  switch (b.model) {
#define X(Name, prefix, id, sceneName) TYNDALL_MATERIAL_CASE(id, prefix##IsDelta(b))
    TYNDALL_MATERIAL_LIST(X)
#undef X
  }
  return true;
}

/// (f(wo, wi) |cos wi| [1/sr], pdf of bsdfSample at wi [1/sr]); 0 for deltas. Both at once, since they share most of
/// their work. wo and wi unit.
vec4 bsdfEvalPdf(Bsdf b, vec3 wo, vec3 wi) {
  switch (b.model) {
#define X(Name, prefix, id, sceneName) TYNDALL_MATERIAL_CASE(id, prefix##EvalPdf(b, wo, wi))
    TYNDALL_MATERIAL_LIST(X)
#undef X
  }
  return vec4(0.0);
}

/// A direction wi for the path to go on by. wo unit.
BsdfSample bsdfSample(Bsdf b, vec3 wo, inout Rng rng) {
  switch (b.model) {
#define X(Name, prefix, id, sceneName) TYNDALL_MATERIAL_CASE(id, prefix##Sample(b, wo, rng))
    TYNDALL_MATERIAL_LIST(X)
#undef X
  }
  return bsdfAbsorbed();
}

#undef TYNDALL_MATERIAL_CASE
// clang-format on

vec3 bsdfEval(Bsdf b, vec3 wo, vec3 wi) { return bsdfEvalPdf(b, wo, wi).rgb; }
float bsdfPdf(Bsdf b, vec3 wo, vec3 wi) { return bsdfEvalPdf(b, wo, wi).w; }

#endif

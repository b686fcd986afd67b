#version 460
// SPDX-License-Identifier: Apache-2.0
// Lookups, materials and shading normals: material_texture_io.h says by which kMode.
#extension GL_GOOGLE_include_directive : require
#include "material_texture_io.h"
layout(constant_id = 1) const bool kTextures = true;
#include "material/normal.glsl"
#include "material/resolve.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;

layout(push_constant, scalar) uniform Push {
  TextureQueryPtr queries;
  TextureAnswerPtr answers;
  TexturePtr textures;
  MaterialPtr materials;
  uint count;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) {
    return;
  }
  const vec2 uv = queries.at[i].uv;
  if (kMode == kProbeLookup) {
    const vec4 value = textureLookup(textures, queries.at[i].use, uv);
    answers.at[i].colour = value.rgb;
    answers.at[i].opacity = value.a;
  } else if (kMode == kProbeNormal) {
    const mat3 worldFromTangent = mat3(queries.at[i].tangent, queries.at[i].bitangent, queries.at[i].shadingNormal);
    answers.at[i].normal =
        perturbNormal(queries.at[i].normalTangent, worldFromTangent, queries.at[i].geometricNormal, queries.at[i].wo);
  } else {
    const uint index = queries.at[i].index;
    const ResolvedMaterial m = resolveMaterial(materials, index, textures, uv, 1.25);
    answers.at[i].colour = m.bsdf.colour;
    answers.at[i].opacity = m.opacity;
    answers.at[i].alpha = m.bsdf.alpha;
    answers.at[i].metallic = m.bsdf.metallic;
    answers.at[i].etaRatio = m.bsdf.etaRatio;
    answers.at[i].coatF0 = m.bsdf.coatF0;
    answers.at[i].eta = m.bsdf.eta;
    answers.at[i].k = m.bsdf.k;
    answers.at[i].model = m.bsdf.model;
    answers.at[i].normal = m.normal;
    answers.at[i].emission = m.emission;
    answers.at[i].opacityAlone = materialOpacity(materials, index, textures, uv);
    answers.at[i].emissionAlone = materialEmission(materials, index, textures, uv);
  }
}

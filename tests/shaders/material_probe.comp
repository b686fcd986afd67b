#version 460
// SPDX-License-Identifier: Apache-2.0
// Values (kMode kProbeValues) and samples (kProbeSamples) of material/bsdf.glsl. kPlanted puts a known bug in.
#extension GL_GOOGLE_include_directive : require
#include "material_io.h"
layout(constant_id = 2) const uint kMaterialMask = 0xffffffffu;
#include "material/bsdf.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(constant_id = 1) const uint kPlanted = 0u;

layout(push_constant, scalar) uniform Push {
  BsdfQueryPtr queries;
  BsdfAnswerPtr answers;
  uint queryCount;
  uint count;
  uint seed;
};

Bsdf bsdfOf(uint i) {
  return Bsdf(queries.at[i].model, queries.at[i].colour, queries.at[i].eta, queries.at[i].k, queries.at[i].alpha,
              queries.at[i].metallic, queries.at[i].etaRatio, queries.at[i].coatF0);
}

vec4 evalPdf(Bsdf b, vec3 wo, vec3 wi) {
  vec4 result = bsdfEvalPdf(b, wo, wi);
  if (kPlanted == kPlantImportance && wo.z * wi.z < 0.0) {
    const float eta = dielectricEta(b, wo);
    result.rgb *= eta * eta;
  }
  if (kPlanted == kPlantBranchPdf && b.model == kMaterialMetalRough) {
    result.w = cosineHemispherePdf(max(wi.z, 0.0));
  }
  if (kPlanted == kPlantOneWay) {
    result.rgb *= 1.0 + 0.001 * wo.x;
  }
  if (kPlanted == kPlantUnguarded) {
    result.rgb *= length(normalize(wo + wi));
  }
  return result;
}

BsdfSample sampleOf(Bsdf b, vec3 wo, inout Rng rng) {
  Bsdf sampled = b;
  if (kPlanted == kPlantAlpha) {
    sampled.alpha *= 1.3;
  }
  BsdfSample s = bsdfSample(sampled, wo, rng);
  if (kPlanted == kPlantSchlick && b.model == kMaterialDielectric) {
    const float f0 = pow((b.etaRatio - 1.0) / (b.etaRatio + 1.0), 2.0);
    s.transmitted = rngFloat(rng) >= schlickFresnel(vec3(f0), abs(wo.z)).x;
  }
  if (kPlanted == kPlantImportance && s.transmitted) {
    const float eta = dielectricEta(b, wo);
    s.weight *= eta * eta;
  }
  if (kPlanted == kPlantAngle) {
    s.wi = normalize(s.wi + vec3(0.001, 0.0, 0.0));
  }
  if (kPlanted == kPlantBright) {
    s.weight *= 1.05;
  }
  return s;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) {
    return;
  }
  const uint query = i % queryCount;
  const Bsdf b = bsdfOf(query);
  const vec3 wo = queries.at[query].wo;
  vec3 wi = queries.at[query].wi;
  if (kMode == kProbeSamples) {
    Rng rng = rngSeed(uvec2(i, 41u), seed, 5u);
    const BsdfSample s = sampleOf(b, wo, rng);
    wi = s.wi;
    answers.at[i].wi = s.wi;
    answers.at[i].weight = s.weight;
    answers.at[i].pdf = s.pdf;
    answers.at[i].flags =
        (s.delta ? kAnswerDelta : 0u) | (s.transmitted ? kAnswerTransmitted : 0u) | (s.valid ? kAnswerValid : 0u);
  }
  const vec4 value = evalPdf(b, wo, wi);
  answers.at[i].value = value.rgb;
  answers.at[i].valuePdf = value.w;
  answers.at[i].isDelta = bsdfIsDelta(b) ? 1u : 0u;
}

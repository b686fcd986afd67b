#version 460
// SPDX-License-Identifier: Apache-2.0
// One phase function: samples with the pdf that is reported for them (kMode 0), values at given directions (kMode 1),
// the mean cosine (kMode 2). kPlanted puts a known bug in.
#extension GL_GOOGLE_include_directive : require
#include "interop/basic.h"
layout(constant_id = 2) const uint kPhaseMask = 0xffffffffu;
#include "phase/phase.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(constant_id = 1) const uint kPlanted = 0u;
const uint kWrongSign = 1u;       // samples g with the wrong sign
const uint kMissingFourPi = 2u;   // value without 1 / (4 pi)
const uint kBranchPdf = 3u;       // two-lobe: pdf of the lobe that was drawn instead of the mixture's
const uint kCosineForm = 4u;      // Henyey-Greenstein by the cosine instead of by differences
const uint kWrongJacobian = 5u;   // polar angle drawn where its cosine should be

layout(push_constant, scalar) uniform Push {
  Phase phase;
  vec3 dIn;
  uint count;
  vec3Ptr directions;
  vec4Ptr outputs; // (dOut, value)
};

float value(vec3 dOut) {
  if (kPlanted == kCosineForm) {
    const float g = phase.parameters.x;
    return kInvFourPi * (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * dot(dIn, dOut), 1.5);
  }
  return phaseEval(phase, dIn, dOut) * (kPlanted == kMissingFourPi ? kFourPi : 1.0);
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) {
    return;
  }
  if (kMode == 2u) {
    outputs.at[i] = vec4(phaseMeanCosine(phase));
    return;
  }
  if (kMode == 1u) {
    outputs.at[i] = vec4(directions.at[i], value(directions.at[i]));
    return;
  }
  Rng rng = rngSeed(uvec2(i, 17u), 3u, 99u);
  Phase sampled = phase;
  if (kPlanted == kWrongSign) {
    sampled.parameters.xy = -sampled.parameters.xy;
  }
  vec3 dOut = phaseSample(sampled, dIn, rng);
  float pdf = value(dOut);
  if (kPlanted == kBranchPdf) {
    const float g = rngFloat(rng) < phase.parameters.z ? phase.parameters.x : phase.parameters.y;
    dOut = henyeyGreensteinLobeSample(g, dIn, rngFloat2(rng));
    pdf = henyeyGreensteinLobeEval(g, dIn, dOut);
  }
  if (kPlanted == kWrongJacobian) {
    const vec2 xi = rngFloat2(rng);
    dOut = directionAbout(dIn, 1.0 - cos(kPi * xi.x), xi.y);
  }
  outputs.at[i] = vec4(dOut, pdf);
}

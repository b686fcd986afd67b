#version 460
// SPDX-License-Identifier: Apache-2.0
// The von Mises-Fisher lobe: samples with their pdf (kMode 0), pdfs of given directions (kMode 1), samples of given
// (kappa, xi) (kMode 2), concentrations of given means of 1 - cos (kMode 3). kPlanted puts a known bug in.
#extension GL_GOOGLE_include_directive : require
#include "core/rng.glsl"
#include "guide/vmf.glsl"
#include "interop/basic.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(constant_id = 1) const uint kPlanted = 0u;
const uint kCosinePdf = 1u;    // pdf by the cosine instead of by the difference of the vectors
const uint kCosineSample = 2u; // draws the cosine by the textbook's formula instead of 1 - cos
const uint kNoNormalisation = 3u;
const uint kWiderLobe = 4u;      // draws from half the concentration
const uint kZeroNotSpecial = 5u; // divides by kappa = 0
const uint kSmallAngles = 6u;    // sin = sqrt(2 (1 - cos)), which is not unit
const uint kTextbookKappa = 7u;  // concentration by the mean cosine
const uint kUniformAngle = 8u;   // polar angle drawn where its cosine should be

layout(push_constant, scalar) uniform Push {
  vec3 mu;
  float kappa;
  uint count;
  vec3Ptr inputs;
  vec4Ptr outputs; // (direction, pdf), or the concentration
};

float pdfOf(float concentration, vec3 w) {
  switch (kPlanted) {
  case kCosinePdf:
    return kInvTwoPi * concentration / oneMinusExp(2.0 * concentration) * exp(concentration * (dot(mu, w) - 1.0));
  case kNoNormalisation:
    return kInvFourPi * exp(-concentration * oneMinusCosBetween(mu, w));
  case kZeroNotSpecial:
    return kInvTwoPi * concentration / oneMinusExp(2.0 * concentration) *
           exp(-concentration * oneMinusCosBetween(mu, w));
  }
  return vmfPdf(mu, concentration, w);
}

vec3 sampleOf(float concentration, vec2 xi) {
  switch (kPlanted) {
  case kCosineSample: {
    const float cosine = 1.0 + log(xi.y + (1.0 - xi.y) * exp(-2.0 * concentration)) / concentration;
    return frameAbout(mu) * vec3(safeSqrt(1.0 - cosine * cosine) * cosSinTurns(xi.x), cosine);
  }
  case kWiderLobe:
    return vmfSample(mu, 0.5 * concentration, xi);
  case kSmallAngles: {
    const float oneMinusCos = oneMinusCosBetween(mu, vmfSample(mu, concentration, xi));
    return frameAbout(mu) * vec3(sqrt(2.0 * oneMinusCos) * cosSinTurns(xi.x), 1.0 - oneMinusCos);
  }
  case kUniformAngle:
    return directionAbout(mu, 1.0 - cos(kPi * xi.y), xi.x);
  }
  return vmfSample(mu, concentration, xi);
}

float kappaOf(float oneMinusCos) {
  if (kPlanted == kTextbookKappa) {
    const float r = max(1.0 - oneMinusCos, 0.0);
    return (3.0 * r - r * r * r) / (1.0 - r * r);
  }
  return vmfKappa(oneMinusCos);
}

vec4 sampleAndPdf(float concentration, vec2 xi) {
  const vec3 w = sampleOf(concentration, xi);
  return vec4(w, pdfOf(concentration, w));
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) {
    return;
  }
  if (kMode == 0u) {
    Rng rng = rngSeed(uvec2(i, 23u), 4u, 61u);
    outputs.at[i] = sampleAndPdf(kappa, rngFloat2(rng));
    return;
  }
  const vec3 given = inputs.at[i];
  switch (kMode) {
  case 1u:
    outputs.at[i] = vec4(given, pdfOf(kappa, given));
    break;
  case 2u:
    outputs.at[i] = sampleAndPdf(given.x, given.yz);
    break;
  default:
    outputs.at[i] = vec4(kappaOf(given.x));
  }
}

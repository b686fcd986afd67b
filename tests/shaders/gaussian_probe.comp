#version 460
// SPDX-License-Identifier: Apache-2.0
// The truncated normal distribution: samples with their pdf (kMode 0), pdfs at given places (kMode 1), the error function
// and its inverse (kMode 2). And what distance chains make of samples (kMode 3). kPlanted puts a known bug in.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "core/gaussian.glsl"
#include "core/rng.glsl"
#include "interop/basic.h"
#include "interop/guide.h"

const bool kGuideFit = true;
const bool kGuideLearn = true;
const bool kGuideMotion = false;
const bool kGuideNormals = false;
const bool kGuideOrdered = false;
const bool kGuideShare = true;
const bool kGuideStatic = false;
const uint kGuideStates = 1u;
const uint kGuideWeight = 0u;
#include "guide/distance_chains.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(constant_id = 1) const uint kPlanted = 0u;
const uint kNotTruncated = 1u;  // density and samples of the whole distribution
const uint kMeanOfSquares = 2u; // the variance as a mean of squares less the square of the mean
const uint kSecondSide = 3u;    // as much above the mean as below

layout(push_constant, scalar) uniform Push {
  vec4 shape; // mean, sigma, first, last
  uint count;
  vec2Ptr inputs;
  vec2Ptr outputs;
};

TruncatedGaussian gaussian() {
  TruncatedGaussian g = truncatedGaussian(shape.x, shape.y, shape.z, shape.w);
  if (kPlanted == kNotTruncated) {
    g.below = 0.5;
    g.above = 0.5;
  } else if (kPlanted == kSecondSide) {
    g.above = g.below;
  }
  return g;
}

// A chain fed with the samples in turn: its deviation, and its mean less the first of them.
vec2 chainOf() {
  DistanceState state = kNoDistance;
  float squares = 0.0;
  for (uint i = 0u; i < count; ++i) {
    const vec2 taken = inputs.at[i]; // distance, score
    distanceTake(state, taken.x, taken.y, 1.0 / float(i + 1u));
    squares = mix(squares, taken.x * taken.x, 1.0 / float(i + 1u));
  }
  const float variance = kPlanted == kMeanOfSquares ? squares - state.mean * state.mean : state.variance;
  return vec2(safeSqrt(variance), state.mean - inputs.at[0].x);
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) {
    return;
  }
  const TruncatedGaussian g = gaussian();
  if (kMode == 0u) {
    Rng rng = rngSeed(uvec2(i, 29u), 4u, 67u);
    const float t = truncatedGaussianSample(g, rngFloat(rng));
    outputs.at[i] = vec2(t, truncatedGaussianPdf(g, t));
  } else if (kMode == 1u) {
    outputs.at[i] = vec2(inputs.at[i].x, truncatedGaussianPdf(g, inputs.at[i].x));
  } else if (kMode == 2u) {
    outputs.at[i] = vec2(erfPositive(inputs.at[i].x), erfInverse(inputs.at[i].y));
  } else if (i == 0u) {
    outputs.at[0] = chainOf();
  }
}

// SPDX-License-Identifier: Apache-2.0
// Distance chains in screen space: the mixture of truncated Gaussians that a camera ray draws from, and what the score of
// its event makes of the chains; (102) to (107) of docs/theory.md. Writes are not locked: the last one wins, and a torn
// state is still a density.
#ifndef TYNDALL_GUIDE_DISTANCE_CHAINS_GLSL
#define TYNDALL_GUIDE_DISTANCE_CHAINS_GLSL

#include "core/gaussian.glsl"
#include "guide/learn.glsl"

const DistanceState kNoDistance = DistanceState(0.0, 0.0, 0.0, 0.0);

// The prior's weight against the square of the number of samples, as published.
const float kDistancePrior = 0.2;
// Least sigma over the mean: chains serve the rays of neighbours, and what they have found lies that much nearer or farther
// there. A vertex is 1 to 2 % of the distance wide.
const float kLeastRelativeSigma = 0.005;
// A learnt share rests on samples of about this many fresh ones, ...
const float kDistanceShareMemory = 4096.0;
const uint kDistanceShareSamples = 64u; // ... and is not read before it has so many
// Of the largest share: who never draws from the chains does not learn what they are worth.
const float kLeastDistanceShare = 0.1;
// Its square, summed up, is finite.
const float kMostDistanceScore = 1e15;

bool distanceIsSound(DistanceState state) {
  return state.weight > kLeastChainWeight && state.weight <= kMostChainWeight && isFinite(state.mean) &&
         state.variance >= 0.0 && isFinite(state.variance) && state.count >= 0.0;
}

float distanceSigma(GuidePtr guide, DistanceState state) {
  const float squared = state.count * state.count;
  const float sigma =
      (squared * sqrt(state.variance) + kDistancePrior * guide.at[0].distance.priorSigma) / (squared + kDistancePrior);
  return max(sigma, kLeastRelativeSigma * state.mean);
}

// Takes a sample in, at a rate. The variance is carried on, not made of a mean of squares, which cancels far from the camera.
void distanceTake(inout DistanceState state, float t, float score, float rate) {
  state.weight = mix(state.weight, score, rate);
  const float share = state.weight > 0.0 ? min(rate * score / state.weight, 1.0) : 1.0;
  const float offset = t - state.mean;
  state.mean += share * offset;
  state.variance = (1.0 - share) * (state.variance + share * offset * offset);
}

void distanceAdd(GuidePtr guide, inout DistanceState state, float t, float score) {
  state.count = min(state.count + 1.0, float(kMostChainCount));
  distanceTake(state, t, score, max(1.0 / state.count, guide.at[0].leastRate));
}

// A vertex of the screen's grid near the pixel, by bilinear weights.
uint distanceVertex(GuidePtr guide, uvec2 pixel, inout Rng rng) {
  const uvec2 vertex = uvec2(vec2(pixel) / guide.at[0].distance.width + rngFloat2(rng));
  return vertex.y * guide.at[0].distance.columns + vertex.x;
}

uint distancePlace(GuidePtr guide, uint vertex, inout Rng rng) {
  const uint count = guide.at[0].distance.statesEach;
  return vertex * count + min(uint(rngFloat(rng) * float(count)), count - 1u);
}

// The probability of a guided distance.
float distanceShare(GuidePtr guide, uint vertex) {
  const float most = guide.at[0].distance.mostShare;
  const DistanceShare learnt = guide.at[0].distance.shares.at[vertex];
  const float gains = learnt.flightGain + learnt.guideGain;
  if (!kGuideShare || learnt.samples < kDistanceShareSamples || !(gains > 0.0) || !isFinite(gains)) {
    return most;
  }
  return clamp(learnt.guideGain / gains, kLeastDistanceShare * most, most);
}

// Loads a state as the i-th lobe of the record; returns its weight, 0: it does not serve. `origin`: the ray's, from the
// camera.
float loadDistanceLobe(GuidePtr guide, uint slot, uint i, DistanceState state, vec2 stretch, float origin) {
  const float mean = state.mean - origin;
  const bool serves = distanceIsSound(state) && mean >= stretch.x && mean <= stretch.y;
  const float sigma = distanceSigma(guide, state);
  const TruncatedGaussian g = truncatedGaussian(mean, sigma, stretch.x, stretch.y);
  const float peak = state.weight * truncatedGaussianPeak(g);
  if (!serves || !(peak > 0.0) || !isFinite(peak)) {
    guide.at[0].distance.records.at[slot].lobes[i] = DistanceLobe(0.0, 0.0, 1.0);
    return 0.0;
  }
  guide.at[0].distance.records.at[slot].lobes[i] = DistanceLobe(peak, mean, sigma);
  return state.weight;
}

// Loads the mixture for a part of a pixel's ray into the record of the path at `slot`. False: there are no chains.
bool loadDistances(GuidePtr guide, uint slot, uvec2 pixel, vec2 stretch, float origin, inout Rng rng) {
  DistanceRecordPtr records = guide.at[0].distance.records;
  DistanceState chosen = kNoDistance;
  float sum = 0.0;
  uint vertex = 0u;
  [[dont_unroll]] for (uint i = 0u; i < guide.at[0].distance.loads; ++i) {
    vertex = distanceVertex(guide, pixel, rng);
    const DistanceState state = guide.at[0].distance.states.at[distancePlace(guide, vertex, rng)];
    const float weight = loadDistanceLobe(guide, slot, i, state, stretch, origin);
    sum += weight;
    if (weight > 0.0 && rngFloat(rng) * sum <= weight) {
      chosen = state;
    }
  }
  [[dont_unroll]] for (uint i = 0u; i < guide.at[0].distance.loads; ++i) {
    records.at[slot].lobes[i].peak /= max(sum, kLeastChainWeight);
  }
  records.at[slot].stretch = stretch;
  records.at[slot].chosen = chosen;
  records.at[slot].meanWeight = sum / float(guide.at[0].distance.loads);
  records.at[slot].vertex = vertex;
  records.at[slot].t = -1.0;
  return sum > 0.0;
}

// Density of the loaded mixture at distance t from the ray's origin [1/unit].
float distanceDensity(GuidePtr guide, uint slot, float t) {
  DistanceRecordPtr records = guide.at[0].distance.records;
  const vec2 stretch = records.at[slot].stretch;
  if (t < stretch.x || t > stretch.y) {
    return 0.0;
  }
  float density = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < guide.at[0].distance.loads; ++i) {
    const DistanceLobe lobe = records.at[slot].lobes[i];
    const float deviations = (t - lobe.mean) / lobe.sigma;
    density += lobe.peak * exp(-0.5 * deviations * deviations);
  }
  return density;
}

// A distance from the ray's origin, of the state that was chosen.
float distanceSample(GuidePtr guide, uint slot, float origin, float xi) {
  const DistanceState chosen = guide.at[0].distance.records.at[slot].chosen;
  const vec2 stretch = guide.at[0].distance.records.at[slot].stretch;
  const float sigma = distanceSigma(guide, chosen);
  return truncatedGaussianSample(truncatedGaussian(chosen.mean - origin, sigma, stretch.x, stretch.y), xi);
}

// What free flight and the chains account for of the second moment of what the ray has found.
void learnDistanceShare(GuidePtr guide, uint vertex, float guidedPart, float score) {
  const float squared = score * score;
  DistanceShare learnt = guide.at[0].distance.shares.at[vertex];
  const float keep = 1.0 - 1.0 / kDistanceShareMemory;
  learnt.flightGain = keep * learnt.flightGain + (1.0 - guidedPart) * squared;
  learnt.guideGain = keep * learnt.guideGain + guidedPart * squared;
  learnt.samples = min(learnt.samples + 1u, 1u << 20);
  guide.at[0].distance.shares.at[vertex] = learnt;
}

// The path is over. `found`: luminance of the sample.
void learnDistance(GuidePtr guide, uint slot, uvec2 pixel, float found, inout Rng rng) {
  DistanceRecordPtr records = guide.at[0].distance.records; // field by field: loads by address cost
  const float score = found - records.at[slot].before;
  if (!isFinite(score) || !(score <= kMostDistanceScore)) {
    ++learnUnsound;
    return;
  }
  if (kGuideShare && records.at[slot].share > 0.0) {
    learnDistanceShare(guide, records.at[slot].vertex, records.at[slot].guidedPart, score);
  }
  const float t = records.at[slot].t;
  if (t < 0.0 || !(score > kLeastChainWeight) || rngFloat(rng) * records.at[slot].meanWeight >= score) {
    return;
  }
  DistanceState state = records.at[slot].chosen;
  distanceAdd(guide, state, t, score);
  if (distanceIsSound(state)) {
    guide.at[0].distance.states.at[distancePlace(guide, distanceVertex(guide, pixel, rng), rng)] = state;
  }
}

#endif

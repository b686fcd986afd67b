// SPDX-License-Identifier: Apache-2.0
// What the score of a sample does to states, chains or fitted, and to the share of scattering; (90)-(93), (98)-(100).
#ifndef TYNDALL_GUIDE_LEARN_GLSL
#define TYNDALL_GUIDE_LEARN_GLSL

#include "guide/chain.glsl"
#include "guide/hash_grid.glsl"
#include "guide/log.glsl"

uint learnAccepted = 0u;
uint learnForgotten = 0u;
uint learnUnsound = 0u;

// Luminance alone steers chains: a scalar that colours of light cannot cancel in.
float scoreOf(vec3 value) { return dot(max(value, vec3(0.0)), vec3(0.299, 0.587, 0.114)); }

GuideUpdate updateOf(uint kind, uint place, uint fingerprint, ChainState state) {
  GuideUpdate update;
  update.kind = kind;
  update.place = place;
  update.fingerprint = fingerprint;
  update.point = vec3(0.0);
  update.state = state;
  return update;
}

void storeChain(GuidePtr guide, ChainState state, vec3 point, vec3 facing, inout Rng rng) {
  CellKey key = adaptiveKey(guide, GridPlace(point, guide.at[0].camera, facing), kGuideNormals, rng);
  submit(guide, updateOf(kUpdateChain, key.window, key.fingerprint, state));
  if (kGuideStatic) {
    key = staticKey(guide, point, rng);
    submit(guide, updateOf(kUpdateChain, key.window, key.fingerprint, state));
  }
}

// A sample goes to both grids; one that has found nothing to either, which is enough to tell more misses from fewer.
void storeFit(GuidePtr guide, GuideRecord record, float score, inout Rng rng) {
  const bool both = score > 0.0;
  const bool fine = both || !kGuideStatic || rngFloat(rng) < 0.5;
  ChainState taken = kEmptyState;
  taken.target = record.target;
  taken.weight = score;
  taken.spread = record.scatterPart;
  taken.evidence = rngFloat(rng);
  taken.time = record.scatterPdf;
  setChainMotion(taken, record.velocity, record.source != kNoState ? 1u : 0u);
  GuideUpdate update = updateOf(kUpdateFit, 0u, 0u, taken);
  update.point = record.point;
  if (fine) {
    const CellKey key = adaptiveKey(guide, GridPlace(record.point, guide.at[0].camera, record.normal), kGuideNormals, rng);
    update.place = key.window;
    update.fingerprint = key.fingerprint;
    submit(guide, update);
  }
  if (kGuideStatic && (both || !fine)) {
    const CellKey key = staticKey(guide, record.point, rng);
    update.place = key.window;
    update.fingerprint = key.fingerprint;
    submit(guide, update);
  }
}

// A guided sample that found almost nothing where its lobe says that there is light: within the part of the lobe that a
// tenth of its samples fall into.
void forget(GuidePtr guide, GuideRecord record, float score) {
  const vec3 mu = vec3(record.mu[0], record.mu[1], record.mu[2]);
  const bool trusted = oneMinusCosBetween(mu, record.direction) * max(record.kappa, 1.0) <= 0.1;
  if (!trusted || score > guide.at[0].forgetBelow * record.state.weight) {
    return;
  }
  ++learnForgotten;
  ChainState miss = kEmptyState;
  miss.weight = score;
  submit(guide, updateOf(kUpdateMiss, record.source, floatBitsToUint(record.state.weight), miss));
}

// What the lobe of a state drew.
void storeSample(GuidePtr guide, GuideRecord record, float score, bool accepted) {
  ChainState drawn = kEmptyState;
  drawn.target = record.target;
  drawn.weight = score;
  drawn.evidence = accepted ? 1.0 : 0.0;
  setChainMotion(drawn, record.velocity, 1u);
  GuideUpdate update = updateOf(kUpdateSample, record.source, floatBitsToUint(record.state.weight), drawn);
  update.point = record.point;
  submit(guide, update);
}

// One vertex learns from `value`, what its direction has found times scattering over the density.
void learn(GuidePtr guide, GuideRecord record, vec3 value, inout Rng rng) {
  const float score = scoreOf(value);
  if (!isFinite(score)) {
    ++learnUnsound;
    return;
  }
  if (kGuideFit) {
    const bool found = score > kLeastChainWeight;
    learnAccepted += found ? 1u : 0u;
    if (found || record.source != kNoState && guide.at[0].forgetRate > 0.0) {
      storeFit(guide, record, found ? score : 0.0, rng);
    }
    return;
  }
  if (kGuideShare && record.cell != kNoCell && score > 0.0) {
    ChainState gains = kEmptyState;
    gains.weight = score * sqrt(record.scatterPart);
    gains.spread = score * safeSqrt(1.0 - record.scatterPart);
    submit(guide, updateOf(kUpdateShare, record.cell, 0u, gains));
  }
  const bool accepted = score > kLeastChainWeight && rngFloat(rng) * record.meanWeight < score;
  const bool guided = record.source != kNoState;
  if (kGuideWeight == kWeightMean && guided) {
    storeSample(guide, record, score, accepted);
  }
  if (accepted) {
    ChainState state = record.state;
    chainAdd(guide, state, record.point, record.target, record.velocity, score, true);
    if (chainIsSound(state)) {
      ++learnAccepted;
      storeChain(guide, state, record.point, record.normal, rng);
    }
  } else if (kGuideWeight == kWeightForgets && guided) {
    forget(guide, record, score);
  }
}

// Outgoing radiance of the place, for the scores of vertices that see it.
vec3 cachedRadiance(GuidePtr guide, vec3 point, vec3 facing, inout Rng rng) {
  const CellKey key = radianceKey(guide, point, facing, rng);
  const uint cell = findRadiance(guide.at[0].radiance, key, guide.at[0].window);
  if (cell == kNoCell) {
    return vec3(0.0);
  }
  const vec3 radiance = guide.at[0].radiance.at[cell].radiance;
  return isFinite(radiance) ? max(radiance, vec3(0.0)) : vec3(0.0);
}

void cacheRadiance(GuidePtr guide, GuideRecord record, vec3 value, inout Rng rng) {
  const CellKey key = radianceKey(guide, record.point, record.normal, rng);
  ChainState outgoing = kEmptyState;
  outgoing.target = value;
  submit(guide, updateOf(kUpdateRadiance, key.window, key.fingerprint, outgoing));
}

#endif

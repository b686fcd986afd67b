// SPDX-License-Identifier: Apache-2.0
// Cells whose states are fitted together: a sample counts for each of them as far as it is responsible, so that their
// weighted lobes become the distribution of what the cell's vertices find; (98)-(100) of docs/theory.md.
#ifndef TYNDALL_GUIDE_FIT_GLSL
#define TYNDALL_GUIDE_FIT_GLSL

#include "guide/chain.glsl"

// A sample that a cell takes in.
struct FitSample {
  vec3 point;    // where its direction was drawn
  vec3 target;   // what it met
  vec3 velocity; // of the target [units/s]
  float score;
};

// Takes `part` of a sample in. `rate`: of the cell's means. The target is where it is now.
void fitAdd(GuidePtr guide, inout ChainState state, FitSample taken, float part, float rate) {
  state.time = guide.at[0].time;
  state.weight = (1.0 - rate) * state.weight + rate * part * taken.score;
  if (!(part > 0.0 && state.weight > 0.0)) {
    return;
  }
  const vec3 own = taken.target - taken.point;
  const vec3 before = state.target - taken.point;
  const float far = sqrt(dot(own, own));
  const float share = min(rate * part * taken.score / state.weight, 1.0);
  // Means over directions, not places: a distant hit must not pull the target to its side.
  const float nearer = state.evidence > 0.0 && far > 0.0 ? min(share * sqrt(dot(before, before)) / far, 1.0) : 1.0;
  state.target = mix(state.target, taken.target, nearer);
  const vec3 mean = state.target - taken.point;
  const float spread = far > 0.0 && dot(mean, mean) > 0.0
                           ? oneMinusCosBetween(normalize(mean), own / far)
                           : 1.0;
  state.spread = clamp(mix(state.spread, spread, share), 0.0, 2.0);
  state.evidence = min(state.evidence + part, float(kMostChainCount));
  setChainMotion(state, mix(chainVelocity(state), taken.velocity, nearer), 1u);
}

// The states of `cell` take a sample in that is its `count`th. `xi`: whether it becomes a state of its own, where those
// that there are hardly explain it.
void fitCell(GuidePtr guide, uint cell, uint count, FitSample taken, float xi) {
  const uint first = cell * kGuideStates;
  const float rate = max(1.0 / float(max(count, 1u)), guide.at[0].leastRate); // 0: just evicted
  const vec3 direction = normalize(taken.target - taken.point);
  float densities[kMostLobes];
  float sum = 0.0;
  float total = 0.0;
  float leastWeight = kMostChainWeight;
  uint least = 0u;
  [[dont_unroll]] for (uint i = 0u; i < kGuideStates; ++i) {
    ChainState state = guide.at[0].states.at[first + i];
    densities[i] = 0.0;
    float weight = 0.0;
    if (chainIsSound(state)) {
      if (kGuideMotion) {
        moveTarget(guide, state);
      }
      const Lobe lobe = chainLobe(guide, state, taken.point);
      densities[i] = lobe.peak * exp(-lobe.kappa * oneMinusCosBetween(lobe.mu, direction));
      weight = state.weight;
    }
    sum += densities[i];
    total += weight;
    if (weight < leastWeight) {
      leastWeight = weight;
      least = i;
    }
  }
  if (count > 8u && total > 0.0) { // a cell without sound states begins anew
    taken.score = min(taken.score, guide.at[0].radianceLimit * total);
  }
  const float background = guide.at[0].newbornShare * total * kInvFourPi;
  const bool alone = !(sum > 0.0) || xi * (sum + background) < background && rate * taken.score > leastWeight;
  [[dont_unroll]] for (uint i = 0u; i < kGuideStates; ++i) {
    ChainState state = guide.at[0].states.at[first + i];
    const float part = alone ? (i == least ? 1.0 : 0.0) : densities[i] / sum;
    if (alone && i == least || !chainIsSound(state)) {
      state = kEmptyState;
    } else if (kGuideMotion) {
      moveTarget(guide, state);
    }
    fitAdd(guide, state, taken, part, rate);
    guide.at[0].states.at[first + i] = state;
  }
}

#endif

// SPDX-License-Identifier: Apache-2.0
// States of Markov chains: the lobe that one is at a place, and what a sample makes of it; (83)-(85) of docs/theory.md.
#ifndef TYNDALL_GUIDE_CHAIN_GLSL
#define TYNDALL_GUIDE_CHAIN_GLSL

#include "guide/vmf.glsl"
#include "interop/guide.h"

struct Lobe {
  vec3 mu;
  float kappa;
  float weight; // 0: there is none
  float peak;   // weight times the density at mu [1/sr]
};

const Lobe kNoLobe = Lobe(vec3(0.0, 0.0, 1.0), 0.0, 0.0, 0.0);

const ChainState kEmptyState = ChainState(vec3(0.0), 0.0, 0.0, 0.0, 0.0, 0u, 0u);

uint chainCount(ChainState state) { return state.velocityZCount >> 16; }

vec3 chainVelocity(ChainState state) {
  return vec3(unpackHalf2x16(state.velocityXY), unpackHalf2x16(state.velocityZCount & 0xffffu).x);
}

// Halves overflow at 65504: what moves that fast has jumped, and its speed foretells nothing.
void setChainMotion(inout ChainState state, vec3 velocity, uint count) {
  const vec3 sound = all(lessThan(abs(velocity), vec3(60000.0))) ? velocity : vec3(0.0);
  state.velocityXY = packHalf2x16(sound.xy);
  state.velocityZCount = packHalf2x16(vec2(sound.z, 0.0)) & 0xffffu | count << 16;
}

// Times the peak of the narrowest lobe, and kMostLobes of them together, it is still finite.
const float kMostChainWeight = 1e30;

// Whether a state may be used. Torn writes and numbers out of range are as good as none.
bool chainIsSound(ChainState state) {
  return state.weight > kLeastChainWeight && state.weight <= kMostChainWeight && isFinite(state.target) &&
         state.spread >= 0.0 && state.spread <= 2.0 && state.evidence >= 0.0;
}

// The regularised mean of 1 - cos at a distance: few samples say little of a lobe's width, and sqrt(priorArea) is how
// much of the light one of them is taken for, from whatever distance.
float chainSpread(GuidePtr guide, ChainState state, float squaredDistance) {
  const float count = state.evidence;
  const float prior = max(guide.at[0].priorLeast, guide.at[0].priorArea / squaredDistance);
  return (count * count * state.spread + prior) / (count * count + prior);
}

// The lobe at `point`, aimed at the target from there.
Lobe chainLobe(GuidePtr guide, ChainState state, vec3 point) {
  const vec3 offset = state.target - point;
  const float squared = dot(offset, offset);
  if (!(squared > 0.0) || !isFinite(squared)) {
    return kNoLobe;
  }
  float most = guide.at[0].mostKappa;
  if (guide.at[0].kappaGrowth > 0.0) {
    most *= pow(max(state.evidence, 1.0), guide.at[0].kappaGrowth);
  }
  const float kappa = min(vmfKappa(chainSpread(guide, state, squared)), min(most, 1e6));
  return Lobe(offset * inversesqrt(squared), kappa, state.weight, state.weight * vmfPeak(kappa));
}

// Whether directions may be drawn from it. `horizon`: the normal that lobes must lie above, 0: any will do.
bool lobeServes(Lobe lobe, vec3 horizon) {
  return lobe.peak > 0.0 && isFinite(lobe.peak) && (horizon == vec3(0.0) || dot(horizon, lobe.mu) > 0.0);
}

// The target's place at the frame's time.
void moveTarget(GuidePtr guide, inout ChainState state) {
  state.target += clamp(guide.at[0].time - state.time, 0.0, guide.at[0].mostTime) * chainVelocity(state);
}

// Takes a sample in: `point` is where the direction was drawn, `target` what it met, `score` >= 0.
void chainAdd(GuidePtr guide, inout ChainState state, vec3 point, vec3 target, vec3 velocity, float score, bool accepted) {
  const uint count = min(chainCount(state) + 1u, kMostChainCount);
  const float rate = max(1.0 / float(count), guide.at[0].leastRate);
  state.weight = mix(state.weight, score, rate);
  const float share = state.weight > 0.0 ? min(rate * score / state.weight, 1.0) : 1.0;
  state.evidence = min(state.evidence + (accepted ? 1.0 : 0.0), float(kMostChainCount));
  state.target = mix(state.target, target, share);
  const vec3 mean = state.target - point;
  const vec3 own = target - point;
  const float lengths = sqrt(dot(mean, mean) * dot(own, own));
  const float spread = lengths > 0.0 ? oneMinusCosBetween(mean / sqrt(dot(mean, mean)), own / sqrt(dot(own, own))) : 1.0;
  state.spread = clamp(mix(state.spread, min(spread, 1.0), share), 0.0, 2.0);
  state.time = guide.at[0].time;
  setChainMotion(state, velocity, count);
}

#endif

// SPDX-License-Identifier: Apache-2.0
// How a fitted state notices that its light has gone: its lobe misses far more often in a row than it used to. Light that
// a lobe finds rarely is not forgotten for that; (108) of docs/theory.md.
#ifndef TYNDALL_GUIDE_FIT_MISSES_GLSL
#define TYNDALL_GUIDE_FIT_MISSES_GLSL

#include "guide/chain.glsl"

// In place of a chain's number of samples: misses since the last hit, and their usual number in 32nds.
const uint kMissBits = 7u;
const uint kMostMisses = (1u << kMissBits) - 1u;
const uint kMostRun = (1u << 9u) - 1u;
// A state that is new has hit once: that it misses is no news until it has hit more often.
const uint kUnknownRun = kMostRun << kMissBits;

uint missesOf(ChainState state) { return chainCount(state) & kMostMisses; }
float usualRun(ChainState state) { return float(chainCount(state) >> kMissBits) * (1.0 / 32.0); }

// A sample that the state's lobe drew. Runs as long as one in e^5 is take weight away: returns how much.
float noteDraw(GuidePtr guide, inout ChainState state, bool hit) {
  uint misses = missesOf(state);
  float run = usualRun(state);
  float lost = 0.0;
  if (hit) {
    run = mix(run, float(misses), 0.125);
    misses = 0u;
  } else {
    misses = min(misses + 1u, kMostMisses);
    lost = float(misses) > 5.0 * (run + 1.0) ? guide.at[0].forgetRate * state.weight : 0.0;
    state.weight -= lost;
  }
  setChainMotion(state, chainVelocity(state), misses | min(uint(run * 32.0 + 0.5), kMostRun) << kMissBits);
  return lost;
}

#endif

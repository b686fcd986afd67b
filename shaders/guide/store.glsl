// SPDX-License-Identifier: Apache-2.0
// Writes to the store. Threads write without locks: the last one wins, and what is torn is still a lobe (chainIsSound), so
// that only the variance knows. With kGuideOrdered one thread writes to a window, in an order that is always the same.
#ifndef TYNDALL_GUIDE_STORE_GLSL
#define TYNDALL_GUIDE_STORE_GLSL

#include "guide/chain.glsl"
#include "guide/fit.glsl"
#include "guide/hash_grid.glsl"

uint storeEvicted = 0u;

// The cell for a key: its own, else a free one, else the one that was written longest ago.
uint claimCell(GuidePtr guide, uint first, uint fingerprint) {
  GuideCellPtr cells = guide.at[0].cells;
  uint oldest = first;
  uint age = 0u;
  [[dont_unroll]] for (uint i = first; i < first + guide.at[0].window; ++i) {
    const uint own = cells.at[i].fingerprint;
    if (own == fingerprint) {
      cells.at[i].stamp = guide.at[0].round;
      return i;
    }
    const uint rounds = own == 0u ? 0xffffffffu : guide.at[0].round - cells.at[i].stamp;
    if (rounds >= age) {
      oldest = i;
      age = rounds;
    }
  }
  storeEvicted += cells.at[oldest].fingerprint != 0u ? 1u : 0u;
  [[dont_unroll]] for (uint i = 0u; i < kGuideStates; ++i) {
    guide.at[0].states.at[oldest * kGuideStates + i].weight = 0.0;
  }
  cells.at[oldest] = GuideCell(fingerprint, guide.at[0].round, 0.0, 0.0, 0.0, 0u);
  return oldest;
}

// The state that is replaced: an empty one, else the one of least weight.
uint leastState(GuidePtr guide, uint cell) {
  uint least = cell * kGuideStates;
  float weight = guide.at[0].states.at[least].weight;
  [[dont_unroll]] for (uint i = 1u; i < kGuideStates; ++i) {
    const uint place = cell * kGuideStates + i;
    const float own = guide.at[0].states.at[place].weight;
    if (!(own >= weight)) {
      least = place;
      weight = own;
    }
  }
  return least;
}

void writeChain(GuidePtr guide, GuideUpdate update) {
  const uint cell = claimCell(guide, update.place, update.fingerprint);
  guide.at[0].states.at[leastState(guide, cell)] = update.state;
}

// Whether the state is still the one that drew. In order it is: samples are carried out before states are replaced.
bool stillDraws(ChainState state, GuideUpdate update) {
  return kGuideOrdered || floatBitsToUint(state.weight) == update.fingerprint;
}

void writeSample(GuidePtr guide, GuideUpdate update) {
  ChainState state = guide.at[0].states.at[update.place];
  if (stillDraws(state, update)) {
    if (kGuideMotion) {
      moveTarget(guide, state);
    }
    chainAdd(guide, state, update.point, update.state.target, chainVelocity(update.state), update.state.weight,
             update.state.evidence > 0.0);
    guide.at[0].states.at[update.place] = state;
  }
}

void writeMiss(GuidePtr guide, GuideUpdate update) {
  const ChainState state = guide.at[0].states.at[update.place];
  if (stillDraws(state, update)) {
    guide.at[0].states.at[update.place].weight = mix(state.weight, update.state.weight, guide.at[0].forgetRate);
  }
}

float rootSum(float root, float term, float keep) {
  const float most = max(root, term);
  return most > 0.0 ? most * sqrt(keep * (root / most) * (root / most) + (term / most) * (term / most)) : 0.0;
}

// Old samples fade: the share follows what the chains have become.
void addShare(GuidePtr guide, uint cell, vec2 gains) {
  GuideCellPtr cells = guide.at[0].cells;
  const float keep = 1.0 - 1.0 / 256.0;
  cells.at[cell].scatterGain = rootSum(cells.at[cell].scatterGain, gains.x, keep);
  cells.at[cell].guideGain = rootSum(cells.at[cell].guideGain, gains.y, keep);
  cells.at[cell].samples = min(cells.at[cell].samples + 1u, 1u << 20);
}

void writeShare(GuidePtr guide, GuideUpdate update) {
  addShare(guide, update.place, vec2(update.state.weight, update.state.spread));
}

// A mean over at most 128 samples. A sample far above it counts for less: the cache steers chains, and one of them must
// not see what a single path has met by chance.
void writeRadiance(GuidePtr guide, GuideUpdate update) {
  RadianceCellPtr cells = guide.at[0].radiance;
  uint place = update.place;
  uint age = 0u;
  bool own = false;
  [[dont_unroll]] for (uint i = update.place; i < update.place + guide.at[0].window && !own; ++i) {
    own = cells.at[i].fingerprint == update.fingerprint;
    const uint rounds = cells.at[i].fingerprint == 0u ? 0xffffffffu : guide.at[0].round - cells.at[i].stamp;
    if (own || rounds >= age) {
      place = i;
      age = rounds;
    }
  }
  RadianceCell cell = RadianceCell(update.fingerprint, guide.at[0].round, 0u, vec3(0.0));
  if (own) {
    cell = cells.at[place];
  }
  vec3 value = update.state.target;
  const float mean = dot(cell.radiance, vec3(1.0));
  const float sum = dot(value, vec3(1.0));
  if (cell.count >= 8u && sum > guide.at[0].radianceLimit * mean) {
    value *= guide.at[0].radianceLimit * mean / sum;
  }
  cell.stamp = guide.at[0].round;
  cell.count = min(cell.count + 1u, 128u);
  cell.radiance = mix(cell.radiance, value, 1.0 / float(cell.count));
  if (isFinite(cell.radiance)) {
    cells.at[place] = cell;
  }
}

void writeFit(GuidePtr guide, GuideUpdate update) {
  if (!(update.state.weight >= 0.0 && update.state.weight <= kMostChainWeight)) {
    return; // states of such weights would be unsound
  }
  ChainState taken = update.state;
  taken.time = taken.time >= 0.0 ? min(taken.time, 1e6) : 0.0; // products with weights are finite
  uint cell;
  if (taken.weight > 0.0) {
    cell = claimCell(guide, update.place, update.fingerprint);
    addShare(guide, cell, vec2(taken.weight * sqrt(taken.spread), taken.weight * safeSqrt(1.0 - taken.spread)));
  } else {
    cell = findCell(guide.at[0].cells, CellKey(update.place, update.fingerprint), guide.at[0].window);
    if (cell == kNoCell) {
      return; // a miss says nothing of a cell that has found nothing
    }
  }
  fitCell(guide, cell, guide.at[0].cells.at[cell].samples,
          FitSample(update.point, taken.target, chainVelocity(taken), taken.weight, taken.time, chainCount(taken) > 0u),
          taken.evidence);
}

void carryOut(GuidePtr guide, GuideUpdate update) {
  if (update.kind == kUpdateChain) {
    writeChain(guide, update);
  } else if (update.kind == kUpdateSample) {
    writeSample(guide, update);
  } else if (update.kind == kUpdateMiss) {
    writeMiss(guide, update);
  } else if (update.kind == kUpdateShare) {
    writeShare(guide, update);
  } else if (kGuideFit && update.kind == kUpdateFit) {
    writeFit(guide, update);
  } else if (kGuideCache) {
    writeRadiance(guide, update);
  }
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Writes to the store. Threads write without locks: the last one wins, and what is torn is still a lobe (chainIsSound), so
// that only the variance knows.
#ifndef TYNDALL_GUIDE_STORE_GLSL
#define TYNDALL_GUIDE_STORE_GLSL

#include "guide/chain.glsl"
#include "guide/hash_grid.glsl"

const uint kUpdateChain = 0u;     // a state for a vertex
const uint kUpdateState = 1u;     // what a state becomes, if it still has the old weight
const uint kUpdateShare = 2u;     // gains of a cell
const uint kUpdateRadiance = 3u;  // a sample of the cache

// A write to the store, as a value.
struct GuideUpdate {
  uint kind;           // kUpdate*
  uint place;          // first cell of the window; State: the state; Share: the cell
  uint fingerprint;    // State: bits of the old weight
  ChainState state;    // Share: weight, spread = gains; Radiance: target = sample
};

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
  cells.at[oldest] = GuideCell(fingerprint, guide.at[0].round, 0.0, 0.0, 0u);
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

void writeState(GuidePtr guide, GuideUpdate update) {
  if (floatBitsToUint(guide.at[0].states.at[update.place].weight) == update.fingerprint) {
    guide.at[0].states.at[update.place] = update.state;
  }
}

float rootSum(float root, float term, float keep) {
  const float most = max(root, term);
  return most > 0.0 ? most * sqrt(keep * (root / most) * (root / most) + (term / most) * (term / most)) : 0.0;
}

// Old samples fade: the share follows what the chains have become.
void writeShare(GuidePtr guide, GuideUpdate update) {
  GuideCellPtr cells = guide.at[0].cells;
  const float keep = 1.0 - 1.0 / 256.0;
  cells.at[update.place].scatterGain = rootSum(cells.at[update.place].scatterGain, update.state.weight, keep);
  cells.at[update.place].guideGain = rootSum(cells.at[update.place].guideGain, update.state.spread, keep);
  cells.at[update.place].samples = min(cells.at[update.place].samples + 1u, 1u << 20);
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

void carryOut(GuidePtr guide, GuideUpdate update) {
  if (update.kind == kUpdateChain) {
    writeChain(guide, update);
  } else if (update.kind == kUpdateState) {
    writeState(guide, update);
  } else if (update.kind == kUpdateShare) {
    writeShare(guide, update);
  } else if (kGuideCache) {
    writeRadiance(guide, update);
  }
}

#endif

// SPDX-License-Identifier: Apache-2.0
// The mixture that directions are drawn from at a vertex: scattering's own directions, and lobes of chain states that
// cells near the vertex hold. Whatever the states are, the density is that of the draw, given them: (89).
#ifndef TYNDALL_GUIDE_MIXTURE_GLSL
#define TYNDALL_GUIDE_MIXTURE_GLSL

#include "guide/chain.glsl"
#include "guide/hash_grid.glsl"

const uint kLobes = kGuideLoads * kGuideStates;

struct Mixture {
  Lobe lobes[kMostLobes];
  float weightSum;
  float scatterShare;  // probability of scattering's own directions; 1 without lobes
  Lobe chosen;         // in proportion to the weights
  uint places[kMostLobes]; // of the lobes' states in the store; not where states are fitted
  uint source;         // of the chosen lobe's
  uint cell;           // one of those that were found, or kNoCell; in screen space: the pixel's chain
};

// Of the vertex at hand. Private memory: an array handed to functions would be copied at every call.
Mixture mixture;

// What was counted in this invocation.
uint mixtureVertices = 0u;
uint mixtureStates = 0u;
uint mixtureGuided = 0u;

void clearMixture() {
  mixture.weightSum = 0.0;
  mixture.scatterShare = 1.0;
  mixture.chosen = kNoLobe;
  mixture.source = kNoState;
  mixture.cell = kNoCell;
}

// Whether there are lobes to be drawn from.
bool mixtureHolds() { return mixture.weightSum > 0.0 && isFinite(mixture.weightSum); }

// Takes a lobe in as the i-th; `place`: of its state. `horizon`: see loadMixture.
void addLobe(uint i, Lobe lobe, uint place, vec3 horizon) {
  if (!lobeServes(lobe, horizon)) {
    return;
  }
  mixture.lobes[i] = lobe;
  mixture.weightSum += lobe.weight;
  ++mixtureStates;
  if (!kGuideFit) {
    mixture.places[i] = place;
  }
}

// Chooses one of the lobes, once all are there.
void chooseLobe(inout Rng rng) {
  float left = rngFloat(rng) * mixture.weightSum;
  [[unroll]] for (uint i = 0u; i < kLobes; ++i) {
    if (left >= 0.0 && mixture.lobes[i].weight > 0.0) { // rounding must not lead past the last one
      mixture.chosen = mixture.lobes[i];
      mixture.source = kGuideFit ? kNoState : mixture.places[i];
    }
    left -= mixture.lobes[i].weight;
  }
}

void loadLobe(GuidePtr guide, uint place, bool found, uint i, vec3 point, vec3 horizon) {
  mixture.lobes[i] = kNoLobe;
  if (!found) {
    return;
  }
  ChainState state = guide.at[0].states.at[place];
  if (!chainIsSound(state)) {
    return;
  }
  if (kGuideMotion) {
    moveTarget(guide, state);
  }
  addLobe(i, chainLobe(guide, state, point), place, horizon);
}

// Share of scattering's own directions: in proportion to the squared scores they account for, which the variance is made
// of, within bounds: 1 / share is what a wrong lobe can cost at every event.
float learntShare(GuidePtr guide, vec2 gains, uint samples) {
  const float sum = gains.x + gains.y;
  return samples < guide.at[0].shareSamples || !(sum > 0.0) ? guide.at[0].scatterShare
                                                      : clamp(gains.x / sum, guide.at[0].leastShare, guide.at[0].mostShare);
}

uint drawnCell(GuidePtr guide, GridPlace place, inout Rng rng) {
  const bool coarse = kGuideStatic && rngFloat(rng) >= guide.at[0].adaptiveShare;
  const CellKey key = coarse ? staticKey(guide, place.point, rng) : adaptiveKey(guide, place, kGuideNormals, rng);
  return findCell(guide.at[0].cells, key, guide.at[0].window);
}

// The fine cell if it has learnt enough, else the coarse one.
uint fittedCell(GuidePtr guide, GridPlace place, inout Rng rng) {
  const CellKey fine = adaptiveKey(guide, place, kGuideNormals, rng);
  uint cell = findCell(guide.at[0].cells, fine, guide.at[0].window);
  if (kGuideStatic && (cell == kNoCell || guide.at[0].cells.at[cell].samples < guide.at[0].fitSamples)) {
    cell = findCell(guide.at[0].cells, staticKey(guide, place.point, rng), guide.at[0].window);
  }
  return cell;
}

// Loads the states of the vertex at `point` of the store's space from the cells at `place`. `horizon`: the normal that
// lobes must lie above, 0: any direction counts.
void loadMixture(GuidePtr guide, GridPlace place, vec3 point, vec3 horizon, inout Rng rng) {
  clearMixture();
  vec2 gains = vec2(0.0);
  uint samples = 0u;
  uint found = 0u;
  [[unroll]] for (uint load = 0u; load < kGuideLoads; ++load) {
    const uint cell = kGuideFit ? fittedCell(guide, place, rng) : drawnCell(guide, place, rng);
    if (kGuideShare && cell != kNoCell) {
      const vec2 own = vec2(guide.at[0].cells.at[cell].scatterGain, guide.at[0].cells.at[cell].guideGain);
      const vec2 squared = own * own;
      const float sum = squared.x + squared.y;
      const uint count = guide.at[0].cells.at[cell].samples;
      if (sum > 0.0 && isFinite(sum)) {
        gains += float(min(count, 64u)) * squared / sum;
        samples += count;
      }
      ++found;
    }
    if (kGuideShare && !kGuideFit && cell != kNoCell && (mixture.cell == kNoCell || rngFloat(rng) * float(found) < 1.0)) {
      mixture.cell = cell;
    }
    [[unroll]] for (uint i = 0u; i < kGuideStates; ++i) {
      loadLobe(guide, cell * kGuideStates + i, cell != kNoCell, load * kGuideStates + i, point, horizon);
    }
  }
  ++mixtureVertices;
  if (mixtureHolds()) {
    chooseLobe(rng);
    mixture.scatterShare = kGuideShare ? learntShare(guide, gains, samples) : guide.at[0].scatterShare;
  }
}

// Density of the lobes together [1/sr].
float lobesPdf(vec3 w) {
  if (kPlantedBug == kBugChosenLobe) {
    return mixture.chosen.weight / mixture.weightSum * vmfPdf(mixture.chosen.mu, mixture.chosen.kappa, w);
  }
  float sum = 0.0;
  [[unroll]] for (uint i = 0u; i < kLobes; ++i) {
    sum += mixture.lobes[i].peak * exp(-mixture.lobes[i].kappa * oneMinusCosBetween(mixture.lobes[i].mu, w));
  }
  return sum / mixture.weightSum;
}

// Density of the mixture; `scatter` is that of scattering's own directions.
float mixturePdf(float scatter, vec3 w) {
  if (kPlantedBug == kBugScatterShare && mixture.scatterShare < 1.0) {
    return scatter + (1.0 - mixture.scatterShare) * lobesPdf(w);
  }
  return mixture.scatterShare >= 1.0 ? scatter : mix(lobesPdf(w), scatter, mixture.scatterShare);
}

#endif

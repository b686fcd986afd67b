// SPDX-License-Identifier: Apache-2.0
// Cells whose states are fitted together: a sample counts for scattering and for each of them as far as it is responsible,
// so that scattering and the weighted lobes together become the distribution of what the cell's vertices find, the lobes
// what scattering leaves over; (98)-(100) of docs/theory.md.
#ifndef TYNDALL_GUIDE_FIT_GLSL
#define TYNDALL_GUIDE_FIT_GLSL

#include "guide/chain.glsl"
#include "guide/fit_misses.glsl"

// States that lost weight.
uint fitForgotten = 0u;

// A sample that a cell takes in.
struct FitSample {
  vec3 point;       // where its direction was drawn
  vec3 target;      // what it met
  vec3 velocity;    // of the target [units/s]
  float score;      // 0: it has found nothing
  float scatterPdf; // of scattering's own directions [1/sr]
  bool guided;      // a lobe drew it
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
  // What begins to move leaves its lobe within a few frames: velocities remember a tenth of the samples.
  setChainMotion(state, mix(chainVelocity(state), taken.velocity, min(10.0 * nearer, 1.0)), chainCount(state));
}

// Of a cell's weight, that of a new state: enough to be seen beside the others if it is right, little to lose if not.
const float kNewbornWeight = 0.05;

// What a cell makes of a sample before it takes it in.
struct FitView {
  float densities[kMostLobes]; // weighted, of the lobes
  float sum;                   // of them
  float scatter;               // weighted density of scattering
  float total;                 // of the weights, scattering's among them
  float leastWeight;
  uint least;                  // the state that has it
};

FitView viewSample(GuidePtr guide, uint cell, FitSample taken) {
  const uint first = cell * kGuideStates;
  const vec3 direction = normalize(taken.target - taken.point);
  FitView view;
  view.sum = 0.0;
  view.total = guide.at[0].cells.at[cell].scatterWeight;
  view.scatter = view.total * taken.scatterPdf;
  view.leastWeight = kMostChainWeight;
  view.least = 0u;
  [[dont_unroll]] for (uint i = 0u; i < kGuideStates; ++i) {
    ChainState state = guide.at[0].states.at[first + i];
    view.densities[i] = 0.0;
    float weight = 0.0;
    if (chainIsSound(state)) {
      if (kGuideMotion) {
        moveTarget(guide, state);
      }
      const Lobe lobe = chainLobe(guide, state, taken.point);
      view.densities[i] = lobe.peak * exp(-lobe.kappa * oneMinusCosBetween(lobe.mu, direction));
      weight = state.weight;
    }
    view.sum += view.densities[i];
    view.total += weight;
    if (weight < view.leastWeight) {
      view.leastWeight = weight;
      view.least = i;
    }
  }
  return view;
}

// Scattering's part in what the sample has found. Of a first one, that nothing explains yet, half.
float scatterPartOf(FitView view) {
  const float sum = view.scatter + view.sum;
  return sum > 0.0 ? view.scatter / sum : view.total > 0.0 ? 1.0 : 0.5;
}

// Probability that the sample becomes a state of its own: as far as no lobe explains it, and where one of the states is
// empty or no more than a new one would be. A uniform background stands for directions that scattering hardly knows.
float birthChance(GuidePtr guide, FitView view, FitSample taken) {
  if (!(taken.score > 0.0)) {
    return 0.0;
  }
  if (!(view.total > 0.0)) {
    return 1.0;
  }
  const float others = view.scatter + guide.at[0].newbornShare * view.total * kInvFourPi;
  const float unexplained = others > 0.0 ? others / (others + view.sum) : 0.0;
  if (view.leastWeight <= 0.0) {
    return unexplained;
  }
  const bool replaces = view.leastWeight <= kNewbornWeight * view.total;
  return replaces ? min(guide.at[0].newbornShare * unexplained * taken.score / view.total, 1.0) : 0.0;
}

// Scattering and each state take their part. `born`: the sample becomes a state too, in the place of the least.
void takeIn(GuidePtr guide, uint cell, FitSample taken, FitView view, bool born, float rate) {
  const float scatterPart = scatterPartOf(view);
  const float scatterWeight = guide.at[0].cells.at[cell].scatterWeight;
  guide.at[0].cells.at[cell].scatterWeight = mix(scatterWeight, scatterPart * taken.score, rate);
  const uint first = cell * kGuideStates;
  [[dont_unroll]] for (uint i = 0u; i < kGuideStates; ++i) {
    ChainState state = guide.at[0].states.at[first + i];
    float part = view.sum > 0.0 ? (1.0 - scatterPart) * view.densities[i] / view.sum : 0.0;
    float ownRate = rate;
    if (born && i == view.least) {
      state = kEmptyState;
      setChainMotion(state, vec3(0.0), kUnknownRun);
      part = 1.0;
      ownRate = view.total > 0.0 ? min(kNewbornWeight * view.total / taken.score, 1.0) : 0.5;
    } else if (!chainIsSound(state)) {
      continue;
    } else if (kGuideMotion) {
      moveTarget(guide, state);
    }
    fitAdd(guide, state, taken, part, ownRate);
    guide.at[0].states.at[first + i] = state;
  }
}

// Of the states the one that a sample is put down to, chosen in proportion to the densities. `left`: uniform up to their
// sum.
uint stateBehind(FitView view, float left) {
  uint behind = view.least;
  [[dont_unroll]] for (uint i = 0u; i < kGuideStates; ++i) {
    if (left >= 0.0 && view.densities[i] > 0.0) {
      behind = i;
    }
    left -= view.densities[i];
  }
  return behind;
}

// The samples behind the weight that a cell has lost are forgotten too: it learns anew as fast as one of fewer samples,
// and by scores as they are now what its lobes are worth beside scattering.
void forgetSamples(GuidePtr guide, uint cell, float keep) {
  const float samples = min(float(guide.at[0].cells.at[cell].samples), 1.0 / guide.at[0].leastRate);
  guide.at[0].cells.at[cell].samples = uint(samples * keep);
  guide.at[0].cells.at[cell].scatterGain *= keep;
  guide.at[0].cells.at[cell].guideGain *= keep;
}

// A lobe of the cell drew the sample: the state that it is put down to notes whether it has hit.
void noteSample(GuidePtr guide, uint cell, FitSample taken, FitView view, float xi) {
  const uint behind = cell * kGuideStates + stateBehind(view, xi * view.sum);
  ChainState state = guide.at[0].states.at[behind];
  const float lost = noteDraw(guide, state, taken.score > guide.at[0].forgetBelow * view.total);
  guide.at[0].states.at[behind] = state;
  if (lost > 0.0) {
    ++fitForgotten;
    forgetSamples(guide, cell, 1.0 - lost / view.total);
  }
}

// `cell` takes a sample in that is its `count`th, or notices that one has found nothing. `xi`: whether it becomes a state
// of its own; else, which of them it is put down to.
void fitCell(GuidePtr guide, uint cell, uint count, FitSample taken, float xi) {
  const float rate = max(1.0 / float(max(count, 1u)), guide.at[0].leastRate); // 0: just evicted
  const FitView view = viewSample(guide, cell, taken);
  if (count > 8u && view.total > 0.0) { // a cell that knows nothing begins anew
    taken.score = min(taken.score, guide.at[0].radianceLimit * view.total);
  }
  const float chance = birthChance(guide, view, taken);
  const bool born = xi < chance;
  if (taken.score > 0.0) {
    takeIn(guide, cell, taken, view, born, rate);
  }
  if (taken.guided && !born && view.sum > 0.0) {
    noteSample(guide, cell, taken, view, (xi - chance) / (1.0 - chance));
  }
}

#endif

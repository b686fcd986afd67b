// SPDX-License-Identifier: Apache-2.0
// The store as people may look at it: what the cell that a place lies in holds, without the random choices that paths make
// among cells.
#ifndef TYNDALL_GUIDE_VIEW_GLSL
#define TYNDALL_GUIDE_VIEW_GLSL

#include "guide/mixture.glsl"
#include "interop/guide_view.h"

const GuideView kNoView = GuideView(0u, 0, 0u, 0.0, vec3(0.0), 0.0, 0.0, 0.0);

// The cell around a place, of the level that its distance from the camera stands for.
CellKey nearestKey(GuidePtr guide, vec3 point, vec3 facing, out int level) {
  const GuideLevels levels = guide.at[0].levels;
  level = int(clamp(floor(levelOf(levels, length(point - guide.at[0].camera)) + 0.5), 0.0, 200.0));
  const ivec3 vertex = latticeVertexBy(point, levelWidth(levels, uint(level)), vec3(0.5));
  const uint face = kGuideNormals ? cubeFace(facing, uint(level)) : kNoFace;
  return cellKey(vertex, uint(level), face, 0u, guide.at[0].cellCount, guide.at[0].window);
}

CellKey nearestStaticKey(GuidePtr guide, vec3 point) {
  const ivec3 vertex = latticeVertexBy(point, guide.at[0].staticWidth, vec3(0.5));
  return cellKey(vertex, kStaticLevel, kNoFace, guide.at[0].cellCount, guide.at[0].staticCount, guide.at[0].window);
}

// The fine cell, or the coarse one where that is not there or, of those that are fitted, has learnt too little to be read.
uint viewedCell(GuidePtr guide, vec3 point, vec3 facing, out int level) {
  uint cell = findCell(guide.at[0].cells, nearestKey(guide, point, facing, level), guide.at[0].window);
  const uint least = kGuideFit ? guide.at[0].fitSamples : 0u;
  if (kGuideStatic && (cell == kNoCell || guide.at[0].cells.at[cell].samples < least)) {
    cell = findCell(guide.at[0].cells, nearestStaticKey(guide, point), guide.at[0].window);
    level = kViewCoarse;
  }
  return cell;
}

// (82) of docs/theory.md; near 0 its terms cancel, and it is kappa / 3.
float vmfMeanCosine(float kappa) { return kappa > 0.1 ? 1.0 / tanh(min(kappa, 20.0)) - 1.0 / kappa : kappa / 3.0; }

// Takes a state in. `strongest`: weight of the strongest one so far. `horizon`: see loadMixture.
void viewState(GuidePtr guide, inout GuideView view, ChainState state, vec3 point, vec3 horizon, inout float strongest) {
  if (!chainIsSound(state)) {
    return;
  }
  if (kGuideMotion) {
    moveTarget(guide, state);
  }
  const Lobe lobe = chainLobe(guide, state, point);
  if (!lobeServes(lobe, horizon)) {
    return;
  }
  ++view.states;
  view.weight += lobe.weight;
  if (lobe.weight > strongest) {
    strongest = lobe.weight;
    view.direction = lobe.mu;
    view.cosine = vmfMeanCosine(lobe.kappa);
    view.evidence = state.evidence;
  }
}

GuideView viewCell(GuidePtr guide, vec3 point, vec3 horizon, vec3 facing) {
  GuideView view = kNoView;
  int level;
  const uint cell = viewedCell(guide, point, facing, level);
  if (cell == kNoCell) {
    return view;
  }
  view.fingerprint = guide.at[0].cells.at[cell].fingerprint;
  view.level = level;
  float strongest = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < kGuideStates; ++i) {
    viewState(guide, view, guide.at[0].states.at[cell * kGuideStates + i], point, horizon, strongest);
  }
  const vec2 gains = vec2(guide.at[0].cells.at[cell].scatterGain, guide.at[0].cells.at[cell].guideGain);
  const float learnt = kGuideShare ? learntShare(guide, gains * gains, guide.at[0].cells.at[cell].samples)
                                   : guide.at[0].scatterShare;
  view.share = view.states > 0u ? learnt : 1.0;
  return view;
}

// The pixel's own chain.
GuideView viewScreenChain(GuidePtr guide, uint place, vec3 point, vec3 horizon) {
  GuideView view = kNoView;
  const ScreenChain chain = guide.at[0].screen.at[place];
  if (chain.normal == vec3(0.0)) { // nothing was ever written
    return view;
  }
  view.fingerprint = max(pcg4d(uvec4(place)).x, 1u);
  float strongest = 0.0;
  if (chain.score > kLeastChainWeight) {
    viewState(guide, view, chain.state, point, horizon, strongest);
  }
  view.share = view.states > 0u ? guide.at[0].scatterShare : 1.0;
  return view;
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Chains in screen space, one for each pixel of the picture: the vertex that a pixel sees first reads its own and some of
// those around it; (94)-(97) of docs/theory.md.
#ifndef TYNDALL_GUIDE_SCREEN_CHAINS_GLSL
#define TYNDALL_GUIDE_SCREEN_CHAINS_GLSL

#include "guide/learn.glsl"
#include "guide/mixture.glsl"

// A vertex that a pixel sees first, in the store's space.
struct ScreenVertex {
  uvec2 pixel;
  vec3 point;
  vec3 before; // the point in the previous frame
  vec3 normal;
};

// The chain of a pixel, or of the picture's nearest one.
uint chainOfPixel(GuidePtr guide, ivec2 pixel) {
  const ivec2 inside = clamp(pixel, ivec2(0), ivec2(guide.at[0].screenSize) - 1);
  return uint(inside.y) * guide.at[0].screenSize.x + uint(inside.x);
}

// Where the frame before saw the vertex; at the pixel itself if that lay behind the camera.
ivec2 pixelBefore(GuidePtr guide, ScreenVertex vertex) {
  const vec3 raster = guide.at[0].rasterBefore * vec4(vertex.before, 1.0);
  if (!(raster.z > 0.0)) {
    return ivec2(vertex.pixel);
  }
  const vec2 place = raster.xy / raster.z * vec2(guide.at[0].screenSize);
  return ivec2(clamp(floor(place), vec2(-1e6), vec2(1e6)));
}

// The sum of six uniform numbers has a variance of 1/2: about 10 pixels, 45 at most.
int neighbourOffset(inout Rng rng) {
  const vec3 sum = rngFloat3(rng) + rngFloat3(rng);
  return int(15.0 * (sum.x + sum.y + sum.z - 3.0));
}

// How far a state that was made at another vertex serves this one; `place`: the vertex when the states were made.
float kinship(GuidePtr guide, ScreenChain chain, vec3 place, vec3 normal) {
  const vec3 camera = guide.at[0].camera;
  const float depth = abs(length(chain.point - camera) - length(place - camera));
  return pow(max(dot(normal, chain.normal), 0.0), 64.0) * exp(-depth / guide.at[0].screenDepth);
}

void loadScreenLobe(GuidePtr guide, uint i, uint place, ScreenVertex vertex, vec3 placeThen, vec3 horizon) {
  mixture.lobes[i] = kNoLobe;
  const ScreenChain chain = guide.at[0].screen.at[place];
  if (!chainIsSound(chain.state)) {
    return;
  }
  Lobe lobe = chainLobe(guide, chain.state, vertex.point);
  lobe.weight = chain.score * kinship(guide, chain, placeThen, vertex.normal);
  if (lobe.weight > kLeastChainWeight && lobe.weight <= kMostChainWeight) {
    lobe.peak = lobe.weight * vmfPeak(lobe.kappa);
    addLobe(i, lobe, place, horizon);
  }
}

// Fills the mixture with the lobes of the pixel's own chain and of its neighbours'. `horizon`: see loadMixture.
void loadScreenChains(GuidePtr guide, ScreenVertex vertex, vec3 horizon, inout Rng rng) {
  clearMixture();
  mixture.cell = chainOfPixel(guide, ivec2(vertex.pixel));
  // A difference, since the counter wraps.
  const bool ofThisFrame = int(guide.at[0].screen.at[mixture.cell].round - guide.at[0].frameRound) >= 0;
  const ivec2 centre = ofThisFrame ? ivec2(vertex.pixel) : pixelBefore(guide, vertex);
  const vec3 placeThen = ofThisFrame ? vertex.point : vertex.before;
  loadScreenLobe(guide, 0u, chainOfPixel(guide, centre), vertex, placeThen, horizon);
  [[dont_unroll]] for (uint i = 1u; i < kLobes; ++i) {
    const ivec2 offset = ivec2(neighbourOffset(rng), neighbourOffset(rng));
    loadScreenLobe(guide, i, chainOfPixel(guide, centre + offset), vertex, placeThen, horizon);
    if (kPlantedBug == kBugNoNeighbours) {
      mixture.lobes[i] = kNoLobe;
    }
  }
  ++mixtureVertices;
  if (mixtureHolds()) {
    chooseLobe(rng);
    mixture.scatterShare = guide.at[0].scatterShare;
  }
}

// The pixel's first sample of a round becomes its state, whatever it has found; later ones in proportion to their scores.
void learnOnScreen(GuidePtr guide, GuideRecord record, vec3 value, inout Rng rng) {
  float score = scoreOf(value);
  if (!isFinite(score)) {
    ++learnUnsound;
    return;
  }
  const ScreenChain before = guide.at[0].screen.at[record.cell];
  if (before.round == guide.at[0].round && rngFloat(rng) * before.score > score) {
    return;
  }
  ChainState state = record.state;
  chainAdd(guide, state, record.point, record.target, vec3(0.0), score, true);
  if (!chainIsSound(state)) {
    state = kEmptyState;
    score = 0.0;
  }
  ++learnAccepted;
  guide.at[0].screen.at[record.cell] = ScreenChain(state, record.point, record.normal, score, guide.at[0].round);
}

#endif

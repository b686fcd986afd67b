// SPDX-License-Identifier: Apache-2.0
// The scene's media and grids in private memory: an invocation loads them once, because a load by address inside a
// divergent loop costs a CPU device as much as a cell.
#ifndef TYNDALL_MARCH_MEDIA_GLSL
#define TYNDALL_MARCH_MEDIA_GLSL

#include "interop/march.h"
#include "medium/shape.glsl"
#include "phase/planted.glsl"

// Dimensions of a sample's Sobol point.
const uint kDimPixel = 0u;  // and 1
const uint kDimOffset = 2u;
const uint kDimDisc = 5u;   // and 6
const uint kDimSky = 9u;

const uint kMedia = kHomogeneousMedia + kGridMedia;
const uint kSlotArray = kSlots > 0u ? kSlots : 1u;
const uint kMediaArray = kMedia > 0u ? kMedia : 1u;

Medium media[kMediaArray]; // homogeneous ones first
CellGrid slotGrids[kSlotArray];

void loadScene(ScenePtr scene, MarchScenePtr march) {
  [[unroll]] for (uint m = 0u; m < kMedia; ++m) {
    media[m] = scene.at[0].media.at[m];
  }
  [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
    slotGrids[s] = march.at[0].grids.at[s];
  }
}

// With one slot its number is known when the pipeline is made.
uint slotOf(uint grid) { return kSlots == 1u ? 0u : grid; }

bool hasDensity(uint m) { return kSlots > 0u && m >= kHomogeneousMedia && media[m].densityGrid != kNoGrid; }

// Transmittance of the homogeneous media between a point and a light, in closed form.
float homogeneousTransmittance(vec3 origin, vec3 direction, float tMax) {
  float tau = 0.0;
  [[unroll]] for (uint h = 0u; h < kHomogeneousMedia; ++h) {
    const vec2 interval = mediumInterval(media[h], origin, direction, tMax);
    tau += media[h].sigmaT * max(interval.y - interval.x, 0.0);
  }
  return exp(-tau);
}

#endif

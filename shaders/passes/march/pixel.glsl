// SPDX-License-Identifier: Apache-2.0
// What the samples of a pixel share. It decides where directions are drawn, not what is computed: any weights are
// unbiased, as long as all samples of the pixel are drawn by the same ones.
#ifndef TYNDALL_MARCH_PIXEL_GLSL
#define TYNDALL_MARCH_PIXEL_GLSL

#include "light/cache.glsl"
#include "passes/march/pieces.glsl"

// For a direction that the caches hold to be dark at both places.
const float kLeastVisible = 0.05;

// Walks the ray until its opacity reaches low, then high, both at most 1. Returns these distances and the opacity at
// the end of the walk.
vec3 opacityPlaces(vec3 origin, vec3 direction, float low, float high, vec4 extent, uint maxSteps) {
  const vec2 stretch = beginRay(origin, direction);
  vec3 places = vec3(stretch.xx, 0.0);
  float transmittance = 1.0;
  float t = stretch.x;
  uint cells = 0u;
  [[dont_unroll]] for (uint step = 0u; step < maxSteps && t < stretch.y && 1.0 - transmittance < high; ++step) {
    const Piece piece = nextPiece(extent, t);
    if (piece.t1 >= kInfiniteDistance) {
      break;
    }
    if (piece.media) {
      const vec4 extinction = pieceExtinction(piece, cells);
      transmittance *= exp(-(piece.t1 - piece.t0) * cubicIntegral(extinction, 1.0));
      places.x = 1.0 - transmittance < low ? piece.t1 : places.x;
      places.y = piece.t1;
    }
    leavePiece(piece);
    t = piece.t1;
  }
  places.z = 1.0 - transmittance;
  return places;
}

// Adds half the cached transmittances at a place of the ray that was begun last.
void addSkyVisible(MarchScenePtr march, float t) {
  [[dont_unroll]] for (uint k = 0u; k < kSkyDirections; ++k) {
    float tau = 0.0;
    [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
      const uint index = march.at[0].cacheOf.at[(march.at[0].skyGroup + k) * kSlots + s];
      if (index != kNoCache && slotWalks[s].tEnter <= t && t <= slotWalks[s].tLeave) {
        LightCache cache = march.at[0].skyCaches.at[index];
        tau += lightCacheDepth(cache, slotWalks[s].origin + t * slotWalks[s].direction);
      }
    }
    skyWeights[k] += 0.5 * exp(-tau);
  }
}

// Prepares the pixel whose middle ray is given.
void beginPixel(ScenePtr scene, MarchScenePtr march, vec3 origin, vec3 direction) {
  if (!kSky) {
    return;
  }
  [[dont_unroll]] for (uint k = 0u; k < kSkyDirections; ++k) {
    skyWeights[k] = kSlots > 0u ? kLeastVisible : 1.0;
  }
  if (kSlots > 0u) {
    clearBeams(); // pieces are cut by point lights: of this walk there are none
    const vec4 extent = vec4(march.at[0].centre, march.at[0].radius);
    const uint maxSteps = march.at[0].maxSteps;
    const float opacity = opacityPlaces(origin, direction, 1.0, 1.0, extent, maxSteps).z;
    const vec3 places = opacityPlaces(origin, direction, 0.25 * opacity, 0.75 * opacity, extent, maxSteps);
    addSkyVisible(march, places.x);
    addSkyVisible(march, places.y);
  }
  skyBegin(scene, march, direction);
}

#endif

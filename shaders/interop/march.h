// SPDX-License-Identifier: Apache-2.0
// What the march needs beside the scene. Made by render::MarchScene.
#ifndef TYNDALL_INTEROP_MARCH_H
#define TYNDALL_INTEROP_MARCH_H

#include "interop/light_cache.h"
#include "interop/scene.h"

GPU_BEGIN

GPU_CONST uint kNoCache = 0xffffffffu;

// Lights that every ray takes are "beams"; of the other point lights each ray draws one.
GPU_CONST uint kMaxBeams = 8;          // suns, one for all environments, point lights, one for the drawn point light
GPU_CONST uint kMaxSlots = 4;          // placed grids
GPU_CONST uint kMaxHomogeneous = 8;
// Directions to environments: one in each cell of the octahedral square of this edge, new ones for every batch.
GPU_CONST uint kSkyEdge = 8;
GPU_CONST uint kSkyDirections = kSkyEdge * kSkyEdge;

struct MarchScene {
  GPU_PTR(CellGrid) grids;    // one per slot; slot = placement = Medium::densityGrid, ::emissionGrid
  GPU_PTR(LightCache) caches; // of suns and point lights
  GPU_PTR(LightCache) skyCaches;
  GPU_PTR(uint) cacheOf;      // [group * slots + slot]: index into caches, or skyCaches from skyGroup on; or kNoCache
  GPU_PTR(vec3) sky;          // kSkyDirections unit directions, one drawn uniformly in each cell of the square
  uint pointBeams;            // point lights [0, pointBeams) are beams; group = their index
  uint distantGroup;          // group of distant light 0; the others follow
  uint skyGroup;              // group of sky direction 0
  float skyLightShare;        // of directions to environments that are drawn by an environment's own sampler,
  float skyPhaseShare;        // ... by a phase function; the others are of `sky`
  vec3 centre;                // of the bounded media, centred world space
  float radius;
  uint maxSteps;              // beyond what any ray needs
};
GPU_BUFFER(MarchScene)

GPU_END
#endif

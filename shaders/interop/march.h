// SPDX-License-Identifier: Apache-2.0
// What the march needs beside the scene. Made by render::MarchScene.
#ifndef TYNDALL_INTEROP_MARCH_H
#define TYNDALL_INTEROP_MARCH_H

#include "interop/light_cache.h"
#include "interop/scene.h"

GPU_BEGIN

GPU_CONST uint kNoCache = 0xffffffffu;

// Lights that every ray takes are "beams"; of the other point lights each ray draws one.
GPU_CONST uint kMaxBeams = 8;          // distant lights, point lights, the phase sample and the drawn point light
GPU_CONST uint kMaxSlots = 8;          // placed grids
GPU_CONST uint kMaxHomogeneous = 8;

struct MarchScene {
  GPU_PTR(CellGrid) grids;    // one per slot; slot = placement = Medium::densityGrid, ::emissionGrid
  GPU_PTR(LightCache) caches;
  GPU_PTR(uint) cacheOf;      // [group * slots + slot]: index into caches, or kNoCache
  uint pointBeams;            // point lights [0, pointBeams) are beams; group = their index
  uint distantGroup;          // group of distant light 0; the others follow
  uint sectorGroup;           // first of sectorEdge^2 groups for directions of environments
  uint sectorEdge;            // 0: none
  uint phaseBeam;             // 1: a beam along a direction that the phase function chooses
  uint maxSteps;              // beyond what any ray needs
  vec3 centre;                // of the bounded media, centred world space
  float radius;
};
GPU_BUFFER(MarchScene)

GPU_END
#endif

// SPDX-License-Identifier: Apache-2.0
// A probe of light/cache.glsl and of the nodes that the pass `light_cache` wrote.
#ifndef TYNDALL_LIGHT_CACHE_PROBE_IO_H
#define TYNDALL_LIGHT_CACHE_PROBE_IO_H

#include "interop/light_cache.h"

GPU_BEGIN

GPU_CONST uint kProbeNodes = 0;  // depth of node i
GPU_CONST uint kProbeInside = 1; // lightCacheDepth at points in voxel space
GPU_CONST uint kProbeFrom = 2;   // lightDepthFrom at points in centred world space

// Push constants.
struct LightCacheProbeInputs {
  GPU_PTR(CellGrid) grids;
  GPU_PTR(LightCache) caches;
  GPU_PTR(vec3) points;
  GPU_PTR(float) depths;
  vec3 light; // kProbeFrom: unit direction to a sun, or a position
  uint distant;
  uint cache;
  uint mode; // kProbe*
  uint count;
};

GPU_END
#endif

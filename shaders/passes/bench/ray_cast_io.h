// SPDX-License-Identifier: Apache-2.0
// Kernel `ray_cast`: given rays through the surfaces' tree and nothing else.
#ifndef TYNDALL_RAY_CAST_IO_H
#define TYNDALL_RAY_CAST_IO_H

#include "interop/surfaces.h"

GPU_BEGIN

struct BenchRay {
  vec3 origin;
  float tMax;
  vec3 direction; // unit
};
GPU_BUFFER(BenchRay)

struct BenchHit {
  float t;        // tMax: a miss; any hit: 0 where something is in the way
  uint primitive; // index into BvhPrimitive array
};
GPU_BUFFER(BenchHit)

struct RayCastInputs {
  GPU_PTR(Surfaces) surfaces;
  GPU_PTR(BenchRay) rays;
  GPU_PTR(BenchHit) hits;
  uint count;
  uint anyHit;
};

GPU_END
#endif

// SPDX-License-Identifier: Apache-2.0
// A probe of geometry/ray.glsl and geometry/offset.glsl.
#ifndef TYNDALL_RAY_PROBE_IO_H
#define TYNDALL_RAY_PROBE_IO_H

#include "interop/surfaces.h"

GPU_BEGIN

GPU_CONST uint kRayCast = 0;   // one cast
GPU_CONST uint kRayLeave = 1;  // from where it hits, a second one along `next`; its result, and the first one's point
GPU_CONST uint kRayShadow = 2; // from there, a shadow ray to where a cast along `next` from `origin` hits

GPU_CONST uint kPlantNoOffset = 1; // second rays begin and end on the surface

struct ProbeRay {
  vec3 origin;
  vec3 direction;
  vec3 next;
  float tMax;
  uint anyHit;
};
GPU_BUFFER(ProbeRay)

struct ProbeHit {
  float t;
  uint primitive;
  uint instance;
  vec2 barycentric;
  uint blocked;
  vec3 position; // SurfacePoint of the first cast, where it hit
  vec3 normal;
  float error;
};
GPU_BUFFER(ProbeHit)

struct RayProbeInputs {
  GPU_PTR(Surfaces) surfaces;
  GPU_PTR(ProbeRay) rays;
  GPU_PTR(ProbeHit) hits;
  uint count;
  uint mode;  // kRay*
  uint plant; // 0 or kPlant*
};

GPU_END
#endif

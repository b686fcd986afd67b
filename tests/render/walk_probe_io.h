// SPDX-License-Identifier: Apache-2.0
// A probe of tracker/walk.glsl: many walks along given rays.
#ifndef TYNDALL_WALK_PROBE_IO_H
#define TYNDALL_WALK_PROBE_IO_H

#include "passes/trace/trace_io.h"

GPU_BEGIN

struct WalkRay {
  vec3 origin;    // centred world space
  vec3 direction; // unit
  float tMax;
};
GPU_BUFFER(WalkRay)

// Sums over one invocation's walks.
struct WalkResult {
  float transmittance;
  float transmittanceSquared;
  uint hits;      // walks that ended at a collision
  uint lookups;
  uint exceeded;  // lookups above their majorant
};
GPU_BUFFER(WalkResult)

// Push constants. Invocation i walks ray i / invocationsPerRay.
struct WalkInputs {
  GPU_PTR(Scene) scene;
  GPU_PTR(WalkRay) rays;
  GPU_PTR(WalkResult) results;
  GPU_PTR(float) distances; // one per walk, < 0 without a collision; may be 0
  uint rayCount;
  uint invocationsPerRay;
  uint walks;               // per invocation
  uint mode;                // kWalkCollide or kWalkTransmit
  uint seed;
  uint writeDistances;      // 1: `distances` is there
  float firstXi;            // < 1: the first optical depth is drawn with xi in (0, firstXi), to see rare collisions
};

GPU_END
#endif

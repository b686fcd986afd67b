// SPDX-License-Identifier: Apache-2.0
// A probe of passes/march/ray.glsl and tracker/cells.glsl: given rays instead of a camera's.
#ifndef TYNDALL_MARCH_PROBE_IO_H
#define TYNDALL_MARCH_PROBE_IO_H

#include "passes/march/march_io.h"

GPU_BEGIN

GPU_CONST uint kProbeMarch = 0;     // marchRay
GPU_CONST uint kProbeDepth = 1;     // cellOpticalDepth of the scene's only grid, to infinity
GPU_CONST uint kProbeStateless = 2; // planted: a walk that finds its cell anew from its position in each step

GPU_CONST uint kStatelessBound = 4096; // steps after which such a walk gives up

struct MarchProbeRay {
  vec3 origin; // centred world space
  vec3 direction;
};
GPU_BUFFER(MarchProbeRay)

// Sums over one invocation's samples.
struct MarchProbeResult {
  float scattered;     // red
  float transmittance; // of the last sample
  float depth;         // of a walk
  uint steps;          // most of any sample
  uint cut;            // samples that were
};
GPU_BUFFER(MarchProbeResult)

// Push constants. Invocation i takes ray i; its random numbers are those of pixel (i & 0xffff, i >> 16).
struct MarchProbeInputs {
  GPU_PTR(Scene) scene;
  GPU_PTR(MarchScene) march;
  GPU_PTR(MarchProbeRay) rays;
  GPU_PTR(MarchProbeResult) results;
  uint count;
  uint firstSample;
  uint sampleCount;
  uint seed;
  uint mode; // kProbe*
};

GPU_END
#endif

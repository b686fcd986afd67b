// SPDX-License-Identifier: Apache-2.0
// Kernel `bare_lookup`: the ceiling of tracking. Every invocation follows its pixel's camera ray through the first grid
// and does nothing but stochastic lookups at exponentially spaced points, as a walk with one majorant would.
#ifndef TYNDALL_BENCH_IO_H
#define TYNDALL_BENCH_IO_H

#include "interop/scene.h"

GPU_BEGIN
struct BareLookupInputs {
  GPU_PTR(Scene) scene;
  GPU_PTR(uint) pixels;   // x | y << 16
  GPU_PTR(float) sums;    // one per pixel, so that nothing is optimised away
  uint count;
  uint lookups;           // per invocation
  float meanStep;         // voxels between lookups
};
GPU_END

#endif

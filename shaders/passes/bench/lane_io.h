// SPDX-License-Identifier: Apache-2.0
// Kernels `lane_use` and `cell_walk`. The first marches each pixel's camera rays as the pass `march` does and writes
// what each ray took, from which the host sums up how many lanes were busy. The second walks the same rays through the
// cells of the first grid and does nothing else: the ceiling of the march.
#ifndef TYNDALL_LANE_IO_H
#define TYNDALL_LANE_IO_H

#include "passes/march/march_io.h"

GPU_BEGIN

// What one ray took.
struct LaneUse {
  uint steps; // of the camera ray: cells, skipped regions, pieces of homogeneous media
  uint cells; // whose voxels were read; the correction's skipped regions included
};
GPU_BUFFER(LaneUse)

struct LaneInputs {
  GPU_PTR(Scene) scene;
  GPU_PTR(MarchScene) march;
  GPU_PTR(uint) pixels;  // x | y << 16
  GPU_PTR(LaneUse) uses; // [invocation * samples + sample]
  GPU_PTR(float) sums;   // one per invocation, so that nothing is optimised away
  uint count;            // pixels
  uint samples;          // per pixel
  uint seed;
};

GPU_END
#endif

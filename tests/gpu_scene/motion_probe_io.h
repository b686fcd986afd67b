// SPDX-License-Identifier: Apache-2.0
// A probe of geometry/motion.glsl.
#ifndef TYNDALL_MOTION_PROBE_IO_H
#define TYNDALL_MOTION_PROBE_IO_H

#include "interop/surfaces.h"

GPU_BEGIN

struct MovedPoint {
  vec3 point;
  uint motion;
};
GPU_BUFFER(MovedPoint)

struct PreviousPoint {
  vec3 point;
};
GPU_BUFFER(PreviousPoint)

struct MotionProbeInputs {
  GPU_PTR(Surfaces) surfaces;
  GPU_PTR(MovedPoint) points;
  GPU_PTR(PreviousPoint) previous;
  uint count;
};

GPU_END
#endif

// SPDX-License-Identifier: Apache-2.0
// A lat-long environment on the device. Made by light::makeEnvironment and light::deviceMap.
#ifndef TYNDALL_INTEROP_ENVIRONMENT_H
#define TYNDALL_INTEROP_ENVIRONMENT_H

#include "interop/basic.h"

GPU_BEGIN

// One outcome of a discrete distribution, by Walker's and Vose's alias method.
struct AliasEntry {
  float keep;        // probability to stay with this outcome once its slot is drawn, [0, 1]
  uint alias;        // the outcome otherwise
  float probability; // of this outcome, sums to 1
};
GPU_BUFFER(AliasEntry)

struct EnvironmentMap {
  GPU_PTR(vec3) texels;      // [W/(m2 sr)], size.x * size.y, x fastest; top row +y, middle column -z, right +x
  GPU_PTR(AliasEntry) cells; // cellCount.x * cellCount.y, x fastest, over the same square
  uvec2 size;
  uvec2 cellCount;
  float rotation;            // about +y, in turns
  float cellSolidAngle;      // of a cell at the horizon [sr]: times the sine of its polar angle for any other
};

GPU_END
#endif

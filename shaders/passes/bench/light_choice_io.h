// SPDX-License-Identifier: Apache-2.0
// Kernel `light_choice`: chooses lights for given points and does nothing else.
#ifndef TYNDALL_LIGHT_CHOICE_IO_H
#define TYNDALL_LIGHT_CHOICE_IO_H

#include "interop/basic.h"
#include "interop/emitters.h"

GPU_BEGIN

struct LightChoiceInputs {
  GPU_PTR(Emitters) emitters;
  GPU_PTR(float) sums; // one per invocation, so that nothing is optimised away
  vec3 corner;         // receivers lie on the parallelogram corner + [0, 1] edgeU + [0, 1] edgeV, in rows of `width`
  vec3 edgeU;
  vec3 edgeV;
  uint count;
  uint width;
  uint choices;        // per invocation
};

GPU_END
#endif

// SPDX-License-Identifier: Apache-2.0
#ifndef TYNDALL_INTEROP_PHASE_H
#define TYNDALL_INTEROP_PHASE_H

#include "interop/interop.h"

GPU_BEGIN
struct Phase {
  uint id;         // from phase/list.h
  vec4 parameters; // as the model's .glsl file documents; Mie: gHG, gDraine, alpha, weight of Draine
};
GPU_BUFFER(Phase)
GPU_END

#endif

// SPDX-License-Identifier: Apache-2.0
// Pointers to plain scalars and vectors.
#ifndef TYNDALL_INTEROP_BASIC_H
#define TYNDALL_INTEROP_BASIC_H

#include "interop/interop.h"

GPU_BEGIN
GPU_BUFFER(uint)
GPU_BUFFER(float)
GPU_BUFFER(vec2)
GPU_BUFFER(vec3)
GPU_BUFFER(vec4)
GPU_END

#endif

// SPDX-License-Identifier: Apache-2.0
// Layout of the blackbody table. Made by light::blackbodyTable, read by light/blackbody.glsl.
#ifndef TYNDALL_INTEROP_BLACKBODY_H
#define TYNDALL_INTEROP_BLACKBODY_H

#include "interop/interop.h"

GPU_BEGIN
GPU_CONST uint kBlackbodyEntries = 2048; // vec3(ln R, G / R, B / R), uniform in 1 / kelvin, hottest first
GPU_CONST float kBlackbodyMinKelvin = 500.0f;
GPU_CONST float kBlackbodyMaxKelvin = 20000.0f;
GPU_END

#endif

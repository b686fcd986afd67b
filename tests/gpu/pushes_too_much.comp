#version 460
// SPDX-License-Identifier: Apache-2.0
// A planted misuse: reads push constants beyond the range that kernels have.
#extension GL_GOOGLE_include_directive : require
#include "interop/basic.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
  floatPtr outputs;
  float values[64];
};

void main() { outputs.at[0] = values[63]; }

#version 460
// SPDX-License-Identifier: Apache-2.0
// Writes `factor` times each input.
#extension GL_GOOGLE_include_directive : require
#include "interop/basic.h"

layout(constant_id = 0) const float kFactor = 2.0;

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
  floatPtr inputs;
  floatPtr outputs;
  uint count;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) {
    outputs.at[i] = kFactor * inputs.at[i];
  }
}

#version 460
// SPDX-License-Identifier: Apache-2.0
// Maps temperatures in kelvin to the radiance of light/blackbody.glsl.
#extension GL_GOOGLE_include_directive : require
#include "light/blackbody.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
  vec3Ptr table;
  floatPtr kelvins;
  vec3Ptr outputs;
  uint count;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) {
    outputs.at[i] = blackbodyRadiance(table, kelvins.at[i]);
  }
}

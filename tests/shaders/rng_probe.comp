#version 460
// SPDX-License-Identifier: Apache-2.0
// Draws of one stream per invocation: `draws` words (kMode 0) or the float made of the word `index` (kMode 1).
#extension GL_GOOGLE_include_directive : require
#include "core/rng.glsl"
#include "interop/basic.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(constant_id = 1) const uint kPlanted = 0u; // 1: the sample index is forgotten; 2: 24-bit floats
layout(push_constant, scalar) uniform Push {
  uintPtr words;
  floatPtr floats;
  uint count;
  uint draws;
  uint width;
  uint firstWord;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) {
    return;
  }
  if (kMode == 1u) {
    const uint word = firstWord + i;
    floats.at[i] = kPlanted == 2u ? float(word >> 8u) * 5.9604645e-8 : unitFloat(word);
    return;
  }
  // (pixel, sample, seed) enumerate a small box.
  const uvec2 pixel = uvec2(i % width, (i / width) % width);
  const uint sampleIndex = (i / (width * width)) % width;
  const uint seed = i / (width * width * width);
  Rng rng = rngSeed(pixel, kPlanted == 1u ? 0u : sampleIndex, seed);
  for (uint d = 0u; d < draws; ++d) {
    words.at[i * draws + d] = rngUint(rng);
  }
}

#version 460
// SPDX-License-Identifier: Apache-2.0
// Coordinates, shuffled indices or direction numbers of the points of many batches, `dimensions` words for each point.
#extension GL_GOOGLE_include_directive : require
#include "core/sobol.glsl"
#include "interop/basic.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;    // 0: coordinates, 1: indices as each group takes them, 2: directions, 3: nets
layout(constant_id = 1) const uint kPlanted = 0u; // enum Planted of sobol_test.cpp
layout(push_constant, scalar) uniform Push {
  uintPtr words; // coordinates as the bits of a float
  uint count;    // of sets of 16 points
  uint width;    // batches per pixel, pixels per row, rows per seed
  uint firstDimension;
  uint dimensions;
};

/// A coordinate with a bug in it.
float planted(Sobol s, uint dimension, uvec2 pixel, uint sampleIndex, uint seed) {
  switch (kPlanted) {
  case 1u: { // no strata
    Rng rng = rngSeed(pixel, sampleIndex * kSobolDimensions + dimension, seed);
    return rngFloat(rng);
  }
  case 2u: // the second of a pair comes from another group, so does the third of the first three
    return sobolFloat(s, dimension == 1u || dimension == 2u || dimension == 4u ? dimension + 3u
                                                                               : (dimension == 6u ? 8u : dimension));
  case 3u: { // one flip for each digit, whatever the digits before it
    const float plain = sobolFloat(Sobol(s.index, 0u), dimension);
    return float(uint(plain * 16777216.0) ^ (sobolWords(s, dimension, 0u).x >> 8u)) * 5.9604644775390625e-8;
  }
  case 4u: // 8 random bits
    return floor(sobolFloat(s, dimension) * 256.0) / 256.0;
  case 5u: // one scramble for all dimensions
    return sobolFloat(s, 0u);
  case 9u: // a mean that is 0.2 % low
    return sobolFloat(s, dimension) * 0.998;
  default:
    return sobolFloat(s, dimension);
  }
}

void writePoint(uint set, uint point) {
  const uint batch = kPlanted == 6u ? 0u : set % width;
  const uvec2 pixel = kPlanted == 7u ? uvec2(0u) : uvec2((set / width) % width, (set / (width * width)) % width);
  const uint seed = kPlanted == 8u ? 0u : set / (width * width * width);
  const uint sampleIndex = batch * kSobolPoints + point;
  const Sobol s = sobolBegin(pixel, sampleIndex, seed);
  for (uint d = 0u; d < dimensions; ++d) {
    const uint dimension = firstDimension + d;
    uint word = 0u;
    if (kMode == 0u) {
      word = floatBitsToUint(planted(s, dimension, pixel, sampleIndex, seed));
    } else if (kMode == 1u) {
      word = sobolIndex(s, dimension);
    } else if (kMode == 3u) { // three dimensions a net, as bits of a float like the coordinates
      word = floatBitsToUint(unitFloat(sobolNet(s, kPlanted == 5u ? 0u : dimension / 3u)[dimension % 3u]));
    } else {
      word = sobolDirections(dimension);
    }
    words.at[(set * kSobolPoints + point) * dimensions + d] = word;
  }
}

void main() {
  const uint set = gl_GlobalInvocationID.x;
  if (set >= count) {
    return;
  }
  for (uint point = 0u; point < kSobolPoints; ++point) {
    writePoint(set, point);
  }
}

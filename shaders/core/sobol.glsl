// SPDX-License-Identifier: Apache-2.0
// Scrambled Sobol points: the 16 samples of a batch are one stratified set, and every batch has a scramble of its own.
//
// Dimensions 0, 1, 2 are a (0, 4, 3)-net in base 2: each box of volume 1/16 whose sides are powers of two has one
// point. Sobol's first three dimensions are not (t = 1); his first two and index / 16 are. The indices are taken in an
// order of their own, so that the first 4 samples alone are a (0, 2, 3)-net and the first 8 stratify each dimension.
// Dimensions (3, 4), (5, 6), (7, 8) are (0, 4, 2)-nets, and their first 2, 4 and 8 samples are nets as well. Each pair
// is Sobol's first two dimensions, its indices shuffled apart from all others ([Burley20] section 4, padding): points
// of different groups are independent but for the stratification of each. Dimension 9 is stratified alone.
//
// Digits are scrambled as in [Owen95], exactly and not by a hash that resembles it ([Laine11], [Burley20]): 16 points
// need no more than 15 random bits a dimension, one for each node of the binary tree, and what lies below a sixteenth
// is independent.
#ifndef TYNDALL_CORE_SOBOL_GLSL
#define TYNDALL_CORE_SOBOL_GLSL

#include "core/rng.glsl"

/// Points of one set. The same as a statistical batch of the film.
const uint kSobolPoints = 16u;
const uint kSobolDimensions = 10u;

struct Sobol {
  uint index; // of the point in its batch, 0 to 15
  uint seed;  // of the batch's scramble
};

/// Point `sampleIndex` mod 16 of batch `sampleIndex` / 16 of a pixel.
Sobol sobolBegin(uvec2 pixel, uint sampleIndex, uint seed) {
  const uint kApartFromRng = 0x536f6231u; // a batch number must not give the state that a sample index gives rngSeed
  Sobol s;
  s.index = sampleIndex % kSobolPoints;
  s.seed = pcg4d(pcg4d(uvec4(pixel, sampleIndex / kSobolPoints, seed ^ kApartFromRng))).x;
  return s;
}

/// Group of dimensions that share one order of the points: (0, 1, 2), (3, 4), (5, 6), (7, 8), (9).
uint sobolGroup(uint dimension) { return dimension < 3u ? 0u : (dimension - 1u) / 2u; }

/// Place of a dimension in its group, 0 to 2.
uint sobolPlace(uint dimension) { return dimension < 3u ? dimension : (dimension - 1u) % 2u; }

/// Direction numbers v of one dimension in sixteenths, that of index bit k in bits 4 k to 4 k + 3: point i is the XOR
/// of those whose bit is set in i. Pairs: [Joe08], dimensions 1 and 2. The first three: XOR over the bits of 7, 9, 2, 1
/// of [Joe08] dimension 1, dimension 2 and index / 16, which takes the indices in the order 0, 7, 9, 14, 2, ...
uint sobolDirections(uint dimension) {
  if (dimension < 3u) {
    return dimension == 0u ? 0x849eu : (dimension == 1u ? 0x8c7eu : 0x1297u);
  }
  return sobolPlace(dimension) == 0u ? 0x1248u : 0xfac8u;
}

/// Owen's nested uniform scramble of 4 binary digits, the first in bit 3: each is flipped or not by the bit of
/// `nodeBits` that belongs to the digits before it. Node (1 << count) | digits before; bit 0 is unused.
uint nestedScramble(uint digits, uint nodeBits) {
  const uint first = (nodeBits >> 1u) & 1u;
  const uint second = (nodeBits >> (2u | (digits >> 3u))) & 1u;
  const uint third = (nodeBits >> (4u | (digits >> 2u))) & 1u;
  const uint fourth = (nodeBits >> (8u | (digits >> 1u))) & 1u;
  return digits ^ ((first << 3u) | (second << 2u) | (third << 1u) | fourth);
}

/// Random words of a group for entry 0 to 15 (a point) or 16 (the whole set). Their high bits are the better ones.
uvec4 sobolWords(Sobol s, uint group, uint entry) { return pcg4d(uvec4(s.seed, group, entry, 0u)); }

/// The point's index in the order of the group of `dimension`, 0 to 15.
uint sobolIndex(Sobol s, uint dimension) {
  const uint group = sobolGroup(dimension);
  return group == 0u ? s.index : nestedScramble(s.index, sobolWords(s, group, kSobolPoints).w >> 16u);
}

/// First four binary digits of a coordinate of point `index`: a sixteenth.
uint sobolDigits(uint index, uint directions, uint nodeBits) {
  uint sixteenth = 0u;
  for (uint bit = 0u; bit < 4u; ++bit) {
    sixteenth ^= ((index >> bit) & 1u) * ((directions >> (4u * bit)) & 15u);
  }
  return nestedScramble(sixteenth, nodeBits);
}

/// A point of a (0, 4, 3)-net of its own, as words that are uniform over all 32-bit values: for unitFloat. Nets of
/// different names are independent, but that points of one sample belong together.
uvec3 sobolNet(Sobol s, uint name) {
  const uint kApartFromGroups = 0x4e657400u;
  const uvec4 set = sobolWords(s, kApartFromGroups + name, kSobolPoints);
  const uvec4 below = sobolWords(s, kApartFromGroups + name, s.index);
  const uint index = nestedScramble(s.index, set.w >> 16u);
  uvec3 words;
  for (uint place = 0u; place < 3u; ++place) {
    words[place] = (sobolDigits(index, sobolDirections(place), set[place] >> 16u) << 28u) | (below[place] >> 4u);
  }
  return words;
}

/// Coordinate of the point, uniform over the multiples of 2^-24 in [0, 1). `dimension` < kSobolDimensions; cheapest
/// where it is a constant.
float sobolFloat(Sobol s, uint dimension) {
  const uint group = sobolGroup(dimension);
  const uint place = sobolPlace(dimension);
  const uint sixteenth =
      sobolDigits(sobolIndex(s, dimension), sobolDirections(dimension), sobolWords(s, group, kSobolPoints)[place] >> 16u);
  const uint within = sobolWords(s, group, s.index)[place] >> 12u;
  return float((sixteenth << 20u) | within) * 5.9604644775390625e-8; // 2^-24: 24 bits, exact
}

#endif

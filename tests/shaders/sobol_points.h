// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

/// The points of shaders/core/sobol.glsl, as the device computes them and as their definition has them.
namespace tyndall::test::sobol {

enum Mode : std::uint32_t { Coordinates, Indices, Directions, Nets };
/// Bugs of sobol_probe.comp.
enum Planted : std::uint32_t {
  None,
  NoStrata,
  WrongPartner,
  DigitalShift,
  EightBits,
  OneScramble,
  BatchForgotten,
  PixelForgotten,
  SeedForgotten,
  LowMean
};

inline constexpr std::size_t kPoints = film::kBatchSamples;
inline constexpr std::uint32_t kDimensions = 10;
/// Sets enumerate a box of batches, pixels x, pixels y and 8 render seeds.
inline constexpr std::uint32_t kWidth = 32;
inline constexpr std::uint32_t kSets = kWidth * kWidth * kWidth * 8;

struct Request {
  Mode mode = Coordinates;
  Planted planted = None;
  std::uint32_t first = 0;
  std::uint32_t dimensions = kDimensions;
  std::uint32_t sets = 1u << 15;
};

/// What the probe computed: a word for each set, point and dimension.
struct Draw {
  std::uint32_t dimensions;
  std::vector<std::uint32_t> words;

  std::size_t sets() const { return words.size() / kPoints / dimensions; }
  std::uint32_t word(std::size_t set, std::size_t point, std::size_t d) const {
    return words[(set * kPoints + point) * dimensions + d];
  }
  float coordinate(std::size_t set, std::size_t point, std::size_t d) const {
    return std::bit_cast<float>(word(set, point, d));
  }
  /// The binary digits `first` to `first + count` - 1 behind the point, first + count <= 24.
  std::uint32_t digits(std::size_t set, std::size_t point, std::size_t d, int first, int count) const {
    return (static_cast<std::uint32_t>(coordinate(set, point, d) * 0x1p24f) >> (24 - first - count)) &
           ((1u << count) - 1u);
  }
};

/// Runs the probe.
Draw draw(const Request& request);

/// P-value of counts in bins that are equally likely.
double uniformPValue(const std::vector<std::uint64_t>& counts);

/// Direction numbers v of index bits 0 to 3, in sixteenths.
using FourDirections = std::array<std::uint32_t, 4>;

/// The sixteenth that unscrambled point `index`, 0 to 15, lies in.
std::uint32_t sobolPoint(const FourDirections& directions, std::uint32_t index);

/// A polynomial of [Joe08]'s table: inner coefficients, and the first odd numbers m, as many as its degree.
struct Polynomial {
  std::uint32_t inner = 0;
  std::vector<std::uint32_t> m;
};
inline const Polynomial kSecond{0, {1}};   ///< of Sobol's second dimension
inline const Polynomial kThird{1, {1, 3}}; ///< of the third

/// Directions of dimension d as sobol.glsl defines them: Sobol's first and second for pairs, and with index / 16 and
/// another order of the indices for the first three.
FourDirections expectedDirections(std::uint32_t d, const Polynomial& second = kSecond);

} // namespace tyndall::test::sobol

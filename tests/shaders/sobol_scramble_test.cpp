// SPDX-License-Identifier: Apache-2.0
// Randomness of the points of shaders/core/sobol.glsl: uniform, independent, and scrambled as Owen defines it.
#include "shaders/sobol_points.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tyndall::test::sobol {
namespace {

/// The bits that nested scrambling used (node (1 << count) | digits before), if the 16 values of a set are a nested
/// scramble of the 16 digits `plain` at all.
std::optional<std::uint32_t> nodeBits(const std::array<std::uint32_t, kPoints>& plain,
                                      const std::array<std::uint32_t, kPoints>& scrambled) {
  std::uint32_t bits = 0;
  std::uint32_t known = 0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    for (int count = 0; count < 4; ++count) {
      const std::uint32_t node = (1u << count) | (plain[i] >> (4 - count));
      const std::uint32_t flip = ((plain[i] ^ scrambled[i]) >> (3 - count)) & 1u;
      if ((known >> node & 1u) != 0 && (bits >> node & 1u) != flip) {
        return std::nullopt;
      }
      known |= 1u << node;
      bits |= flip << node;
    }
  }
  return bits >> 1;
}

struct Scrambles {
  std::vector<std::uint32_t> shuffle; ///< of the indices, 15 bits each
  std::vector<std::uint32_t> digits;  ///< of the coordinate's digits
  std::size_t broken = 0;             ///< sets that are no nested scramble
};

/// Takes apart what each of kSets sets did in dimension d.
Scrambles scrambles(std::uint32_t d, Planted planted) {
  const Draw points = draw({.planted = planted, .first = d, .dimensions = 1, .sets = kSets});
  const Draw indices = draw({.mode = Indices, .first = d, .dimensions = 1, .sets = kSets});
  const FourDirections directions = expectedDirections(d);
  Scrambles result;
  for (std::size_t set = 0; set < kSets; ++set) {
    std::array<std::uint32_t, kPoints> natural{}, shuffled{}, plain{}, scrambled{};
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      natural[i] = i;
      shuffled[i] = indices.word(set, i, 0);
      plain[i] = sobolPoint(directions, shuffled[i]);
      scrambled[i] = points.digits(set, i, 0, 0, 4);
    }
    const auto shuffle = nodeBits(natural, shuffled);
    const auto digits = nodeBits(plain, scrambled);
    result.broken += shuffle && digits ? 0u : 1u;
    result.shuffle.push_back(shuffle.value_or(0));
    result.digits.push_back(digits.value_or(0));
  }
  return result;
}

/// All 2^15 scrambles are equally likely; with `other`, given any one of those.
double scramblePValue(const std::vector<std::uint32_t>& bits, const std::vector<std::uint32_t>& other = {}) {
  std::vector<std::uint64_t> counts(1u << 15);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    ++counts[bits[i] ^ (other.empty() ? 0u : other[i])];
  }
  return uniformPValue(counts);
}

TEST(SobolScramble, AllNestedScramblesAreEquallyLikely) {
  std::vector<std::uint32_t> previous;
  for (std::uint32_t d = 0; d < kDimensions; ++d) {
    const Scrambles found = scrambles(d, None);
    EXPECT_EQ(found.broken, 0u) << d;
    EXPECT_GT(scramblePValue(found.digits), kMinPValue) << d;
    if (d < 3) {
      EXPECT_TRUE(std::ranges::all_of(found.shuffle, [](std::uint32_t bits) { return bits == 0; })) << d;
    } else {
      EXPECT_GT(scramblePValue(found.shuffle), kMinPValue) << d;
      EXPECT_GT(scramblePValue(found.digits, found.shuffle), kMinPValue) << d;
    }
    EXPECT_GT(scramblePValue(found.digits, previous), kMinPValue) << "dimensions " << d - 1 << ", " << d;
    previous = found.digits;
  }
  EXPECT_LT(scramblePValue(scrambles(0, DigitalShift).digits), kMinPValue);
  EXPECT_GT(scrambles(3, NoStrata).broken, 0u);
  EXPECT_LT(scramblePValue(previous, previous), kMinPValue);
}

/// Chi-squared of `count` digits behind the point from `first`, taking one point of each set, each in turn.
double digitsPValue(const Draw& points, std::size_t d, int first, int count) {
  std::vector<std::uint64_t> counts(std::size_t(1) << count);
  for (std::size_t set = 0; set < points.sets(); ++set) {
    ++counts[points.digits(set, (set * 7 + set / 16) % kPoints, d, first, count)];
  }
  return uniformPValue(counts);
}

TEST(SobolScramble, CoordinatesAreUniform) {
  const Draw points = draw({.sets = 1u << 17});
  for (std::size_t d = 0; d < kDimensions; ++d) {
    EXPECT_GT(digitsPValue(points, d, 0, 10), kMinPValue) << d;
    EXPECT_GT(digitsPValue(points, d, 14, 10), kMinPValue) << d;
  }
  const Draw eightBits = draw({.planted = EightBits, .dimensions = 1});
  EXPECT_LT(digitsPValue(eightBits, 0, 0, 10), kMinPValue);
  EXPECT_LT(digitsPValue(eightBits, 0, 14, 10), kMinPValue);
  const Draw low = draw({.planted = LowMean, .dimensions = 1, .sets = kSets});
  EXPECT_LT(digitsPValue(low, 0, 0, 10), kMinPValue);
}

/// Coordinates outside [0, 1) or between the multiples of 2^-24.
std::size_t misplaced(const Draw& points) {
  return static_cast<std::size_t>(std::ranges::count_if(points.words, [](std::uint32_t word) {
    const float x = std::bit_cast<float>(word);
    return !(x >= 0.0f && x < 1.0f && x * 0x1p24f == std::floor(x * 0x1p24f));
  }));
}

TEST(SobolScramble, CoordinatesAreBelowOne) {
  Draw points = draw({.sets = 1u << 17});
  EXPECT_EQ(misplaced(points), 0u);
  points.words.back() = std::bit_cast<std::uint32_t>(1.0f);
  EXPECT_EQ(misplaced(points), 1u);
  EXPECT_GT(misplaced(draw({.planted = LowMean})), 0u);
}

struct Coordinate {
  std::size_t point;
  std::size_t d;
};

/// Chi-squared of the 32 x 32 bins of coordinate a of one set and b of the set `lag` after it, from digit `first`.
double pairPValue(const Draw& points, Coordinate a, Coordinate b, std::size_t lag, int first) {
  std::vector<std::uint64_t> counts(1024);
  for (std::size_t set = 0; set + lag < points.sets(); ++set) {
    if (lag > 0 && (set / lag) % 2 == 1) {
      continue; // each set in one pair
    }
    ++counts[points.digits(set, a.point, a.d, first, 5) * 32 + points.digits(set + lag, b.point, b.d, first, 5)];
  }
  return uniformPValue(counts);
}

TEST(SobolScramble, PairsOfDimensionsAreJointlyUniform) {
  const Draw points = draw({.sets = 1u << 16});
  const Draw oneScramble = draw({.planted = OneScramble, .sets = 1u << 14});
  for (std::size_t a = 0; a < kDimensions; ++a) {
    for (std::size_t b = a + 1; b < kDimensions; ++b) {
      for (const int first : {0, 4}) {
        const std::size_t point = (a + 3 * b) % kPoints;
        EXPECT_GT(pairPValue(points, {point, a}, {point, b}, 0, first), kMinPValue) << a << ", " << b;
        EXPECT_LT(pairPValue(oneScramble, {point, a}, {point, b}, 0, first), kMinPValue) << a << ", " << b;
      }
    }
  }
}

TEST(SobolScramble, PointsOfABatchAreIndependentBelowASixteenth) {
  const Draw points = draw({.dimensions = 5, .sets = 1u << 16});
  const Draw shifted = draw({.planted = DigitalShift, .dimensions = 5, .sets = 1u << 14});
  for (std::size_t point = 1; point < kPoints; ++point) {
    for (const std::size_t d : {0u, 1u, 4u}) {
      EXPECT_GT(pairPValue(points, {0, d}, {point, d}, 0, 4), kMinPValue) << point << ", " << d;
      EXPECT_LT(pairPValue(shifted, {0, d}, {point, d}, 0, 4), kMinPValue) << point << ", " << d;
    }
  }
}

TEST(SobolScramble, BatchesPixelsAndSeedsAreIndependent) {
  const Draw points = draw({.dimensions = 5, .sets = kSets});
  const std::array<std::size_t, 4> lags{1, kWidth, kWidth * kWidth, kWidth * kWidth * kWidth};
  for (const std::size_t lag : lags) {
    for (const std::size_t d : {0u, 2u, 4u}) {
      EXPECT_GT(pairPValue(points, {0, d}, {0, d}, lag, 0), kMinPValue) << lag << ", " << d;
      EXPECT_GT(pairPValue(points, {0, d}, {15, d}, lag, 0), kMinPValue) << lag << ", " << d;
      EXPECT_GT(pairPValue(points, {3, d}, {3, d}, lag, 4), kMinPValue) << lag << ", " << d;
    }
  }
  const std::array<Planted, 4> forgotten{BatchForgotten, PixelForgotten, PixelForgotten, SeedForgotten};
  for (std::size_t i = 0; i < lags.size(); ++i) {
    const Draw repeated = draw({.planted = forgotten[i], .dimensions = 1, .sets = kSets});
    EXPECT_LT(pairPValue(repeated, {0, 0}, {0, 0}, lags[i], 0), kMinPValue) << lags[i];
  }
}

} // namespace
} // namespace tyndall::test::sobol

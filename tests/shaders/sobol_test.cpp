// SPDX-License-Identifier: Apache-2.0
// Stratification of the points of shaders/core/sobol.glsl, and what it is good for.
#include "shaders/sobol_points.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace tyndall::test::sobol {
namespace {

std::uint32_t packed(const FourDirections& v) { return v[0] | (v[1] << 4) | (v[2] << 8) | (v[3] << 12); }

TEST(Sobol, DirectionsAreThoseOfThePolynomials) {
  const Draw shipped = draw({.mode = Directions, .sets = 1});
  for (std::uint32_t d = 0; d < kDimensions; ++d) {
    EXPECT_EQ(shipped.word(0, 0, d), packed(expectedDirections(d))) << d;
  }
  EXPECT_NE(shipped.word(0, 0, 1), packed(expectedDirections(1, kThird)));
  EXPECT_NE(shipped.word(0, 0, 4), packed(expectedDirections(4, kThird)));
}

/// Whether the first 2^m points of a set are a (t, m, s)-net in base 2 in the dimensions `dims` [Niederreiter92,
/// definition 4.1]: each box of volume 2^(t - m) with sides that are powers of two holds 2^t of them.
bool isNet(const Draw& points, std::size_t set, const std::vector<std::size_t>& dims, int m, int t) {
  const int total = m - t;
  std::vector<int> sides(dims.size(), 0); // digits of each dimension; odometer over all with the right sum
  for (;;) {
    int sum = 0;
    for (const int side : sides) {
      sum += side;
    }
    if (sum == total) {
      std::array<int, kPoints> boxes{};
      for (std::size_t point = 0; point < std::size_t(1) << m; ++point) {
        std::uint32_t box = 0;
        for (std::size_t d = 0; d < dims.size(); ++d) {
          box = (box << sides[d]) | points.digits(set, point, dims[d], 0, sides[d]);
        }
        ++boxes[box];
      }
      if (std::any_of(boxes.begin(), boxes.begin() + (1 << total), [&](int held) { return held != 1 << t; })) {
        return false;
      }
    }
    std::size_t d = 0;
    while (d < sides.size() && sides[d] == total) {
      sides[d++] = 0;
    }
    if (d == sides.size()) {
      return true;
    }
    ++sides[d];
  }
}

/// Share of the sets that are not such a net.
double notNets(const Draw& points, const std::vector<std::size_t>& dims, int m, int t) {
  std::size_t failures = 0;
  for (std::size_t set = 0; set < points.sets(); ++set) {
    failures += isNet(points, set, dims, m, t) ? 0u : 1u;
  }
  return static_cast<double>(failures) / static_cast<double>(points.sets());
}

TEST(Sobol, EveryBatchIsANet) {
  const Draw points = draw({});
  const Draw noStrata = draw({.planted = NoStrata});
  const Draw wrongPartner = draw({.planted = WrongPartner});
  for (std::size_t d = 0; d < kDimensions; ++d) {
    for (const int m : {2, 3, 4}) {
      EXPECT_EQ(notNets(points, {d}, m, 0), 0.0) << d << ", first 2^" << m;
      EXPECT_GT(notNets(noStrata, {d}, m, 0), 0.5) << d << ", first 2^" << m;
    }
  }
  for (const int m : {2, 4}) {
    EXPECT_EQ(notNets(points, {0, 1, 2}, m, 0), 0.0) << "first 2^" << m;
    EXPECT_GT(notNets(noStrata, {0, 1, 2}, m, 0), 0.5);
    EXPECT_GT(notNets(wrongPartner, {0, 1, 2}, m, 0), 0.5);
    EXPECT_EQ(notNets(points, {0, 1}, m, 0), 0.0) << "first 2^" << m;
  }
  EXPECT_EQ(notNets(points, {0, 1, 2}, 3, 1), 0.0);
  EXPECT_GT(notNets(noStrata, {0, 1, 2}, 3, 1), 0.5);
  for (const std::size_t d : {3u, 5u, 7u}) {
    for (const int m : {1, 2, 3, 4}) {
      EXPECT_EQ(notNets(points, {d, d + 1}, m, 0), 0.0) << d << ", first 2^" << m;
      EXPECT_GT(notNets(noStrata, {d, d + 1}, m, 0), 0.5) << d << ", first 2^" << m;
    }
    EXPECT_GT(notNets(d == 7u ? noStrata : wrongPartner, {d, d + 1}, 4, 0), 0.5) << d;
  }
}

constexpr std::uint32_t kTwoNets = 6; ///< dimensions

/// In sixteenths, of one point of every set: how often dimensions a and b give each pair of values.
double pairPValue(const Draw& points, std::size_t point, std::size_t a, std::size_t b) {
  std::vector<std::uint64_t> counts(256, 0);
  for (std::size_t set = 0; set < points.sets(); ++set) {
    ++counts[points.digits(set, point, a, 0, 4) * 16 + points.digits(set, point, b, 0, 4)];
  }
  return uniformPValue(counts);
}

/// What the path's events draw from: nets each for itself, and independent of each other within a sample, which is what
/// means rest on.
TEST(Sobol, NetsOfDifferentNamesAreNetsAndIndependent) {
  const Draw points = draw({.mode = Nets, .dimensions = kTwoNets});
  const Draw oneNet = draw({.mode = Nets, .planted = OneScramble, .dimensions = kTwoNets});
  EXPECT_EQ(notNets(points, {0, 1, 2}, 4, 0), 0.0);
  EXPECT_EQ(notNets(points, {3, 4, 5}, 4, 0), 0.0);
  EXPECT_GT(notNets(points, {0, 1, 3}, 4, 0), 0.5) << "they share no strata";
  constexpr double kLeast = 1e-6; // of 60 p-values
  for (const std::size_t point : {0u, 5u, 13u, 15u}) {
    for (std::size_t a = 0; a < kTwoNets; ++a) {
      for (std::size_t b = a + 1; b < kTwoNets; ++b) {
        EXPECT_GT(pairPValue(points, point, a, b), kLeast) << point << ": " << a << ", " << b;
      }
    }
    EXPECT_LT(pairPValue(oneNet, point, 0, 3), kLeast);
  }
}

/// Mean of f over the first `count` points of each set.
std::vector<double> means(const Draw& points, std::size_t count, const std::function<double(const double*)>& f) {
  std::vector<double> result;
  std::array<double, kDimensions> x{};
  for (std::size_t set = 0; set < points.sets(); ++set) {
    double sum = 0.0;
    for (std::size_t point = 0; point < count; ++point) {
      for (std::size_t d = 0; d < points.dimensions; ++d) {
        x[d] = static_cast<double>(points.coordinate(set, point, d));
      }
      sum += f(x.data());
    }
    result.push_back(sum / static_cast<double>(count));
  }
  return result;
}

/// Of the mean of the product of (1/2 + x) over `dimensions` dimensions from `first`: variance with independent points,
/// ((13/12)^dimensions - 1) / count, over that of the sets.
double gain(Planted planted, std::uint32_t first, std::uint32_t dimensions, std::size_t count) {
  const Draw points = draw({.planted = planted, .first = first, .dimensions = dimensions});
  const auto product = [dimensions](const double* x) {
    double value = 1.0;
    for (std::uint32_t d = 0; d < dimensions; ++d) {
      value *= 0.5 + x[d];
    }
    return value;
  };
  const std::vector<double> values = means(points, count, product);
  const double variance = std::pow(estimateMean(values).standardError, 2.0) * static_cast<double>(values.size());
  return (std::pow(13.0 / 12.0, dimensions) - 1.0) / static_cast<double>(count) / variance;
}

TEST(Sobol, SmoothIntegralsVaryFarLess) {
  struct Case {
    std::uint32_t first, dimensions, count;
    double bound; ///< of the gain; its own standard error is 1 to 2 %
  };
  // Measured: 85, 8.5, 140, 140, 11; with dimensions of other groups 7.9, 5.6, 15, 15, 8.2.
  for (const Case& c : {Case{0, 3, 16, 60.0}, {0, 3, 4, 7.0}, {3, 2, 16, 100.0}, {5, 2, 16, 100.0}, {3, 2, 4, 9.5}}) {
    EXPECT_GT(gain(None, c.first, c.dimensions, c.count), c.bound) << c.first << ", " << c.count;
    EXPECT_LT(gain(WrongPartner, c.first, c.dimensions, c.count), c.bound) << c.first << ", " << c.count;
    EXPECT_NEAR(gain(NoStrata, c.first, c.dimensions, c.count), 1.0, 0.1) << c.first << ", " << c.count;
  }
}

TEST(Sobol, MeansOfIndicatorsAreUnbiased) {
  const auto corner = [](const double* x) { return x[0] + x[1] + x[2] < 1.0 ? 1.0 : 0.0; };
  const auto disc = [](const double* x) { return x[3] * x[3] + x[4] * x[4] < 1.0 ? 1.0 : 0.0; };
  const auto half = [](const double* x) { return x[0] + x[5] + x[8] + x[9] > 2.0 ? 1.0 : 0.0; };
  const auto zScore = [](const Draw& points, const std::function<double(const double*)>& f, double exact) {
    return estimateMean(means(points, kPoints, f)).zScore(exact);
  };
  const Draw points = draw({.sets = 1u << 17});
  EXPECT_LT(zScore(points, corner, 1.0 / 6.0), kMaxZ);
  EXPECT_LT(zScore(points, disc, std::numbers::pi / 4.0), kMaxZ);
  EXPECT_LT(zScore(points, half, 0.5), kMaxZ);
  const Draw low = draw({.planted = LowMean, .sets = 1u << 17});
  EXPECT_GT(zScore(low, corner, 1.0 / 6.0), kMaxZ);
  EXPECT_GT(zScore(low, disc, std::numbers::pi / 4.0), kMaxZ);
  EXPECT_GT(zScore(low, half, 0.5), kMaxZ);
}

} // namespace
} // namespace tyndall::test::sobol

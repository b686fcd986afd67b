// SPDX-License-Identifier: Apache-2.0
// When an error falls to a bound.
#include "bench/crossing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tyndall::bench {
namespace {

constexpr double kStart = 0.5;      // [s]
constexpr double kPerSample = 0.01; // [s]
constexpr double kNoise = 4.0;      // squared error of one sample

/// A renderer whose noise falls as 1 / samples and whose time is a line.
std::vector<Effort> perfect(const std::vector<double>& samples) {
  std::vector<Effort> efforts;
  for (const double count : samples) {
    efforts.push_back({count, {kNoise / count, 0.1}, {kStart + kPerSample * count, 0.02}});
  }
  return efforts;
}

TEST(Crossing, BeyondTheEffortsNoiseGoesAsOneOverSamplesAndTimeIsALine) {
  const Crossing crossing = secondsTo(1e-3, perfect({4, 16, 64}), 0.0);
  EXPECT_EQ(crossing.reach, Reach::Extrapolated);
  EXPECT_NEAR(crossing.seconds.value, kStart + kPerSample * kNoise / 1e-3, 1e-9);
  EXPECT_NEAR(crossing.seconds.logError, std::hypot(0.1, 0.02), 1e-12);
}

/// Seen to fail where the start was not taken off before scaling (16 % too long here).
TEST(Crossing, TheStartDoesNotGrow) {
  const std::vector<Effort> efforts = perfect({4, 16});
  const Crossing crossing = secondsTo(kNoise / 160.0, efforts, 0.0);
  EXPECT_NEAR(crossing.seconds.value, kStart + 1.6, 1e-9);
}

TEST(Crossing, BetweenEffortsIsALineOfLogarithms) {
  const std::vector<Effort> efforts{{1, {1.0, 0.0}, {1.0, 0.0}}, {100, {0.01, 0.0}, {100.0, 0.0}}};
  const Crossing crossing = secondsTo(0.1, efforts, 0.0);
  EXPECT_EQ(crossing.reach, Reach::Measured);
  EXPECT_NEAR(crossing.seconds.value, 10.0, 1e-9);
}

TEST(Crossing, WhatIsBetterAlreadyIsABound) {
  const Crossing crossing = secondsTo(2.0, perfect({4, 16}), 0.0);
  EXPECT_EQ(crossing.reach, Reach::Better);
  EXPECT_EQ(crossing.seconds.value, kStart + 4.0 * kPerSample);
}

TEST(Crossing, BiasThatIsTooLargeNeverEnds) {
  EXPECT_EQ(secondsTo(1e-3, perfect({4, 16}), 1e-3).reach, Reach::Never);
  const Crossing half = secondsTo(1e-3, perfect({4, 16}), 0.5e-3);
  EXPECT_NEAR(half.seconds.value, kStart + kPerSample * kNoise / 0.5e-3, 1e-9) << "the rest must come from noise";
}

TEST(Crossing, AProgramWithoutSamplesIsNotExtrapolated) {
  const std::vector<Effort> settings{{0, {1e-2, 0.0}, {1.0, 0.0}}, {0, {1e-3, 0.0}, {5.0, 0.0}}};
  EXPECT_EQ(secondsTo(1e-4, settings, 0.0).reach, Reach::Never);
  EXPECT_EQ(secondsTo(5e-3, settings, 0.0).reach, Reach::Measured);
}

/// On a loaded machine the smaller effort may take longer.
TEST(Crossing, TimesThatFallGiveNoNegativeTime) {
  std::vector<Effort> efforts = perfect({4, 16});
  efforts.front().seconds.value = 3.0;
  const Crossing crossing = secondsTo(1e-4, efforts, 0.0);
  EXPECT_GT(crossing.seconds.value, efforts.back().seconds.value);
}

TEST(Efficiency, DoesNotDependOnTheSamples) {
  Figure few;
  Figure many;
  ASSERT_TRUE(efficiencyOf(perfect({1, 4}), few));
  ASSERT_TRUE(efficiencyOf(perfect({4, 16, 256}), many));
  EXPECT_NEAR(few.value, kNoise * kPerSample, 1e-9);
  EXPECT_NEAR(many.value, kNoise * kPerSample, 1e-9);
  EXPECT_FALSE(efficiencyOf(perfect({4}), few));
}

} // namespace
} // namespace tyndall::bench

// SPDX-License-Identifier: Apache-2.0
#include "microbench/guiding_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace tyndall::microbench {
namespace {

/// Independent normal pixels of mean 1.
Pictures noisyRuns(std::size_t runs, std::size_t pixels, double deviation, std::mt19937& random) {
  std::normal_distribution<double> normal(1.0, deviation);
  Pictures result(runs, std::vector<double>(pixels));
  for (std::vector<double>& run : result) {
    for (double& pixel : run) {
      pixel = normal(random);
    }
  }
  return result;
}

std::vector<std::size_t> everyPixel(std::size_t count) {
  std::vector<std::size_t> pixels(count);
  std::iota(pixels.begin(), pixels.end(), std::size_t{0});
  return pixels;
}

/// Each run as often as it was drawn.
Pictures drawn(const Pictures& runs, const Draws& draws) {
  Pictures result;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    result.insert(result.end(), draws[run], runs[run]);
  }
  return result;
}

TEST(Trimming, LeavesOutTheWorstOfTheSumOverTheRows) {
  // Pixel 2 is worst in the sum, pixel 0 in the first row alone.
  const std::vector<std::vector<double>> rows{{5.0, 1.0, 4.0, 1.0}, {0.0, 1.0, 9.0, 1.0}};
  EXPECT_EQ(withoutWorst(rows, 0.25), (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_EQ(withoutWorst(rows, 0.5), (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(withoutWorst(rows, 0.0), everyPixel(4));
}

TEST(Trimming, TakesAPixelFromTheSmallestPicture) {
  const std::vector<std::vector<double>> row{{1.0, 2.0, 3.0}};
  EXPECT_EQ(withoutWorst(row, 0.001), (std::vector<std::size_t>{0, 1}));
}

TEST(Trimming, OneFireflyIsAllThatItTakesAway) {
  std::mt19937 random(1);
  Pictures runs = noisyRuns(5, 1000, 0.1, random);
  runs[3][17] = 1e4;
  const std::vector<std::vector<double>> row{pixelVariances(runs)};
  const std::vector<std::size_t> kept = withoutWorst(row, 0.001);
  ASSERT_EQ(kept.size(), 999u);
  EXPECT_GT(RunProducts(runs, everyPixel(1000)).variance(), 1e3);
  // Of 999 pixels with 4 degrees of freedom each: relative standard error sqrt(2 / 3996) = 2.2 %; the bound is 4.5 of
  // them.
  EXPECT_NEAR(RunProducts(runs, kept).variance(), 0.01, 0.001);
}

TEST(Variance, IsThatOfTheRunsDrawn) {
  std::mt19937 random(2);
  const Pictures runs = noisyRuns(5, 40, 0.5, random);
  const std::vector<std::size_t> pixels{0, 3, 7, 39};
  const RunProducts products(runs, pixels);
  for (const Draws& draws : {Draws{1, 1, 1, 1, 1}, Draws{2, 0, 1, 2, 0}, Draws{0, 4, 0, 0, 1}}) {
    const std::vector<double> variances = pixelVariances(drawn(runs, draws));
    double expected = 0.0;
    for (const std::size_t pixel : pixels) {
      expected += variances[pixel] / double(pixels.size());
    }
    EXPECT_NEAR(products.variance(draws), expected, 1e-12 * expected); // rounding
  }
}

TEST(Variance, OfTheImageMeanIsThatOfItsPixelsOverTheirNumber) {
  std::mt19937 random(3);
  const Mean mean = imageMean(noisyRuns(200, 100, 0.5, random));
  const double error = 0.5 / std::sqrt(200.0 * 100.0);
  EXPECT_NEAR(mean.value, 1.0, 4.5 * error);
  EXPECT_NEAR(mean.error, error, 4.5 * error / std::sqrt(2.0 * 199.0)); // its own standard error
}

TEST(Gains, AreRatiosOfVarianceAndOfVarianceTimesTime) {
  std::mt19937 random(4);
  const Pictures noisy = noisyRuns(5, 4000, 0.2, random);
  Pictures calm = noisy; // a quarter of the deviation about the mean, exactly
  const std::vector<double> mean = meanPicture(noisy);
  for (std::vector<double>& run : calm) {
    for (std::size_t pixel = 0; pixel < run.size(); ++pixel) {
      run[pixel] = mean[pixel] + 0.25 * (run[pixel] - mean[pixel]);
    }
  }
  const std::vector<double> seconds{1.0, 2.0, 1.0, 4.0, 1.0};
  const std::vector<double> twice{2.0, 4.0, 2.0, 8.0, 2.0};
  const RunProducts reference(noisy, everyPixel(4000));
  const RunProducts row(calm, everyPixel(4000));
  const Gains gains = gainsOver({reference, seconds}, {row, twice});
  EXPECT_NEAR(gains.samples.value, 16.0, 1e-9);
  EXPECT_NEAR(gains.time.value, 8.0, 1e-9);
}

TEST(Gains, HaveNoFigureWithoutNoise) {
  std::mt19937 random(5);
  const Pictures noisy = noisyRuns(3, 10, 0.2, random);
  const Pictures same(3, std::vector<double>(10, 1.0));
  const RunProducts reference(noisy, everyPixel(10));
  const RunProducts row(same, everyPixel(10));
  const std::vector<double> seconds(3, 1.0);
  EXPECT_TRUE(std::isnan(gainsOver({reference, seconds}, {row, seconds}).time.value));
  EXPECT_TRUE(std::isnan(gainsOver({row, seconds}, {reference, seconds}).time.range.low));
}

/// Runs whose noise is each one's own size, as where few seeds meet rare paths.
Pictures unevenRuns(std::size_t runs, std::mt19937& random) {
  std::lognormal_distribution<double> size(0.0, 1.0);
  Pictures result;
  for (std::size_t run = 0; run < runs; ++run) {
    result.push_back(noisyRuns(1, 50, size(random), random).front());
  }
  return result;
}

constexpr int kTrials = 200;

/// In how many trials the interval of the gain between two that are alike holds 1.
int timesHeld(std::size_t runs, std::mt19937& random) {
  const std::vector<double> seconds(runs, 1.0);
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RunProducts a(unevenRuns(runs, random), everyPixel(50));
    const RunProducts b(unevenRuns(runs, random), everyPixel(50));
    const Gain gain = gainsOver({a, seconds}, {b, seconds}).time;
    EXPECT_LE(gain.range.low, gain.value);
    EXPECT_GE(gain.range.high, gain.value);
    held += gain.range.low <= 1.0 && gain.range.high >= 1.0 ? 1 : 0;
  }
  return held;
}

// 95 % of 200 trials are 190, with a standard deviation of 3.1.

TEST(Gains, IntervalsOfFewRunsHoldTheTruthAsOftenAsTheySay) {
  std::mt19937 random(6);
  EXPECT_GE(timesHeld(5, random), 178); // four deviations below
}

TEST(Gains, IntervalsOfManyRunsAreNoWiderThanThat) {
  std::mt19937 random(8);
  const int held = timesHeld(20, random);
  EXPECT_GE(held, 178);
  EXPECT_LE(held, 198); // 199 and 200 have probability 4e-4
}

TEST(Gains, TimesCountRoundByRound) {
  std::mt19937 random(7);
  const Pictures runs = noisyRuns(4, 100, 0.2, random);
  const RunProducts products(runs, everyPixel(100));
  // The machine was three times slower in round 2, for both.
  const std::vector<double> first{1.0, 3.0, 1.0, 1.0};
  const std::vector<double> second{2.0, 6.0, 2.0, 2.0};
  const Gains gains = gainsOver({products, first}, {products, second});
  EXPECT_NEAR(gains.time.value, 0.5, 1e-12);
  EXPECT_NEAR(gains.time.range.low, 0.5 * gains.samples.range.low, 1e-12);
  EXPECT_NEAR(gains.time.range.high, 0.5 * gains.samples.range.high, 1e-12);
}

} // namespace
} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#include "film_fixture.h"

#include <cmath>

namespace tyndall::film {
namespace {

const glm::uvec2 kOnePixel(1, 1);
const Window kOnePixelWindow{{0, 0}, {1, 1}};

BatchSums sumsOf(float sum) {
  BatchSums sums;
  sums.moments.fill(sum);
  sums.extras.fill(sum);
  return sums;
}

/// A film of one pixel with samples of mean 2 and variance 9, `last` of them in the last of `batches` batches.
Film normalFilm(std::mt19937& generator, std::uint32_t batches, std::uint32_t last) {
  Film film(kOnePixel, kOnePixelWindow);
  std::normal_distribution<float> sample(2.0f, 3.0f);
  for (std::uint32_t batch = 0; batch < batches; ++batch) {
    const std::uint32_t count = batch + 1 == batches ? last : kBatchSamples;
    float sum = 0.0f;
    for (std::uint32_t i = 0; i < count; ++i) {
      sum += sample(generator);
    }
    film.add(0, batch, count, sumsOf(sum));
  }
  return film;
}

/// z of the average of `estimate(film)` over replicates against `expected`.
template <class Estimate>
double zOf(double expected, std::uint32_t batches, std::uint32_t last, Estimate estimate) {
  std::mt19937 generator(7);
  constexpr int kReplicates = 20000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kReplicates; ++i) {
    const double value = estimate(normalFilm(generator, batches, last));
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kReplicates;
  return (mean - expected) / std::sqrt((squares / kReplicates - mean * mean) / kReplicates);
}

constexpr double kSigma = 5.0;  // 6e-7 a test

TEST(Film, MeanAndVarianceOfAHandMadePixel) {
  Film film(kOnePixel, kOnePixelWindow);
  EXPECT_EQ(film.mean(0, R), 0.0);
  film.add(0, 0, 16, sumsOf(16.0f));
  EXPECT_EQ(film.mean(0, R), 1.0);
  EXPECT_TRUE(std::isinf(film.varianceOfMean(0, R)));
  film.add(0, 1, 16, sumsOf(48.0f));
  EXPECT_EQ(film.samples(0), 32u);
  EXPECT_EQ(film.mean(0, R), 2.0);
  EXPECT_EQ(film.extraMean(0, Depth), 2.0);
  // Batch means 1 and 3: their variance is 2, of the mean of two of them 1.
  EXPECT_DOUBLE_EQ(film.varianceOfMean(0, R), 1.0);
}

TEST(Film, VarianceOfMeanIsUnbiasedWithAPartialLastBatch) {
  const auto variance = [](const Film& film) { return film.varianceOfMean(0, R); };
  EXPECT_LT(std::abs(zOf(9.0 / 64, 4, 16, variance)), kSigma);
  EXPECT_LT(std::abs(zOf(9.0 / 51, 4, 3, variance)), kSigma);
  EXPECT_LT(std::abs(zOf(9.0 / 17, 2, 1, variance)), kSigma);
}

TEST(Film, VarianceCheckerFindsDivisionByKInsteadOfKMinus1) {
  const auto wrong = [](const Film& film) { return film.varianceOfMean(0, R) * 3.0 / 4.0; };
  EXPECT_GT(std::abs(zOf(9.0 / 51, 4, 3, wrong)), kSigma);
}

TEST(Film, IndependentHalvesAreAveragedWithEqualWeight) {
  Film film(kOnePixel, kOnePixelWindow);
  for (const std::uint32_t batch : {0u, 2u, 4u, 6u}) {
    film.add(0, batch, 16, sumsOf(16.0f * (1.0f + float(batch))));  // batch means 1, 3, 5, 7
  }
  film.add(0, 1, 16, sumsOf(16.0f));
  film.add(0, 3, 16, sumsOf(32.0f));  // batch means 1, 2
  film.independentHalves = true;
  EXPECT_DOUBLE_EQ(film.mean(0, G), 0.5 * (4.0 + 1.5));
  EXPECT_DOUBLE_EQ(film.varianceOfMean(0, G), 0.25 * (20.0 / 3.0 / 4.0 + 0.5 / 2.0));
  EXPECT_DOUBLE_EQ(film.halfEstimate(0, 0, G).mean, 4.0);
  EXPECT_DOUBLE_EQ(film.halfEstimate(0, 1, G).variance, 0.25);
  film.independentHalves = false;
  EXPECT_DOUBLE_EQ(film.mean(0, G), (16.0 + 3.0) / 6.0);
}

TEST(Film, OneEmptyHalfLeavesTheOther) {
  Film film(kOnePixel, kOnePixelWindow);
  film.add(0, 0, 16, sumsOf(32.0f));
  film.independentHalves = true;
  EXPECT_EQ(film.mean(0, B), 2.0);
}

TEST(Film, ConstantSamplesHaveNoVarianceAndNeverANegativeOne) {
  Film film(kOnePixel, kOnePixelWindow);
  for (std::uint32_t batch = 0; batch < 1000; ++batch) {
    film.add(0, batch, batch == 999 ? 7 : 16, sumsOf(0.1f * (batch == 999 ? 7.0f : 16.0f)));
    EXPECT_GE(film.varianceOfMean(0, R), 0.0);
  }
  EXPECT_LT(film.varianceOfMean(0, R), 1e-14);
}

TEST(Film, AMillionSamplesDoNotDrift) {
  constexpr std::uint32_t kBatches = 65536;
  constexpr double kDrift = 1e-7;  // relative; a float's own rounding is 6e-8
  std::mt19937 generator(3);
  std::exponential_distribution<float> noise(1.0f);
  Film constant(kOnePixel, kOnePixelWindow);
  Film noisy(kOnePixel, kOnePixelWindow);
  long double exact = 0.0L;
  float inFloat = 0.0f;
  for (std::uint32_t batch = 0; batch < kBatches; ++batch) {
    float constantSum = 0.0f;
    float noisySum = 0.0f;
    for (std::uint32_t i = 0; i < kBatchSamples; ++i) {
      const float sample = noise(generator);
      constantSum += 0.3f;
      noisySum += sample;
      exact += static_cast<long double>(sample);
      inFloat += sample;
    }
    constant.add(0, batch, kBatchSamples, sumsOf(constantSum));
    noisy.add(0, batch, kBatchSamples, sumsOf(noisySum));
  }
  const double samples = double(kBatches) * kBatchSamples;
  const double truth = double(exact) / samples;
  EXPECT_NEAR(constant.mean(0, R) / double(0.3f), 1.0, kDrift);
  EXPECT_NEAR(noisy.mean(0, R) / truth, 1.0, kDrift);
  // The checker sees the drift of a float accumulator.
  EXPECT_GT(std::abs(double(inFloat) / samples / truth - 1.0), kDrift);
}

TEST(Film, NegativeMeansAreKept) {
  Film film(kOnePixel, kOnePixelWindow);
  film.add(0, 0, 16, sumsOf(-8.0f));
  EXPECT_EQ(film.mean(0, R), -0.5);
}

} // namespace
} // namespace tyndall::film

// SPDX-License-Identifier: Apache-2.0
// Errors of pictures, on pictures whose errors are known.
#include "bench/replicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tyndall::bench {
namespace {

constexpr unsigned kEdge = 48;
constexpr std::size_t kPixels = std::size_t(kEdge) * kEdge;

/// Bright on the left, dark on the right; the top row is not covered.
double truth(std::size_t pixel) { return pixel % kEdge < kEdge / 2 ? 2.0 : 0.5; }

Picture known(double factor = 1.0) {
  Picture picture{{kEdge, kEdge}, {}, std::vector<bool>(kPixels, true)};
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    picture.values.insert(picture.values.end(), 3, factor * truth(pixel));
    picture.covered[pixel] = pixel >= kEdge;
  }
  return picture;
}

/// Independent normal noise of standard deviation `relative` times the truth.
Replicates noisy(std::size_t count, double relative, double factor = 1.0, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Replicates pictures;
  for (std::size_t i = 0; i < count; ++i) {
    Picture picture = known(factor);
    for (double& value : picture.values) {
      value *= 1.0 + relative * normal(random);
    }
    pictures.push_back(picture);
  }
  return pictures;
}

/// 8 x 6,912 values: the variance is known to 1.2 % (two standard errors).
constexpr double kWithin = 0.02;

TEST(Replicates, ScatterIsTheErrorWhereNothingIsKnown) {
  const Replicates pictures = noisy(8, 0.2);
  const Errors errors = errorsOf(pictures, referenceOf(meanOf(pictures), false));
  EXPECT_NEAR(errors.relMse.value / 0.04, 1.0, kWithin);
  EXPECT_NEAR(errors.rRmse.value / 0.2, 1.0, kWithin);
  EXPECT_LT(errors.relMse.logError, kWithin);
  EXPECT_GT(errors.relMse.logError, 0.001);
}

TEST(Replicates, AgainstTheTruthBiasCounts) {
  const Replicates pictures = noisy(8, 0.2, 1.1);
  const Reference reference = referenceOf(known(), true);
  const double expected = 0.22 * 0.22 + 0.01;
  EXPECT_NEAR(errorsOf(pictures, reference).relMse.value / expected, 1.0, kWithin);
  const Bias bias = biasOf(pictures, reference, {});
  EXPECT_NEAR(bias.mean, 0.1, 5.0 * bias.meanError);
  EXPECT_NEAR(bias.relMse, 0.01, 0.001);
  EXPECT_NEAR(bias.rRmse, 0.1, 0.005);
  EXPECT_TRUE(bias.found);
}

TEST(Replicates, BiasIsNotFoundInNoise) {
  const Replicates against = noisy(8, 0.1);
  const Reference reference = referenceOf(meanOf(against), false);
  const Bias none = biasOf(noisy(8, 0.2, 1.0, 99), reference, against);
  EXPECT_FALSE(none.found);
  EXPECT_LT(std::abs(none.relMse), 0.001);
  const Bias little = biasOf(noisy(8, 0.2, 1.02, 99), reference, against);
  EXPECT_TRUE(little.found) << "2 % are 30 standard errors here";
  EXPECT_NEAR(little.mean, 0.02, 5.0 * little.meanError);
}

/// Pixels that are not sure have no say, whatever they hold.
TEST(Replicates, UnsurePixelsCountForNothing) {
  Replicates pictures = noisy(8, 0.2);
  std::vector<bool> sure(kPixels, true);
  for (std::size_t pixel = 0; pixel < 100; ++pixel) {
    sure[pixel] = false;
    for (Picture& picture : pictures) {
      picture.values[3 * pixel] = 1e6;
    }
  }
  const Reference reference = referenceOf(known(), true, sure);
  EXPECT_NEAR(errorsOf(pictures, reference).relMse.value / 0.04, 1.0, kWithin);
  EXPECT_FALSE(biasOf(pictures, reference, {}).found);
}

/// rRMSE is over covered pixels, relMSE over all.
TEST(Replicates, UncoveredPixelsAreInRelMseAlone) {
  Replicates pictures = noisy(8, 0.0);
  for (Picture& picture : pictures) {
    for (std::size_t value = 0; value < 3 * kEdge; ++value) {
      picture.values[value] += 1.0;
    }
  }
  const Errors errors = errorsOf(pictures, referenceOf(known(), true));
  EXPECT_EQ(errors.rRmse.value, 0.0);
  EXPECT_GT(errors.relMse.value, 0.01);
}

TEST(Replicates, TheMapIsTheErrorOfEachPixel) {
  Replicates pictures = noisy(64, 0.2);
  const std::vector<double> map = errorMap(pictures, referenceOf(known(), true));
  ASSERT_EQ(map.size(), kPixels);
  double mean = 0.0;
  for (const double error : map) {
    mean += error * error / double(kPixels);
  }
  EXPECT_NEAR(mean / 0.04, 1.0, kWithin);
}

TEST(Replicates, OnePictureHasTheErrorThatItHas) {
  const Replicates one{known(1.3)};
  EXPECT_NEAR(errorsOf(one, referenceOf(known(), false)).rRmse.value, 0.3, 1e-12);
}

} // namespace
} // namespace tyndall::bench

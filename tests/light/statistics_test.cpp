// SPDX-License-Identifier: Apache-2.0
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tyndall::test {
namespace {

TEST(Statistics, ChiSquaredSurvivalEqualsTables) {
  // Abramowitz and Stegun, table 26.8.
  EXPECT_NEAR(chiSquaredSurvival(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(chiSquaredSurvival(18.307038, 10), 0.05, 1e-6);
  EXPECT_NEAR(chiSquaredSurvival(149.449, 100), 0.001, 1e-5);
  EXPECT_NEAR(chiSquaredSurvival(61.918, 100), 0.999, 1e-5);
}

TEST(Statistics, GoodnessOfFitTellsRightFromWrong) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> samples(100000);
  std::vector<std::uint64_t> counts(20);
  for (double& sample : samples) {
    sample = uniform(engine);
    ++counts[static_cast<std::size_t>(sample * 20.0)];
  }
  const std::vector<double> equal(20, 0.05);
  std::vector<double> tilted(20);
  for (std::size_t i = 0; i < 20; ++i) {
    tilted[i] = 0.05 * (1.0 + 0.05 * (static_cast<double>(i) - 9.5) / 9.5);
  }
  EXPECT_GT(chiSquaredPValue(counts, equal), kMinPValue);
  EXPECT_LT(chiSquaredPValue(counts, tilted), kMinPValue);
  EXPECT_GT(kolmogorovPValue(samples, [](double x) { return x; }), kMinPValue);
  EXPECT_LT(kolmogorovPValue(samples, [](double x) { return std::pow(x, 1.03); }), kMinPValue);
}

TEST(Statistics, PValuesAreUniform) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> chi;
  std::vector<double> kolmogorov;
  for (int repeat = 0; repeat < 1000; ++repeat) {
    std::vector<double> samples(1000);
    std::vector<std::uint64_t> counts(10);
    for (double& sample : samples) {
      sample = uniform(engine);
      ++counts[static_cast<std::size_t>(sample * 10.0)];
    }
    chi.push_back(chiSquaredPValue(counts, std::vector<double>(10, 0.1)));
    kolmogorov.push_back(kolmogorovPValue(samples, [](double x) { return x; }));
  }
  EXPECT_GT(kolmogorovPValue(chi, [](double p) { return p; }), 1e-4);
  EXPECT_GT(kolmogorovPValue(kolmogorov, [](double p) { return p; }), 1e-4);
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
#include "film/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::film {
namespace {

/// Simpson's rule with 20,000 intervals.
template <class Function>
double integral(double a, double b, Function f) {
  constexpr int kIntervals = 20000;
  const double h = (b - a) / kIntervals;
  double sum = f(a) + f(b);
  for (int i = 1; i < kIntervals; ++i) {
    sum += (i % 2 == 1 ? 4.0 : 2.0) * f(a + i * h);
  }
  return sum * h / 3.0;
}

TEST(Statistics, NormalCdfAtTabulatedPoints) {
  EXPECT_NEAR(normalCdf(0.0), 0.5, 1e-15);
  EXPECT_NEAR(normalCdf(1.959963984540054), 0.975, 1e-14);
  EXPECT_NEAR(normalTwoSidedP(5.0), 5.733031437583878e-7, 1e-18);
  EXPECT_GT(normalTwoSidedP(30.0), 0.0);  // no cancellation in the tail
}

TEST(Statistics, StudentTMatchesItsDensity) {
  for (const double degrees : {1.0, 2.5, 7.0, 40.0}) {
    const double scale = std::exp(std::lgamma(0.5 * (degrees + 1)) - std::lgamma(0.5 * degrees)) /
                         std::sqrt(degrees * std::numbers::pi);
    for (const double t : {0.1, 1.0, 3.0}) {
      const double area =
          integral(0.0, t, [&](double x) { return scale * std::pow(1 + x * x / degrees, -0.5 * (degrees + 1)); });
      EXPECT_NEAR(studentTCdf(t, degrees), 0.5 + area, 1e-11) << t << " at " << degrees;
      EXPECT_NEAR(studentTCdf(-t, degrees), 0.5 - area, 1e-11);
    }
  }
}

TEST(Statistics, StudentTQuantileInvertsItsCdf) {
  EXPECT_NEAR(studentTQuantile(0.9, 1.0), 3.0776835371752527, 1e-9);
  EXPECT_NEAR(studentTQuantile(0.9, 1e6), 1.2815516, 1e-5);
  EXPECT_NEAR(studentTCdf(studentTQuantile(0.2, 4.0), 4.0), 0.2, 1e-12);
}

TEST(Statistics, ChiSquaredMatchesItsDensity) {
  for (const double degrees : {2.0, 5.0, 30.0, 200.0}) {
    for (const double x : {0.3 * degrees, degrees, 2.0 * degrees}) {
      const double a = 0.5 * degrees;
      const double area = integral(1e-12, x, [&](double v) {
        return std::exp((a - 1) * std::log(v) - 0.5 * v - a * std::numbers::ln2 - std::lgamma(a));
      });
      EXPECT_NEAR(chiSquaredCdf(x, degrees), area, 1e-9);
      EXPECT_NEAR(chiSquaredCdf(x, degrees) + chiSquaredSurvival(x, degrees), 1.0, 1e-12);
    }
  }
  EXPECT_NEAR(chiSquaredSurvival(100.0, 2.0) / std::exp(-50.0), 1.0, 1e-10);  // the tail, relative
}

TEST(Statistics, SidakThresholdAndFamilyAreInverse) {
  EXPECT_NEAR(sidakThreshold(1e-4, 1000.0), 1.00005e-7, 1e-12);
  EXPECT_NEAR(sidakFamilyP(sidakThreshold(1e-4, 1000.0), 1000.0), 1e-4, 1e-15);
  EXPECT_EQ(sidakFamilyP(1.0, 5.0), 1.0);
}

TEST(Statistics, WelchOnAnExampleWorkedByHand) {
  // Means 2 and 5, variances of the means 1/3 and 2/3: t = -3, degrees 1 / ((1/9)/2 + (4/9)/5) = 90/13.
  const TestResult result = welchTest({2.0, 1.0, 3.0}, {5.0, 4.0, 6.0});
  EXPECT_NEAR(result.statistic, -3.0, 1e-12);
  EXPECT_NEAR(result.degrees, 90.0 / 13.0, 1e-12);
  EXPECT_NEAR(result.p, 2.0 * studentTCdf(-3.0, 90.0 / 13.0), 1e-14);
}

TEST(Statistics, WelchWithoutScatterIsCertain) {
  EXPECT_EQ(welchTest({1.0, 0.0, 3.0}, {1.0, 0.0, 3.0}).p, 1.0);
  EXPECT_EQ(welchTest({1.0, 0.0, 3.0}, {2.0, 0.0, 3.0}).p, 0.0);
}

TEST(Statistics, SummaryOfFourValues) {
  const SampleSummary summary = summarise({1.0, 2.0, 3.0, 6.0});
  EXPECT_DOUBLE_EQ(summary.mean, 3.0);
  EXPECT_DOUBLE_EQ(summary.variance, 14.0 / 3.0);
}

/// Share of `trials` whose p lies below 0.1 under a true hypothesis, for a test that is given a generator.
template <class Test>
double rejectionRate(int trials, Test pOf) {
  std::mt19937 generator(11);
  int rejected = 0;
  for (int i = 0; i < trials; ++i) {
    rejected += pOf(generator) < 0.1 ? 1 : 0;
  }
  return double(rejected) / trials;
}

std::vector<double> exponentials(std::mt19937& generator, int count, double rate) {
  std::exponential_distribution<double> distribution(rate);
  std::vector<double> values(count);
  for (double& value : values) {
    value = distribution(generator);
  }
  return values;
}

double exponentialCdf(double x) { return -std::expm1(-x); }

TEST(Statistics, KolmogorovSmirnovRejectsAsOftenAsItSays) {
  const double rate = rejectionRate(4000, [](std::mt19937& generator) {
    return kolmogorovSmirnovTest(exponentials(generator, 50, 1.0), exponentialCdf).p;
  });
  EXPECT_NEAR(rate, 0.1, 0.025);  // 5 standard errors of a share over 4000 trials
}

TEST(Statistics, KolmogorovSmirnovFindsAWrongRate) {
  std::mt19937 generator(5);
  EXPECT_GT(kolmogorovSmirnovTest(exponentials(generator, 20000, 1.0), exponentialCdf).p, 1e-4);
  EXPECT_LT(kolmogorovSmirnovTest(exponentials(generator, 20000, 1.05), exponentialCdf).p, 1e-4);
}

/// p of the histogram of 2000 uniform numbers over 40 bins, whose last ten are narrow and expect one count each.
double histogramP(std::mt19937& generator, double skew) {
  std::vector<double> expected(30, 1990.0 / 30.0);
  expected.resize(40, 1.0);
  std::vector<double> observed(40, 0.0);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    double count = 2000.0 * std::pow(uniform(generator), skew);
    std::size_t bin = 0;
    while (bin < 39 && count > expected[bin]) {
      count -= expected[bin++];
    }
    observed[bin] += 1.0;
  }
  return chiSquaredTest(observed, expected).p;
}

TEST(Statistics, ChiSquaredRejectsAsOftenAsItSaysWithSmallBins) {
  const double rate = rejectionRate(2000, [](std::mt19937& generator) { return histogramP(generator, 1.0); });
  EXPECT_NEAR(rate, 0.1, 0.034);  // 5 standard errors over 2000 trials
}

TEST(Statistics, ChiSquaredFindsASkewedSampler) {
  std::mt19937 generator(2);
  EXPECT_LT(histogramP(generator, 1.4), 1e-4);
}

TEST(Statistics, ChiSquaredTakesACountWhereNoneCanBeAsProof) {
  EXPECT_EQ(chiSquaredTest({10.0, 10.0, 1.0}, {10.5, 10.5, 0.0}).p, 0.0);
  EXPECT_EQ(chiSquaredTest({10.0, 10.0, 0.0}, {10.0, 10.0, 0.0}).p, 1.0);
}

TEST(Statistics, ARareCountInAPoolBelowTheLimitIsNoCertainty) {
  // One count where 0.01 is expected: unlikely, not impossible.
  EXPECT_GT(chiSquaredTest({100.0, 99.0, 1.0}, {100.0, 99.99, 0.01}).p, 0.01);
}

} // namespace
} // namespace tyndall::film

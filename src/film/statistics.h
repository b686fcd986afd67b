// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

/// Distributions and tests in double, for `compare` and for the tests. Every p is in [0, 1]; small = suspicious.
namespace tyndall::film {

/// Regularised incomplete gamma Q(a, x) = Gamma(a, x) / Gamma(a), a > 0, x >= 0. [DLMF] 8.2.4, 8.7.1, 8.9.2
double upperGammaQ(double a, double x);
/// Regularised incomplete beta I_x(a, b), a, b > 0, x in [0, 1]. [DLMF] 8.17.2, 8.17.22
double incompleteBeta(double a, double b, double x);

double normalCdf(double z);
/// P(|Z| >= |z|) without cancellation in the tail.
double normalTwoSidedP(double z);
double studentTCdf(double t, double degrees);
/// P(|T| >= |t|).
double studentTTwoSidedP(double t, double degrees);
/// t with studentTCdf(t, degrees) = p, p in (0, 1), degrees > 0.
double studentTQuantile(double p, double degrees);
double chiSquaredCdf(double x, double degrees);
/// P(X >= x).
double chiSquaredSurvival(double x, double degrees);

/// Probability that the smallest of `count` independent p-values is at most `smallestP`: the family's p-value.
double sidakFamilyP(double smallestP, double count);
/// Per-test threshold whose family of `count` independent tests has false-alarm rate `familyRate`.
double sidakThreshold(double familyRate, double count);

struct SampleSummary {
  double mean = 0.0;
  double variance = 0.0;  ///< of one value, unbiased
  double count = 0.0;
};
SampleSummary summarise(const std::vector<double>& values);

struct TestResult {
  double statistic = 0.0;
  double degrees = 0.0;  ///< 0 where the test has none
  double p = 1.0;
};
/// Equality of two means with unequal variances [Welch 1947]. Needs two values on each side.
/// Without any scatter: p = 1 for equal means, else 0.
TestResult welchTest(const SampleSummary& a, const SampleSummary& b);

/// Values against a continuous distribution; asymptotic p with the finite-size term of [Stephens 1970], good from 8
/// values up.
TestResult kolmogorovSmirnovTest(std::vector<double> values, const std::function<double(double)>& cdf);

/// Counts against expected counts of the same total. Bins expected below `smallestExpected` are pooled (with the next
/// smallest bin, if still too few); a count in a bin that expects exactly 0 gives p = 0.
TestResult chiSquaredTest(const std::vector<double>& observed, const std::vector<double>& expected,
                          double smallestExpected = 5.0);

} // namespace tyndall::film

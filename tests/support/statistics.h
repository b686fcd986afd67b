// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Tests of samples against distributions. Seeds are fixed, so that a result never changes from run to run.
namespace tyndall::test {

/// A goodness-of-fit test fails below this. With some 200 of them in the suite the chance that correct code fails is
/// 2e-4, met once when the seed is chosen and never again.
inline constexpr double kMinPValue = 1e-6;
/// The same for a z-score: two-sided probability 6e-7.
inline constexpr double kMaxZ = 5.0;

/// Probability that chi-squared of so many degrees of freedom is at least `statistic`.
double chiSquaredSurvival(double statistic, double degreesOfFreedom);

/// P-value of counts against expected probabilities that sum to 1 within 1e-3. Bins expecting fewer than 10 are
/// pooled; an observation in a bin of probability 0 gives 0.
double chiSquaredPValue(std::span<const std::uint64_t> observed, std::span<const double> probabilities);

/// P-value of Kolmogorov's and Smirnov's test of samples against a continuous distribution function.
double kolmogorovPValue(std::vector<double> samples, const std::function<double(double)>& cdf);

/// Mean and standard error of a sample.
struct MeanEstimate {
  double mean = 0.0;
  double standardError = 0.0;
  /// Distance from `expected` in standard errors; the rounding error `tolerance` is taken off first.
  double zScore(double expected, double tolerance = 0.0) const;
};
MeanEstimate estimateMean(std::span<const double> values);

} // namespace tyndall::test

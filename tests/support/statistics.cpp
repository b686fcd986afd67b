// SPDX-License-Identifier: Apache-2.0
#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace tyndall::test {
namespace {

/// Regularised upper incomplete gamma function Q(a, x), [Press07] section 6.2.
double upperGamma(double a, double x) {
  if (x <= 0.0) {
    return 1.0;
  }
  const double prefactor = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; std::abs(term) > 1e-16 * sum; n += 1.0) {
      term *= x / n;
      sum += term;
    }
    return 1.0 - sum * prefactor;
  }
  // Lentz's continued fraction.
  double b = x + 1.0 - a;
  double c = 1e300;
  double d = 1.0 / b;
  double h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) {
      break;
    }
  }
  return prefactor * h;
}

} // namespace

double chiSquaredSurvival(double statistic, double degreesOfFreedom) {
  return upperGamma(0.5 * degreesOfFreedom, 0.5 * statistic);
}

double chiSquaredPValue(std::span<const std::uint64_t> observed, std::span<const double> probabilities) {
  const double total = static_cast<double>(std::accumulate(observed.begin(), observed.end(), std::uint64_t(0)));
  const double mass = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  if (observed.size() != probabilities.size() || std::abs(mass - 1.0) > 1e-3) {
    throw std::logic_error("chiSquaredPValue: the bins' probabilities must match the counts and sum to 1");
  }
  double statistic = 0.0;
  int bins = 0;
  double pooledObserved = 0.0;
  double pooledExpected = 0.0;
  const auto close = [&] {
    statistic += (pooledObserved - pooledExpected) * (pooledObserved - pooledExpected) / pooledExpected;
    pooledObserved = pooledExpected = 0.0;
    ++bins;
  };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (probabilities[i] <= 0.0 && observed[i] > 0) {
      return 0.0;
    }
    pooledObserved += static_cast<double>(observed[i]);
    pooledExpected += probabilities[i] * total;
    if (pooledExpected >= 10.0) {
      close();
    }
  }
  if (pooledExpected > 0.0) {
    close();
  }
  return chiSquaredSurvival(statistic, bins - 1);
}

double kolmogorovPValue(std::vector<double> samples, const std::function<double(double)>& cdf) {
  std::sort(samples.begin(), samples.end());
  const double n = static_cast<double>(samples.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double value = cdf(samples[i]);
    distance = std::max({distance, value - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - value});
  }
  // [Stephens70] correction of the asymptotic distribution.
  const double lambda = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
  if (lambda < 0.3) {
    return 1.0; // the series below converges badly where the answer is 1 to 4 digits
  }
  double sum = 0.0;
  for (int k = 1; k <= 100; ++k) {
    sum += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * lambda * lambda);
  }
  return std::clamp(sum, 0.0, 1.0);
}

double MeanEstimate::zScore(double expected, double tolerance) const {
  const double excess = std::max(0.0, std::abs(mean - expected) - tolerance);
  return excess == 0.0 ? 0.0 : excess / standardError;
}

MeanEstimate estimateMean(std::span<const double> values) {
  const double n = static_cast<double>(values.size());
  MeanEstimate result;
  for (const double value : values) {
    result.mean += value / n;
  }
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - result.mean) * (value - result.mean);
  }
  result.standardError = std::sqrt(squares / (n - 1.0) / n);
  return result;
}

} // namespace tyndall::test

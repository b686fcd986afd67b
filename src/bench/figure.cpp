// SPDX-License-Identifier: Apache-2.0
#include "bench/figure.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace tyndall::bench {

double median(std::vector<double> values) {
  TYNDALL_CHECK(!values.empty());
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Figure operator*(const Figure& a, const Figure& b) { return {a.value * b.value, std::hypot(a.logError, b.logError)}; }

Figure operator/(const Figure& a, const Figure& b) { return {a.value / b.value, std::hypot(a.logError, b.logError)}; }

Interval interval(const Figure& figure, std::size_t repeats) {
  TYNDALL_CHECK(repeats >= 2);
  // Quantile 0.975 of Student's t, expanded in 1 / freedom about the normal one.
  const double freedom = double(repeats - 1);
  const double t = 1.960 + (2.372 + 2.823 / freedom) / freedom;
  const double factor = std::exp(t * figure.logError);
  return {figure.value / factor, figure.value * factor};
}

Figure medianTime(const std::vector<double>& seconds) {
  TYNDALL_CHECK(seconds.size() >= 2);
  const double count = double(seconds.size());
  double mean = 0.0;
  for (const double each : seconds) {
    mean += std::log(each) / count;
  }
  double variance = 0.0;
  for (const double each : seconds) {
    variance += (std::log(each) - mean) * (std::log(each) - mean) / (count - 1.0);
  }
  constexpr double kMedianOverMean = 1.2533; // sqrt(pi / 2): of a normal sample's standard errors
  return {median(seconds), kMedianOverMean * std::sqrt(variance / count)};
}

Figure ratioInTurn(const std::vector<double>& a, const std::vector<double>& b) {
  TYNDALL_CHECK(a.size() == b.size());
  std::vector<double> ratios(a.size());
  std::transform(a.begin(), a.end(), b.begin(), ratios.begin(), std::divides<>());
  return medianTime(ratios);
}

std::string rangeText(const Figure& figure, std::size_t repeats) {
  const Interval ends = interval(figure, repeats);
  return fmt::format("{} [{}, {}]", shortText(figure.value), shortText(ends.low), shortText(ends.high));
}

std::string shortText(double value) {
  const double size = std::abs(value);
  if (size == 0.0) {
    return "0";
  }
  if (size < 1e-3 || size >= 1e5) {
    return fmt::format("{:.2e}", value);
  }
  return fmt::format("{:.{}f}", value,
                     size >= 100.0 ? 0 : (size >= 10.0 ? 1 : (size >= 1.0 ? 2 : (size >= 0.1 ? 3 : 4))));
}

} // namespace tyndall::bench

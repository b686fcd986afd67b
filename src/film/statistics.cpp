// SPDX-License-Identifier: Apache-2.0
#include "film/statistics.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tyndall::film {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kTiny = 1e-300;       // keeps Lentz's method away from 0/0
constexpr int kMaxTerms = 100000;      // terms grow with sqrt(a); far above any use

/// Term of a continued fraction a1/(b1+ a2/(b2+ ...)).
struct FractionTerm {
  double a;
  double b;
};

/// Modified Lentz evaluation of b0 + a1/(b1 + a2/(b2 + ...)).
template <class TermAt>
double continuedFraction(double b0, TermAt termAt) {
  double f = b0 == 0.0 ? kTiny : b0;
  double c = f;
  double d = 0.0;
  for (int i = 1; i < kMaxTerms; ++i) {
    const FractionTerm term = termAt(i);
    d = term.b + term.a * d;
    c = term.b + term.a / c;
    d = 1.0 / (d == 0.0 ? kTiny : d);
    c = c == 0.0 ? kTiny : c;
    f *= c * d;
    if (std::abs(c * d - 1.0) < kEpsilon) {
      break;
    }
  }
  return f;
}

/// P(a, x) by its power series, [DLMF] 8.7.1; for x < a + 1.
double lowerGammaSeries(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (int n = 1; n < kMaxTerms && std::abs(term) > kEpsilon * std::abs(sum); ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

} // namespace

double upperGammaQ(double a, double x) {
  if (x <= 0.0) {
    return 1.0;
  }
  if (x < a + 1.0) {
    return 1.0 - lowerGammaSeries(a, x);
  }
  if (!std::isfinite(x)) {
    return 0.0;
  }
  const double fraction = continuedFraction(x + 1.0 - a, [=](int i) {
    return FractionTerm{-i * (i - a), x + 2.0 * i + 1.0 - a};
  });
  return std::exp(a * std::log(x) - x - std::lgamma(a)) / fraction;
}

double incompleteBeta(double a, double b, double x) {
  if (x <= 0.0 || x >= 1.0) {
    return x <= 0.0 ? 0.0 : 1.0;
  }
  // The fraction converges fast below the mean only; the mirrored function serves the rest.
  if (x > (a + 1.0) / (a + b + 2.0)) {
    return 1.0 - incompleteBeta(b, a, 1.0 - x);
  }
  const double fraction = continuedFraction(1.0, [=](int i) {
    const double m = i / 2;
    const double a_i = i % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                                  : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    return FractionTerm{a_i, 1.0};
  });
  const double logFront =
      a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b);
  return std::exp(logFront) / (a * fraction);
}

double normalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normalTwoSidedP(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

double studentTTwoSidedP(double t, double degrees) {
  return incompleteBeta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
}

double studentTCdf(double t, double degrees) {
  const double tail = 0.5 * studentTTwoSidedP(t, degrees);
  return t < 0.0 ? tail : 1.0 - tail;
}

double studentTQuantile(double p, double degrees) {
  TYNDALL_CHECK(p > 0.0 && p < 1.0 && degrees > 0.0);
  if (p < 0.5) {
    return -studentTQuantile(1.0 - p, degrees);
  }
  double low = 0.0;
  double high = 1.0;
  while (studentTCdf(high, degrees) < p && high < 1e15) {
    high *= 2.0;
  }
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (studentTCdf(middle, degrees) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double chiSquaredCdf(double x, double degrees) { return 1.0 - upperGammaQ(0.5 * degrees, 0.5 * x); }

double chiSquaredSurvival(double x, double degrees) { return upperGammaQ(0.5 * degrees, 0.5 * x); }

double sidakFamilyP(double smallestP, double count) { return -std::expm1(count * std::log1p(-smallestP)); }

double sidakThreshold(double familyRate, double count) { return -std::expm1(std::log1p(-familyRate) / count); }

SampleSummary summarise(const std::vector<double>& values) {
  SampleSummary summary{.count = double(values.size())};
  for (const double value : values) {
    summary.mean += value / summary.count;
  }
  for (const double value : values) {
    summary.variance += (value - summary.mean) * (value - summary.mean) / (summary.count - 1.0);
  }
  return summary;
}

TestResult welchTest(const SampleSummary& a, const SampleSummary& b) {
  TYNDALL_CHECK(a.count >= 2.0 && b.count >= 2.0);
  const double varianceA = a.variance / a.count;
  const double varianceB = b.variance / b.count;
  const double variance = varianceA + varianceB;
  if (variance == 0.0) {
    return {.p = a.mean == b.mean ? 1.0 : 0.0};
  }
  TestResult result;
  result.statistic = (a.mean - b.mean) / std::sqrt(variance);
  result.degrees = variance * variance /
                   (varianceA * varianceA / (a.count - 1.0) + varianceB * varianceB / (b.count - 1.0));
  result.p = studentTTwoSidedP(result.statistic, result.degrees);
  return result;
}

TestResult kolmogorovSmirnovTest(std::vector<double> values, const std::function<double(double)>& cdf) {
  TYNDALL_CHECK(!values.empty());
  std::sort(values.begin(), values.end());
  const double n = double(values.size());
  TestResult result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double f = cdf(values[i]);
    result.statistic = std::max({result.statistic, f - double(i) / n, double(i + 1) / n - f});
  }
  const double root = std::sqrt(n);
  const double lambda = (root + 0.12 + 0.11 / root) * result.statistic;
  if (lambda < 0.2) {
    return result;  // p = 1 to double precision, where the alternating series no longer converges
  }
  double p = 0.0;
  for (int k = 1; k <= 100; ++k) {
    p += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * lambda * lambda);
  }
  result.p = std::clamp(p, 0.0, 1.0);
  return result;
}

TestResult chiSquaredTest(const std::vector<double>& observed, const std::vector<double>& expected,
                          double smallestExpected) {
  TYNDALL_CHECK(observed.size() == expected.size());
  struct Bin {
    double observed = 0.0;
    double expected = 0.0;
  };
  std::vector<Bin> bins;
  Bin pool;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] == 0.0 && observed[i] > 0.0) {
      return {.statistic = std::numeric_limits<double>::infinity(), .p = 0.0};
    }
    if (expected[i] >= smallestExpected) {
      bins.push_back({observed[i], expected[i]});
      continue;
    }
    pool.observed += observed[i];
    pool.expected += expected[i];
  }
  if (pool.expected >= smallestExpected || bins.empty()) {
    bins.push_back(pool);
  } else {
    // A pool that is still too small would turn one rare count into certainty; the smallest bin takes it in.
    Bin& smallest = *std::ranges::min_element(bins, {}, &Bin::expected);
    smallest.observed += pool.observed;
    smallest.expected += pool.expected;
  }
  TestResult result;
  for (const Bin& bin : bins) {
    const double deviation = bin.observed - bin.expected;
    result.statistic += bin.expected > 0.0 ? deviation * deviation / bin.expected : 0.0;
  }
  result.degrees = double(bins.size()) - 1.0;
  result.p = bins.size() > 1 ? chiSquaredSurvival(result.statistic, result.degrees) : 1.0;
  return result;
}

} // namespace tyndall::film

// SPDX-License-Identifier: Apache-2.0
#include "microbench/guiding_statistics.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace tyndall::microbench {
namespace {

constexpr std::size_t kResamples = 4000;

/// Draws runs with replacement. Where one run alone were drawn there would be no variance, so that does not count.
class Resampler {
public:
  explicit Resampler(std::size_t runs) : runs_(runs), choose_(0, runs - 1) {}

  Draws next() {
    Draws draws;
    do {
      draws.assign(runs_, 0);
      for (std::size_t i = 0; i < runs_; ++i) {
        ++draws[choose_(random_)];
      }
    } while (*std::max_element(draws.begin(), draws.end()) == runs_);
    return draws;
  }

private:
  std::size_t runs_;
  std::mt19937 random_; // the same sequence every time
  std::uniform_int_distribution<std::size_t> choose_;
};

/// Quantile of Student's t that 95 % intervals take.
double student(std::size_t runs) { return std::log(interval({1.0, 1.0}, runs).high); }

/// Quantiles of the resampled values, further out than 2.5 % because few runs spread too little when they are drawn
/// anew: T. Hesterberg, What teachers should know about the bootstrap, The American Statistician 69 (2015), 5.3.
Interval expandedRange(std::vector<double> values, std::size_t runs) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone};
  }
  std::sort(values.begin(), values.end());
  const double distance = std::sqrt(double(runs) / double(runs - 1)) * student(runs);
  const double tail = 0.5 * std::erfc(distance / std::sqrt(2.0));
  const auto index = static_cast<std::size_t>(tail * double(values.size()));
  return {values[index], values[values.size() - 1 - index]};
}

/// Geometric mean over the drawn rounds of reference's time over the row's.
double speed(const Efficiency& reference, const Efficiency& row, const Draws& draws) {
  double sum = 0.0;
  for (std::size_t run = 0; run < draws.size(); ++run) {
    sum += draws[run] * std::log(reference.seconds[run] / row.seconds[run]);
  }
  return std::exp(sum / double(draws.size()));
}

double noNumberUnlessPositive(double ratio) {
  return ratio > 0.0 && std::isfinite(ratio) ? ratio : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

Mean imageMean(const Pictures& runs) {
  TYNDALL_CHECK(runs.size() >= 2);
  std::vector<double> means;
  for (const std::vector<double>& run : runs) {
    means.push_back(std::accumulate(run.begin(), run.end(), 0.0) / double(run.size()));
  }
  const double count = double(runs.size());
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / count;
  double squares = 0.0;
  for (const double each : means) {
    squares += (each - mean) * (each - mean);
  }
  return {mean, std::sqrt(squares / (count - 1.0) / count)};
}

std::vector<double> pixelVariances(const Pictures& runs) {
  TYNDALL_CHECK(runs.size() >= 2);
  const std::vector<double> mean = meanPicture(runs);
  std::vector<double> variances(mean.size(), 0.0);
  for (const std::vector<double>& run : runs) {
    for (std::size_t pixel = 0; pixel < run.size(); ++pixel) {
      const double off = run[pixel] - mean[pixel];
      variances[pixel] += off * off / double(runs.size() - 1);
    }
  }
  return variances;
}

std::vector<std::size_t> withoutWorst(std::span<const std::vector<double>> rows, double share) {
  TYNDALL_CHECK(!rows.empty() && share >= 0.0 && share < 1.0);
  std::vector<double> sum(rows.front().size(), 0.0);
  for (const std::vector<double>& row : rows) {
    std::transform(row.begin(), row.end(), sum.begin(), sum.begin(), std::plus<>());
  }
  std::vector<std::size_t> pixels(sum.size());
  std::iota(pixels.begin(), pixels.end(), std::size_t{0});
  std::stable_sort(pixels.begin(), pixels.end(), [&](std::size_t a, std::size_t b) { return sum[a] < sum[b]; });
  pixels.resize(pixels.size() - static_cast<std::size_t>(std::ceil(share * double(pixels.size()))));
  std::sort(pixels.begin(), pixels.end());
  return pixels;
}

RunProducts::RunProducts(const Pictures& runs, const std::vector<std::size_t>& pixels)
    : runs_(runs.size()), products_(runs.size() * runs.size(), 0.0) {
  TYNDALL_CHECK(runs_ >= 2 && !pixels.empty());
  const std::vector<double> mean = meanPicture(runs);
  for (std::size_t a = 0; a < runs_; ++a) {
    for (std::size_t b = 0; b < runs_; ++b) {
      for (const std::size_t pixel : pixels) {
        products_[a * runs_ + b] += (runs[a][pixel] - mean[pixel]) * (runs[b][pixel] - mean[pixel]);
      }
      products_[a * runs_ + b] /= double(pixels.size());
    }
  }
}

double RunProducts::variance(const Draws& draws) const {
  double squares = 0.0;
  double squareOfSum = 0.0;
  for (std::size_t a = 0; a < runs_; ++a) {
    squares += draws[a] * products_[a * runs_ + a];
    for (std::size_t b = 0; b < runs_; ++b) {
      squareOfSum += double(draws[a]) * draws[b] * products_[a * runs_ + b];
    }
  }
  return (squares - squareOfSum / double(runs_)) / double(runs_ - 1);
}

Gains gainsOver(const Efficiency& reference, const Efficiency& row) {
  const std::size_t runs = reference.products.runs();
  TYNDALL_CHECK(runs >= 3 && row.products.runs() == runs);
  TYNDALL_CHECK(reference.seconds.size() == runs && row.seconds.size() == runs);
  const auto inSamples = [&](const Draws& ofReference, const Draws& ofRow) {
    return noNumberUnlessPositive(reference.products.variance(ofReference) / row.products.variance(ofRow));
  };
  std::vector<double> samples;
  std::vector<double> time;
  Resampler resampler(runs);
  for (std::size_t i = 0; i < kResamples; ++i) {
    // Drawn apart: together, 3 to 5 runs would differ too little, and the truth lie outside twice as often.
    const Draws ofReference = resampler.next();
    const Draws ofRow = resampler.next();
    samples.push_back(inSamples(ofReference, ofRow));
    time.push_back(samples.back() * speed(reference, row, ofRow)); // times are of the same rounds
  }
  const Draws all(runs, 1);
  const double value = inSamples(all, all);
  return {{value, expandedRange(std::move(samples), runs)},
          {value * speed(reference, row, all), expandedRange(std::move(time), runs)}};
}

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#include "bench/variance.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

struct Spread {
  double mean = 0.0;
  double variance = 0.0; ///< of one value, unbiased
};

Spread spreadOf(const std::vector<double>& values) {
  Spread spread;
  const double count = double(values.size());
  for (const double value : values) {
    spread.mean += value / count;
  }
  for (const double value : values) {
    spread.variance += (value - spread.mean) * (value - spread.mean) / (count - 1.0);
  }
  return spread;
}

/// Image means of the runs.
std::vector<double> imageMeans(const Pictures& runs, const std::vector<std::size_t>& pixels) {
  std::vector<double> means;
  for (const std::vector<double>& run : runs) {
    double sum = 0.0;
    for (const std::size_t pixel : pixels) {
      sum += run[pixel];
    }
    means.push_back(sum / double(pixels.size()));
  }
  return means;
}

Pictures minus(const Pictures& a, const Pictures& b) {
  TYNDALL_CHECK(a.size() == b.size());
  Pictures result = a;
  for (std::size_t run = 0; run < a.size(); ++run) {
    std::transform(a[run].begin(), a[run].end(), b[run].begin(), result[run].begin(), std::minus<>());
  }
  return result;
}

} // namespace

Figure meanVariance(const Pictures& runs, const std::vector<std::size_t>& pixels) {
  if (runs.size() < 4 || pixels.empty()) {
    fail("a variance needs 4 runs or more and a pixel that sees the volume; got {} runs and {} pixels", runs.size(),
         pixels.size());
  }
  const double count = double(runs.size());
  double whole = 0.0;
  std::vector<double> without(runs.size(), 0.0); // sums of squares that leave one run out
  for (const std::size_t pixel : pixels) {
    double mean = 0.0;
    for (const std::vector<double>& run : runs) {
      mean += run[pixel] / count;
    }
    double squares = 0.0;
    for (const std::vector<double>& run : runs) {
      squares += (run[pixel] - mean) * (run[pixel] - mean);
    }
    whole += squares / (count - 1.0);
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const double off = runs[r][pixel] - mean;
      without[r] += (squares - off * off * count / (count - 1.0)) / (count - 2.0);
    }
  }
  const double perPixel = 1.0 / double(pixels.size());
  if (whole <= 0.0) {
    return {0.0, 0.0};
  }
  std::transform(without.begin(), without.end(), without.begin(), [](double each) { return std::log(each); });
  return {whole * perPixel, (count - 1.0) / std::sqrt(count) * std::sqrt(spreadOf(without).variance)};
}

std::vector<double> meanPicture(const Pictures& runs) {
  TYNDALL_CHECK(!runs.empty());
  std::vector<double> mean(runs.front().size(), 0.0);
  for (const std::vector<double>& run : runs) {
    std::transform(run.begin(), run.end(), mean.begin(), mean.begin(),
                   [&](double value, double sum) { return sum + value / double(runs.size()); });
  }
  return mean;
}

double meanSquare(const std::vector<double>& picture, const std::vector<std::size_t>& pixels) {
  double sum = 0.0;
  for (const std::size_t pixel : pixels) {
    sum += picture[pixel] * picture[pixel];
  }
  return sum / double(pixels.size());
}

Difference difference(const Pictures& a, const Pictures& b, const std::vector<std::size_t>& pixels, bool paired) {
  const Spread other = spreadOf(imageMeans(b, pixels));
  const std::vector<double> reference = meanPicture(b);
  std::vector<double> apart = meanPicture(a);
  std::transform(apart.begin(), apart.end(), reference.begin(), apart.begin(), std::minus<>());
  double noise = 0.0; // mean over pixels of the variance of `apart`
  Spread image;
  if (paired) {
    const Pictures differences = minus(a, b);
    image = spreadOf(imageMeans(differences, pixels));
    image.variance /= double(a.size());
    noise = meanVariance(differences, pixels).value / double(a.size());
  } else {
    const Spread own = spreadOf(imageMeans(a, pixels));
    image = {own.mean - other.mean, own.variance / double(a.size()) + other.variance / double(b.size())};
    noise = meanVariance(a, pixels).value / double(a.size()) + meanVariance(b, pixels).value / double(b.size());
  }
  Difference result;
  result.mean = image.mean / other.mean;
  result.meanError = std::sqrt(image.variance) / std::abs(other.mean);
  result.rms = std::sqrt(std::max(meanSquare(apart, pixels) - noise, 0.0) / meanSquare(reference, pixels));
  return result;
}

} // namespace tyndall::bench

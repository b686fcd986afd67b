// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"
#include "film/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::film {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kCoveredOpacity = 0.01;  // docs/conventions.md, rRMSE
constexpr unsigned kLargestTile = 16;
constexpr std::size_t kEnoughTiles = 32;
constexpr double kConfidence = 0.9;

/// Sums over the colour channels of one pixel, or over the pixels of a tile.
struct ErrorSums {
  double variance = 0.0;       ///< of the mean
  double squaredMean = 0.0;    ///< mean^2 - variance: unbiased for the square of the true value
  std::size_t coveredPixels = 0;
  std::uint32_t batches = std::numeric_limits<std::uint32_t>::max();  ///< fewest over the covered pixels

  ErrorSums& operator+=(const ErrorSums& other) {
    variance += other.variance;
    squaredMean += other.squaredMean;
    coveredPixels += other.coveredPixels;
    batches = std::min(batches, other.batches);
    return *this;
  }
};

ErrorSums colourSums(const std::array<HalfEstimate, 3>& colour, std::uint32_t batches) {
  ErrorSums sums{.coveredPixels = 1, .batches = batches};
  for (const HalfEstimate& channel : colour) {
    sums.variance += channel.variance;
    sums.squaredMean += channel.mean * channel.mean - channel.variance;
  }
  return sums;
}

ErrorSums total(const std::vector<ErrorSums>& parts) {
  ErrorSums sum;
  for (const ErrorSums& part : parts) {
    sum += part;
  }
  return sum;
}

/// Sums over tiles of `size` pixels a side; tiles without covered pixels are left out.
std::vector<ErrorSums> tileSums(const std::vector<ErrorSums>& pixels, unsigned width, unsigned size) {
  const std::size_t height = pixels.size() / width;
  const std::size_t columns = (width + size - 1) / size;
  std::vector<ErrorSums> tiles(columns * ((height + size - 1) / size));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    tiles[(i / width / size) * columns + (i % width) / size] += pixels[i];
  }
  std::erase_if(tiles, [](const ErrorSums& tile) { return tile.coveredPixels == 0; });
  return tiles;
}

/// Delete-one jackknife variance of log(sum variance / sum squaredMean), by the delta method: the ratio itself is
/// jackknifed, because a deleted tile may hold all of the noise, whose logarithm has no limit.
double jackknifeLogVariance(const std::vector<ErrorSums>& tiles, const ErrorSums& all) {
  const double ratio = all.variance / all.squaredMean;
  std::vector<double> deleted;
  double mean = 0.0;
  for (const ErrorSums& tile : tiles) {
    const double rest = all.squaredMean - tile.squaredMean;
    if (rest <= 0.0) {
      return kInfinity;
    }
    deleted.push_back((all.variance - tile.variance) / rest);
    mean += deleted.back() / double(tiles.size());
  }
  double scatter = 0.0;
  for (const double value : deleted) {
    scatter += (value - mean) * (value - mean);
  }
  return scatter * double(tiles.size() - 1) / double(tiles.size()) / (ratio * ratio);
}

/// Upper bound on the error that this one picture has, not only on its expectation. Two things spread on the log
/// scale: the estimate (jackknife over tiles) and the picture's own sum of squared errors, 2 sum v^2 / (sum v)^2 for
/// normal pixels whose channels err together.
double upperBound(const std::vector<ErrorSums>& pixels, unsigned width, const ErrorSums& all) {
  std::vector<ErrorSums> tiles;
  // Pixels are independent, so smaller tiles are as valid; they only give a small picture enough of them.
  for (unsigned size = kLargestTile; size >= 1 && tiles.size() < kEnoughTiles; size /= 2) {
    tiles = tileSums(pixels, width, size);
  }
  double sumOfSquares = 0.0;
  for (const ErrorSums& pixel : pixels) {
    sumOfSquares += pixel.variance * pixel.variance;
  }
  const double ownSpread = 2.0 * sumOfSquares / (all.variance * all.variance);
  // One pixel has no spread over tiles; the variance of a variance over k normal batches stands in.
  const bool single = tiles.size() < 2;
  const double estimateSpread = single ? 2.0 / double(all.batches - 1) : jackknifeLogVariance(tiles, all);
  const double degrees = single ? double(all.batches - 1) : double(tiles.size() - 1);
  const double quantile = studentTQuantile(kConfidence, degrees);
  return std::sqrt(all.variance / all.squaredMean * std::exp(quantile * std::sqrt(ownSpread + estimateSpread)));
}

ErrorEstimate estimateFrom(const std::vector<ErrorSums>& pixels, unsigned width) {
  const ErrorSums all = total(pixels);
  if (all.coveredPixels == 0 || all.variance == 0.0) {
    return {.coveredPixels = all.coveredPixels};
  }
  if (!std::isfinite(all.variance) || all.squaredMean <= 0.0) {
    // Too few batches, or noise that hides the picture altogether.
    return {kInfinity, kInfinity, all.coveredPixels};
  }
  return {std::sqrt(all.variance / all.squaredMean), upperBound(pixels, width, all), all.coveredPixels};
}

} // namespace

ErrorEstimate estimateError(const Film& film) {
  std::vector<ErrorSums> pixels(film.pixels().size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (1.0 - film.mean(i, T) <= kCoveredOpacity) {
      continue;
    }
    std::array<HalfEstimate, 3> colour;
    for (int channel = R; channel <= B; ++channel) {
      colour[channel] = {film.mean(i, channel), film.varianceOfMean(i, channel)};
    }
    const PixelState& state = film.pixels()[i];
    pixels[i] = colourSums(colour, state.batches[0] + state.batches[1]);
  }
  return estimateFrom(pixels, film.window().extent().x);
}

ErrorEstimate estimateErrorFromHalf(const Film& film, int half) {
  std::vector<ErrorSums> pixels(film.pixels().size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    // A pixel that the renderer finished after one batch has nothing in the other half, which must not count as opaque.
    const bool empty = film.pixels()[i].samples[half] == 0;
    const double transmittance = empty ? film.mean(i, T) : film.halfEstimate(i, half, T).mean;
    if (1.0 - transmittance <= kCoveredOpacity) {
      continue;
    }
    std::array<HalfEstimate, 3> colour;
    for (int channel = R; channel <= B; ++channel) {
      colour[channel] = film.halfEstimate(i, half, channel);
    }
    pixels[i] = colourSums(colour, film.pixels()[i].batches[half]);
    // The squared mean is this half's own; the picture's variance is that of two such halves.
    pixels[i].variance *= 0.5;
  }
  return estimateFrom(pixels, film.window().extent().x);
}

} // namespace tyndall::film

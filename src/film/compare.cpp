// SPDX-License-Identifier: Apache-2.0
#include "film/compare.h"

#include "base/error.h"
#include "film/statistics.h"

#include <algorithm>
#include <cmath>

namespace tyndall::film {
namespace {

using Colour = std::array<const std::vector<float>*, 3>;

constexpr double kCoveredOpacity = 0.01;

/// Both pictures, channel by channel, and the pixels that count.
struct Pair {
  Colour image;
  Colour reference;
  std::array<const std::vector<float>*, 3> imageError{};      ///< null: exact
  std::array<const std::vector<float>*, 3> referenceError{};
  std::vector<std::size_t> finite;

  double difference(std::size_t pixel, int channel) const {
    return double((*image[channel])[pixel]) - double((*reference[channel])[pixel]);
  }
  double value(std::size_t pixel, int channel) const { return double((*reference[channel])[pixel]); }
  bool hasError() const { return imageError[0] != nullptr || referenceError[0] != nullptr; }
  /// Variance of difference().
  double variance(std::size_t pixel, int channel) const {
    double sum = 0.0;
    for (const std::vector<float>* error : {imageError[channel], referenceError[channel]}) {
      sum += error == nullptr ? 0.0 : double((*error)[pixel]) * double((*error)[pixel]);
    }
    return sum;
  }
};

bool finiteAt(const Colour& colour, std::size_t pixel) {
  return std::ranges::all_of(colour, [&](const auto* channel) { return std::isfinite((*channel)[pixel]); });
}

/// All three channels of the stderr layer, or nulls.
std::array<const std::vector<float>*, 3> errorChannels(const Image& image) {
  std::array<const std::vector<float>*, 3> layer{findChannel(image, "stderr.R"), findChannel(image, "stderr.G"),
                                                 findChannel(image, "stderr.B")};
  const bool complete = std::ranges::none_of(layer, [](const auto* channel) { return channel == nullptr; });
  return complete ? layer : std::array<const std::vector<float>*, 3>{};
}

void measureDifferences(Comparison& result, const Pair& pair, const Image& reference) {
  double mean = 0.0;
  for (const std::size_t pixel : pair.finite) {
    for (int channel = 0; channel < 3; ++channel) {
      mean += pair.value(pixel, channel) / (3.0 * double(pair.finite.size()));
    }
  }
  const double eps = kRelMseFloor * mean;
  double coveredError = 0.0;
  double coveredSignal = 0.0;
  for (const std::size_t pixel : pair.finite) {
    const bool covered = coveredAt(reference, pixel);
    result.coveredPixels += covered ? 1 : 0;
    for (int channel = 0; channel < 3; ++channel) {
      const double value = pair.value(pixel, channel);
      const double difference = pair.difference(pixel, channel);
      const double squared = difference * difference;
      const double scale = value * value + eps * eps;
      result.mse += squared;
      result.relMse += squared == 0.0 ? 0.0 : squared / scale;
      result.maxDifference = std::max(result.maxDifference, std::abs(difference));
      coveredError += covered ? squared : 0.0;
      coveredSignal += covered ? value * value : 0.0;
    }
  }
  const double terms = 3.0 * double(std::max<std::size_t>(pair.finite.size(), 1));
  result.mse /= terms;
  result.relMse /= terms;
  result.rRmse = coveredError == 0.0 ? 0.0 : std::sqrt(coveredError / coveredSignal);
}

/// z and two-sided p of a difference with this variance. Without variance any difference is certain.
struct Significance {
  double z = 0.0;
  double p = 1.0;
};
Significance significance(double difference, double variance) {
  if (difference == 0.0) {
    return {};
  }
  const double z = difference / std::sqrt(variance);
  return {z, normalTwoSidedP(z)};
}

ChannelBias biasOf(const Pair& pair, int channel) {
  ChannelBias bias;
  double difference = 0.0;
  double variance = 0.0;
  const double count = double(std::max<std::size_t>(pair.finite.size(), 1));
  for (const std::size_t pixel : pair.finite) {
    bias.meanReference += pair.value(pixel, channel) / count;
    difference += pair.difference(pixel, channel) / count;
    variance += pair.variance(pixel, channel) / (count * count);
  }
  bias.meanImage = bias.meanReference + difference;
  bias.relative = difference == 0.0 ? 0.0 : difference / std::abs(bias.meanReference);
  if (pair.hasError()) {
    const Significance test = significance(difference, variance);
    bias.standardError = std::sqrt(variance);
    bias.z = test.z;
    bias.p = test.p;
  }
  return bias;
}

TileTest testTiles(const Pair& pair, const Window& window, unsigned tile) {
  const unsigned width = window.extent().x;
  const unsigned columns = (width + tile - 1) / tile;
  const unsigned rows = (window.extent().y + tile - 1) / tile;
  struct Sums {
    double difference = 0.0;
    double variance = 0.0;
    bool used = false;
  };
  std::vector<std::array<Sums, 3>> tiles(std::size_t(columns) * rows);
  for (const std::size_t pixel : pair.finite) {
    for (int channel = 0; channel < 3; ++channel) {
      Sums& sums = tiles[(pixel / width / tile) * columns + (pixel % width) / tile][channel];
      sums.difference += pair.difference(pixel, channel);
      sums.variance += pair.variance(pixel, channel);
      sums.used = true;
    }
  }
  TileTest result;
  double smallestP = 1.0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const Sums& sums = tiles[i][channel];
      result.tests += sums.used ? 1 : 0;
      const Significance test = significance(sums.difference, sums.variance);
      if (std::abs(test.z) > std::abs(result.worstZ)) {
        result.worstZ = test.z;
        result.worstTile = window.min + tile * glm::uvec2(i % columns, i / columns);
        result.worstChannel = channel;
        smallestP = test.p;
      }
    }
  }
  result.familyP = sidakFamilyP(smallestP, double(result.tests));
  return result;
}

} // namespace

bool coveredAt(const Image& image, std::size_t pixel) {
  if (const auto* transmittance = findChannel(image, "transmittance.Y"); transmittance != nullptr) {
    return 1.0 - double((*transmittance)[pixel]) > kCoveredOpacity;
  }
  const auto* alpha = findChannel(image, "A");
  return alpha == nullptr || double((*alpha)[pixel]) > kCoveredOpacity;
}

void checkSameShape(const NamedImage& a, const NamedImage& b) {
  const glm::uvec2 sizeA = a.image.displaySize;
  const glm::uvec2 sizeB = b.image.displaySize;
  if (sizeA != sizeB) {
    fail("{} is {}x{} and {} is {}x{}; compare pictures of one size", a.name, sizeA.x, sizeA.y, b.name, sizeB.x,
         sizeB.y);
  }
  const Window& windowA = a.image.window;
  const Window& windowB = b.image.window;
  if (windowA != windowB) {
    fail("{} holds pixels ({},{}) to ({},{}) and {} holds ({},{}) to ({},{}); compare equal crops", a.name,
         windowA.min.x, windowA.min.y, windowA.max.x, windowA.max.y, b.name, windowB.min.x, windowB.min.y,
         windowB.max.x, windowB.max.y);
  }
}

Comparison compare(const NamedImage& image, const NamedImage& reference, const CompareOptions& options) {
  checkSameShape(image, reference);
  Pair pair{colourChannels(image.image, image.name), colourChannels(reference.image, reference.name),
            errorChannels(image.image), errorChannels(reference.image), {}};
  Comparison result;
  for (std::size_t pixel = 0; pixel < image.image.window.pixelCount(); ++pixel) {
    const bool imageFinite = finiteAt(pair.image, pixel);
    const bool referenceFinite = finiteAt(pair.reference, pixel);
    result.nonFiniteImage += imageFinite ? 0 : 1;
    result.nonFiniteReference += referenceFinite ? 0 : 1;
    if (imageFinite && referenceFinite) {
      pair.finite.push_back(pixel);
    }
  }
  result.pixels = pair.finite.size();
  measureDifferences(result, pair, reference.image);
  double smallestP = 1.0;
  for (int channel = 0; channel < 3; ++channel) {
    result.bias[channel] = biasOf(pair, channel);
    smallestP = std::min(smallestP, result.bias[channel].p);
  }
  result.channelFamilyP = sidakFamilyP(smallestP, 3.0);
  if (pair.hasError()) {
    result.tiles = testTiles(pair, image.image.window, options.tile);
  }
  return result;
}

} // namespace tyndall::film

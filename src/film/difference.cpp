// SPDX-License-Identifier: Apache-2.0
#include "film/difference.h"

#include "base/error.h"
#include "film/png.h"

#include <algorithm>
#include <cmath>

namespace tyndall::film {
namespace {

std::vector<double> meanDifferences(const NamedImage& image, const NamedImage& reference) {
  checkSameShape(image, reference);
  const auto a = colourChannels(image.image, image.name);
  const auto b = colourChannels(reference.image, reference.name);
  std::vector<double> differences(image.image.window.pixelCount(), 0.0);
  for (std::size_t pixel = 0; pixel < differences.size(); ++pixel) {
    for (int channel = 0; channel < 3; ++channel) {
      differences[pixel] += (double((*a[channel])[pixel]) - double((*b[channel])[pixel])) / 3.0;
    }
  }
  return differences;
}

/// 99th percentile of |difference|, or the largest where almost all pixels are equal.
double fullScale(const std::vector<double>& differences) {
  std::vector<double> sizes;
  for (const double difference : differences) {
    if (std::isfinite(difference)) {
      sizes.push_back(std::abs(difference));
    }
  }
  if (sizes.empty()) {
    return 0.0;
  }
  const auto percentile = sizes.begin() + std::ptrdiff_t(0.99 * double(sizes.size() - 1));
  std::nth_element(sizes.begin(), percentile, sizes.end());
  return *percentile > 0.0 ? *percentile : *std::max_element(sizes.begin(), sizes.end());
}

std::array<std::uint8_t, 3> falseColour(double difference, double full) {
  if (!std::isfinite(difference)) {
    return {255, 220, 0};
  }
  const double strength = full > 0.0 ? std::min(std::abs(difference) / full, 1.0) : 0.0;
  const auto faded = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - strength)));
  return difference > 0.0 ? std::array<std::uint8_t, 3>{255, faded, faded}
                          : std::array<std::uint8_t, 3>{faded, faded, 255};
}

} // namespace

DifferenceScale writeDifferencePng(const std::filesystem::path& path, const NamedImage& image,
                                   const NamedImage& reference) {
  const std::vector<double> differences = meanDifferences(image, reference);
  const double full = fullScale(differences);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * differences.size());
  for (const double difference : differences) {
    const auto colour = falseColour(difference, full);
    bytes.insert(bytes.end(), colour.begin(), colour.end());
  }
  writePngBytes(path, image.image.window.extent(), bytes);
  return {full};
}

} // namespace tyndall::film

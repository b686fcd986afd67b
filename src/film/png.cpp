// SPDX-License-Identifier: Apache-2.0
#include "film/png.h"

#include "base/error.h"
#include "base/file.h"
#include "math/colour.h"

#include <png.h>

#include <algorithm>
#include <cmath>

namespace tyndall::film {
namespace {

/// Threshold in (0, 1) of the 8x8 Bayer matrix: bits of x^y and y, interleaved from the lowest up.
double ditherThreshold(unsigned x, unsigned y) {
  unsigned rank = 0;
  for (unsigned bit = 0; bit < 3; ++bit) {
    rank = (rank << 2) | ((((x ^ y) >> bit) & 1u) << 1) | ((y >> bit) & 1u);
  }
  return (rank + 0.5) / 64.0;
}

/// Display-linear to an 8-bit code; the threshold replaces the 1/2 of plain rounding. 0 and 1 stay 0 and 255.
std::uint8_t encode(double displayLinear, double threshold) {
  if (!(displayLinear > 0.0)) {
    return 0;  // negative means are cut here and nowhere earlier; NaN is counted by the caller
  }
  return static_cast<std::uint8_t>(255.0 * srgbFromLinear(std::min(displayLinear, 1.0)) + threshold);
}

} // namespace

PngReport writePng(const std::filesystem::path& path, const Image& image, const PngOptions& options) {
  const CompositedPixels pixels(image, path.string());
  const double gain = std::exp2(options.exposure);
  const unsigned width = image.window.extent().x;
  std::vector<std::uint8_t> bytes(3 * pixels.size());
  PngReport report;
  std::size_t clipped = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const glm::dvec3 linear = pixels[i];
    report.nonFinitePixels += std::isfinite(linear.r) && std::isfinite(linear.g) && std::isfinite(linear.b) ? 0 : 1;
    const glm::dvec3 display = displayColour(gain * linear, options.view);
    clipped += display.r > 1.0 || display.g > 1.0 || display.b > 1.0 ? 1 : 0;
    const double threshold = ditherThreshold(unsigned(i % width), unsigned(i / width));
    for (int channel = 0; channel < 3; ++channel) {
      bytes[3 * i + channel] = encode(display[channel], threshold);
    }
  }
  report.clippedShare = pixels.size() > 0 ? double(clipped) / double(pixels.size()) : 0.0;
  writePngBytes(path, image.window.extent(), bytes);
  return report;
}

void writePngBytes(const std::filesystem::path& path, const glm::uvec2& size, std::span<const std::uint8_t> rgb) {
  TYNDALL_CHECK(rgb.size() == std::size_t{3} * size.x * size.y);
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    png_image picture{};
    picture.version = PNG_IMAGE_VERSION;
    picture.width = size.x;
    picture.height = size.y;
    picture.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&picture, temporary.c_str(), 0, rgb.data(), 0, nullptr) == 0) {
      fail("{}: the PNG cannot be written ({}); free some space or name another output with -o", path.string(),
           picture.message);
    }
  });
}

} // namespace tyndall::film

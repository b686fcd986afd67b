// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/tone.h"

#include <span>

namespace tyndall::film {

struct PngOptions {
  double exposure = 0.0;  ///< stops
  View view = View::Standard;
};

struct PngReport {
  double clippedShare = 0.0;          ///< pixels with a channel above display white, of all pixels
  std::size_t nonFinitePixels = 0;    ///< written as black (NaN) or clipped (infinity)
};

/// The image's window as 8-bit sRGB, over its background layer if it has one. Ordered dither of half a step; the same
/// image always gives the same file. @throws Error if it cannot be written or has no colour.
PngReport writePng(const std::filesystem::path& path, const Image& image, const PngOptions& options);

/// 8-bit sRGB, three bytes a pixel, rows from the top. Appears whole or not at all. @throws Error
void writePngBytes(const std::filesystem::path& path, const glm::uvec2& size, std::span<const std::uint8_t> rgb);

} // namespace tyndall::film

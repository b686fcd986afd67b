// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/exr.h"

namespace tyndall::film {

/// Value of depth.Z where nothing was hit: farther than anything, and finite, so that filters and resizing of the layer
/// make no NaN of it. Blender's depth pass has the same.
inline constexpr float kFarDepth = 1e10f;

struct PictureOptions {
  /// The film's R, G, B were rendered without the background; its own mean goes to the layer `background`.
  bool transparent = false;
  /// The film's R, G, B include a background that the camera sees: A is 1. (Ignored if transparent.)
  bool opaqueBackground = false;
  /// Names of aovNames(): layers that are added.
  std::vector<std::string> aovs{};
};

/// stderr         stderr.R/G/B: standard error of the mean of R, G, B; infinity below two batches
/// transmittance  transmittance.Y: of the media and surfaces along the pixel's camera rays, in [0, 1]
/// depth          depth.Z: opacity-weighted mean distance from the camera, scene units; kFarDepth without opacity
/// samples        samples.Y (integers): samples per pixel
/// albedo         albedo.R/G/B: opacity-weighted albedo, premultiplied like R, G, B
const std::vector<std::string>& aovNames();

/// R, G, B, A (premultiplied) and the layers asked for. A = 1 - transmittance, or 1 over an opaque background.
/// @throws Error if an AOV is unknown, with the nearest name and the list.
Image makeImage(const Film& film, const PictureOptions& options);

} // namespace tyndall::film

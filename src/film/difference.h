// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/compare.h"

namespace tyndall::film {

/// What the colours of a difference picture mean.
struct DifferenceScale {
  double full = 0.0;  ///< |difference| (mean of R, G, B) at full red or blue: the 99th percentile
};

/// PNG of image - reference: red where the image is brighter, blue where it is darker, white where equal, yellow where
/// one is not finite. @throws Error if the images do not fit or the file cannot be written.
DifferenceScale writeDifferencePng(const std::filesystem::path& path, const NamedImage& image,
                                   const NamedImage& reference);

} // namespace tyndall::film

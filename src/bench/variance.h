// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/figure.h"

#include <cstddef>
#include <vector>

namespace tyndall::bench {

/// Pictures of several independent seeds: [run][pixel], one value per pixel.
using Pictures = std::vector<std::vector<double>>;

/// Mean over `pixels` of the unbiased variance of one run's value. Its error by the jackknife over the runs.
/// @throws Error with fewer than 4 runs or without pixels.
Figure meanVariance(const Pictures& runs, const std::vector<std::size_t>& pixels);

/// Mean over the runs of every pixel.
std::vector<double> meanPicture(const Pictures& runs);

/// Mean over `pixels` of the square of a picture.
double meanSquare(const std::vector<double>& picture, const std::vector<std::size_t>& pixels);

/// How far the means of two series of runs are apart over `pixels`, as shares of the second one's mean and rms.
struct Difference {
  double mean = 0.0;      ///< of the image means
  double meanError = 0.0; ///< standard error of that
  double rms = 0.0;       ///< over pixels, the noise taken off; 0 where that leaves nothing
};
/// @param paired run i of both had the same random numbers: differences are taken run by run.
Difference difference(const Pictures& a, const Pictures& b, const std::vector<std::size_t>& pixels, bool paired);

} // namespace tyndall::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/figure.h"

#include <glm/glm.hpp>

#include <array>
#include <filesystem>
#include <vector>

namespace tyndall::bench {

/// Colour of a picture, R, G, B of each pixel in turn, x fastest: 3 x pixels values.
struct Picture {
  glm::uvec2 size{0};
  std::vector<double> values;
  std::vector<bool> covered; ///< pixels where 1 - T > 0.01 or a surface is seen
};

/// @throws Error if the file cannot be read, or has a value that is not finite.
Picture readPicture(const std::filesystem::path& exr);

/// A picture that is known without noise, where it is.
struct ExactPicture {
  Picture picture;
  std::vector<bool> sure; ///< by pixel
};

/// Pictures of the same scene and effort by different seeds.
using Replicates = std::vector<Picture>;

/// Mean of the pictures, which must not be none; covered where one of them is.
Picture meanOf(const Replicates& pictures);

/// What errors are measured against, and the weight of each value's squared error in the two measures of
/// docs/conventions.md, relMSE and rRMSE squared.
struct Reference {
  Picture picture;
  bool exact = false;     ///< false: the mean of many pictures; what they scatter by is the error
  std::vector<bool> sure; ///< pixels that count; empty: all
  std::vector<double> relMseWeights;
  std::vector<double> rRmseWeights; ///< of the square of rRMSE
};
Reference referenceOf(Picture picture, bool exact, const std::vector<bool>& sure = {});

/// Errors of one picture among its replicates.
struct Errors {
  Figure relMse;
  Figure rRmse;
};
/// Against an exact reference, the mean of what the pictures differ from it; else their unbiased variance, its error
/// by the jackknife. One picture alone: what it differs from the reference.
Errors errorsOf(const Replicates& pictures, const Reference& reference);

/// Relative error of each pixel: root of the mean over channels of the relMSE's terms.
std::vector<double> errorMap(const Replicates& pictures, const Reference& reference);

/// How far the expectation of a series of pictures is from the reference, which `against` made unless it is exact.
struct Bias {
  double mean = 0.0;      ///< of the image means, over the reference's
  double meanError = 0.0; ///< standard error of that; 0: there is one picture only
  double relMse = 0.0;    ///< what of the relMSE does not go away with samples, noise taken off; may be negative
  double rRmse = 0.0;     ///< likewise; 0 where the noise leaves nothing
  /// Whether it is more than chance: 4 standard errors of the mean, or more than half of what can be told of relMSE.
  bool found = false;
};
Bias biasOf(const Replicates& pictures, const Reference& reference, const Replicates& against);

} // namespace tyndall::bench

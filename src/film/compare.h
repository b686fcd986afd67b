// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/exr.h"

#include <optional>

namespace tyndall::film {

struct CompareOptions {
  unsigned tile = 16;                ///< pixels a side
  double familyRate = 1e-4;          ///< false alarms of the bias tests per comparison, Sidak-corrected
  std::optional<double> maxRrmse{};   ///< a larger rRMSE is a failure
  std::optional<double> maxBias{};    ///< a larger |relative bias| of a channel is a failure
};

/// Mean difference of a channel over the finite pixels.
struct ChannelBias {
  double meanImage = 0.0;
  double meanReference = 0.0;
  double relative = 0.0;             ///< (image - reference) / |reference|; infinity over a black reference
  std::optional<double> standardError;  ///< of meanImage - meanReference, if an image has its stderr layer
  double z = 0.0;                    ///< difference / standardError
  double p = 1.0;                    ///< two-sided, of this channel alone
};

/// Means over every tile and channel against their standard errors.
struct TileTest {
  std::size_t tests = 0;
  double worstZ = 0.0;
  glm::uvec2 worstTile{0};           ///< its first pixel, in the picture
  int worstChannel = 0;              ///< 0 R, 1 G, 2 B
  double familyP = 1.0;              ///< Sidak; below CompareOptions::familyRate the pictures differ
};

/// Definitions: docs/conventions.md. Pixels with a non-finite colour on either side are counted and left out of the rest.
struct Comparison {
  std::size_t pixels = 0;            ///< compared, so finite in both
  std::size_t nonFiniteImage = 0;
  std::size_t nonFiniteReference = 0;
  double mse = 0.0;                  ///< mean over pixels and channels of (x - r)^2
  double relMse = 0.0;               ///< mean of (x - r)^2 / (r^2 + eps^2), eps = 1 % of the mean of r
  double rRmse = 0.0;                ///< sqrt(sum (x - r)^2 / sum r^2) over covered pixels
  std::size_t coveredPixels = 0;     ///< 1 - T > 0.01 in the reference: its layer transmittance, else A, else all
  double maxDifference = 0.0;
  std::array<ChannelBias, 3> bias;
  std::optional<TileTest> tiles;     ///< if an image has a stderr layer
  double channelFamilyP = 1.0;       ///< Sidak over the three channels' p
};

/// eps of relMSE over the mean of the reference.
inline constexpr double kRelMseFloor = 0.01;

/// Whether a pixel counts in rRMSE: 1 - T > 0.01 in the picture's layer transmittance, else in A, else always.
bool coveredAt(const Image& image, std::size_t pixel);

struct NamedImage {
  std::string name;
  const Image& image;
};

/// @throws Error, with both names, if sizes or windows differ.
void checkSameShape(const NamedImage& a, const NamedImage& b);

/// An image without stderr layer counts as exact in the bias tests.
/// @throws Error if sizes or windows differ or colour is missing.
Comparison compare(const NamedImage& image, const NamedImage& reference, const CompareOptions& options = {});

/// Sentences on what fails: limits of the options, bias beyond the false-alarm rate, non-finite pixels. Empty: passed.
std::vector<std::string> failures(const Comparison& comparison, const CompareOptions& options);

/// The figures as a table for a terminal, ending in a line break.
std::string formatTable(const Comparison& comparison);

} // namespace tyndall::film

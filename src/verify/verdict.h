// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verify/moments.h"

#include <string>

/// Tests of moments against references and against each other.
namespace tyndall::verify {

/// False-alarm rate of one test (a family of pixels, channels or tiles), Sidak-corrected inside.
inline constexpr double kFamilyRate = 1e-4;

/// What a test of a family found.
struct Verdict {
  double familyP = 1.0;    ///< Sidak; below kFamilyRate: different
  double worstT = 0.0;     ///< in standard errors
  std::size_t worst = 0;   ///< pixel or tile
  double bias = 0.0;       ///< (estimate - reference) / reference of the worst
  double resolution = 0.0; ///< relative bias of the image mean (or of the worst one) that is one standard error
  double degrees = 0.0;    ///< of freedom, of tests of image means

  bool agrees() const { return familyP >= kFamilyRate; }
  std::string text() const;
};

/// Student's t of every pixel against its reference value. `tolerance` is a relative error that float arithmetic is
/// granted; pixels whose reference is NaN are left out.
Verdict pixelTest(const Moments& moments, const std::vector<double>& reference, int channel = 0,
                  double tolerance = 2e-6);
/// The mean over the image against `reference`: what sees the smallest bias.
Verdict imageTest(const Moments& moments, double reference, int channel = 0, double tolerance = 2e-6);
/// Welch's t of 16x16 tiles of two configurations (the image itself if it is smaller), all four channels.
Verdict tileTest(const Moments& a, const Moments& b, double tolerance = 2e-6);

/// Welch's t of the image means of a channel each.
Verdict channelTest(const Moments& a, int channelA, const Moments& b, int channelB);
Verdict channelTest(const Moments& a, const Moments& b, int channel = 0);

/// The mean of references that are not NaN.
double meanOf(const std::vector<double>& values);

} // namespace tyndall::verify

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace tyndall::light {

inline constexpr std::size_t kSkyWavelengths = 8;
inline constexpr double kSkyFirstNanometres = 410.0;
inline constexpr double kSkyStepNanometres = 40.0;

/// Wavelength `i` of a SkySpectrum [nm]: 410, 450, ... 690.
constexpr double skyNanometres(std::size_t i) { return kSkyFirstNanometres + kSkyStepNanometres * static_cast<double>(i); }

/// A smooth spectrum relative to the sun's above the atmosphere, at the wavelengths skyNanometres().
struct SkySpectrum {
  std::array<double, kSkyWavelengths> at{};

  static SkySpectrum grey(double value) {
    SkySpectrum result;
    result.at.fill(value);
    return result;
  }
  double operator[](std::size_t i) const { return at[i]; }
  double& operator[](std::size_t i) { return at[i]; }
  SkySpectrum& operator+=(const SkySpectrum& other) {
    for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
      at[i] += other.at[i];
    }
    return *this;
  }
  SkySpectrum& operator*=(const SkySpectrum& other) {
    for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
      at[i] *= other.at[i];
    }
    return *this;
  }
  SkySpectrum& operator*=(double factor) {
    for (double& value : at) {
      value *= factor;
    }
    return *this;
  }
};

inline SkySpectrum operator+(SkySpectrum a, const SkySpectrum& b) { return a += b; }
inline SkySpectrum operator*(SkySpectrum a, const SkySpectrum& b) { return a *= b; }
inline SkySpectrum operator*(double a, SkySpectrum b) { return b *= a; }

/// Linear Rec.709 as the CIE 1931 observer sees it, each channel divided by the sun's, so that the spectrum 1 is
/// (1, 1, 1). Outside the gamut a channel is negative. Against sums at 5 nm with the spectrum ASTM G-173, in units of
/// the largest channel: within 1 % for skies, 2.5 % for the sun through 35 air masses.
glm::dvec3 rgbFromSky(const SkySpectrum& spectrum);

/// A smooth spectrum of that colour: rgbFromSky() of it is `rgb`, and grey stays grey.
SkySpectrum skyFromRgb(const glm::dvec3& rgb);

} // namespace tyndall::light

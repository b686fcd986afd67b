// SPDX-License-Identifier: Apache-2.0
#include "light/blackbody.h"

#include "interop/blackbody.h"
#include "light/cie_1931.h"
#include "math/colour.h"

#include <algorithm>
#include <cmath>

namespace tyndall::light {
namespace {

// Exact by definition of the SI (2019).
constexpr double kPlanck = 6.62607015e-34;    // J s
constexpr double kLightSpeed = 299792458.0;   // m/s
constexpr double kBoltzmann = 1.380649e-23;   // J/K

/// Towards grey at constant luminance until no channel is negative.
glm::dvec3 clippedToGamut(const glm::dvec3& rgb) {
  const double grey = luminance(rgb);
  double saturation = 1.0;
  for (int c = 0; c < 3; ++c) {
    if (rgb[c] < 0.0) {
      saturation = std::min(saturation, grey / (grey - rgb[c]));
    }
  }
  return glm::max(glm::dvec3(grey) + saturation * (rgb - grey), glm::dvec3(0.0));
}

} // namespace

double planckRadiance(double wavelength, double kelvin) {
  if (!(kelvin > 0.0)) {
    return 0.0;
  }
  const double exponent = kPlanck * kLightSpeed / (wavelength * kBoltzmann * kelvin);
  return 2.0 * kPlanck * kLightSpeed * kLightSpeed / std::pow(wavelength, 5.0) / std::expm1(exponent);
}

glm::dvec3 blackbodyXyz(double kelvin) {
  constexpr double kMetresPerNanometre = 1e-9;
  glm::dvec3 xyz(0.0);
  // The sum at 5 nm is the CIE's own practice; the functions vanish at both ends.
  for (std::size_t i = 0; i < kCie1931.size(); ++i) {
    const double nanometres = kCieFirstNanometres + kCieStepNanometres * static_cast<double>(i);
    xyz += kCie1931[i] * planckRadiance(nanometres * kMetresPerNanometre, kelvin);
  }
  return xyz * (kCieStepNanometres * kMetresPerNanometre);
}

glm::dvec3 blackbodyRadiance(double kelvin) { return clippedToGamut(rec709FromXyz(blackbodyXyz(kelvin))); }

std::vector<glm::vec3> blackbodyTable() {
  using namespace interop;
  std::vector<glm::vec3> table;
  const double hottest = 1.0 / static_cast<double>(kBlackbodyMaxKelvin);
  const double coldest = 1.0 / static_cast<double>(kBlackbodyMinKelvin);
  for (uint i = 0; i < kBlackbodyEntries; ++i) {
    const double inverseKelvin = hottest + (coldest - hottest) * i / (kBlackbodyEntries - 1);
    const glm::dvec3 rgb = blackbodyRadiance(1.0 / inverseKelvin);
    table.emplace_back(glm::dvec3(std::log(rgb.r), rgb.g / rgb.r, rgb.b / rgb.r));
  }
  return table;
}

} // namespace tyndall::light

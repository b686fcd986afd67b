// SPDX-License-Identifier: Apache-2.0
#include "light/sky_spectrum.h"

#include "light/blackbody.h"
#include "light/cie_1931.h"
#include "math/colour.h"

#include <algorithm>

namespace tyndall::light {
namespace {

// The sun as a blackbody of its effective temperature [IAU15 B3]. Divided by the sun's own colour, the channels differ
// from those under the measured spectrum ASTM G-173 by less than 1 % for skies.
constexpr double kSunKelvin = 5772.0;

using Weights = std::array<glm::dvec3, kSkyWavelengths>;

/// Lagrange's polynomial of node `i` at a wavelength: extinction is smooth, so that eight nodes are enough.
double lagrange(std::size_t i, double nanometres) {
  double value = 1.0;
  for (std::size_t j = 0; j < kSkyWavelengths; ++j) {
    value *= j == i ? 1.0 : (nanometres - skyNanometres(j)) / (skyNanometres(i) - skyNanometres(j));
  }
  return value;
}

/// Integrals of each node's polynomial under the observer and the sun, over that of 1.
Weights makeWeights() {
  Weights weights{};
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < kCie1931.size(); ++k) {
    const double nanometres = kCieFirstNanometres + kCieStepNanometres * static_cast<double>(k);
    const glm::dvec3 response = rec709FromXyz(kCie1931[k]) * planckRadiance(nanometres * 1e-9, kSunKelvin);
    // Beyond the outer nodes the observer sees next to nothing: constant rather than extrapolated.
    const double inside = std::clamp(nanometres, skyNanometres(0), skyNanometres(kSkyWavelengths - 1));
    for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
      weights[i] += response * lagrange(i, inside);
    }
    sum += response;
  }
  for (glm::dvec3& weight : weights) {
    weight /= sum;
  }
  return weights;
}

const Weights& weights() {
  static const Weights made = makeWeights();
  return made;
}

/// Three hats about the channels' middles that sum to 1.
glm::dvec3 hats(double nanometres) {
  constexpr double kRed = 610.0;
  constexpr double kGreen = 545.0;
  constexpr double kBlue = 465.0;
  const double red = std::clamp((nanometres - kGreen) / (kRed - kGreen), 0.0, 1.0);
  const double blue = std::clamp((kGreen - nanometres) / (kGreen - kBlue), 0.0, 1.0);
  return {red, 1.0 - red - blue, blue};
}

/// Amounts of the hats that have a colour.
glm::dmat3 makeHatsFromRgb() {
  glm::dmat3 rgbFromHats(0.0);
  for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
    rgbFromHats += glm::outerProduct(weights()[i], hats(skyNanometres(i)));
  }
  return glm::inverse(rgbFromHats);
}

} // namespace

glm::dvec3 rgbFromSky(const SkySpectrum& spectrum) {
  const Weights& weight = weights();
  glm::dvec3 rgb(0.0);
  for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
    rgb += weight[i] * spectrum[i];
  }
  return rgb;
}

SkySpectrum skyFromRgb(const glm::dvec3& rgb) {
  static const glm::dmat3 hatsFromRgb = makeHatsFromRgb();
  const glm::dvec3 amounts = hatsFromRgb * rgb;
  SkySpectrum result;
  for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
    result[i] = glm::dot(amounts, hats(skyNanometres(i)));
  }
  return result;
}

} // namespace tyndall::light

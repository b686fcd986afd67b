// SPDX-License-Identifier: Apache-2.0
#include "light/blackbody.h"

#include "math/colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall::light {
namespace {

glm::dvec2 chromaticity(double kelvin) {
  const glm::dvec3 xyz = blackbodyXyz(kelvin);
  return glm::dvec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
}

TEST(Blackbody, ChromaticityIsThatOfTheCieTables) {
  // CIE 015 (illuminant A at 2856 K) and the Planckian locus of Wyszecki and Stiles.
  const struct { double kelvin, x, y; } known[] = {
      {2856.0, 0.44757, 0.40745}, {6500.0, 0.3135, 0.3237}, {2000.0, 0.5267, 0.4133}};
  for (const auto& point : known) {
    EXPECT_NEAR(chromaticity(point.kelvin).x, point.x, 2e-4) << point.kelvin;
    EXPECT_NEAR(chromaticity(point.kelvin).y, point.y, 2e-4) << point.kelvin;
  }
  EXPECT_GT(std::abs(chromaticity(2900.0).x - 0.44757), 2e-4); // the checker tells 44 K
}

TEST(Blackbody, IntegralIsStefanBoltzmann) {
  constexpr double kStefanBoltzmann = 5.670374419e-8; // W/(m2 K4)
  for (const double kelvin : {300.0, 2000.0, 20000.0}) {
    double integral = 0.0;
    const int steps = 20000;
    const double peak = 2.897771955e-3 / kelvin; // Wien's displacement
    for (int i = 0; i < steps; ++i) {
      const double logarithm = std::log(0.02) + (i + 0.5) / steps * std::log(1e6);
      const double wavelength = peak * std::exp(logarithm);
      integral += planckRadiance(wavelength, kelvin) * wavelength * std::log(1e6) / steps;
    }
    const double expected = kStefanBoltzmann * std::pow(kelvin, 4.0) / std::numbers::pi;
    EXPECT_NEAR(integral / expected, 1.0, 1e-5) << kelvin;
  }
}

TEST(Blackbody, GamutClippingKeepsLuminance) {
  for (double kelvin = 500.0; kelvin < 20000.0; kelvin *= 1.1) {
    const glm::dvec3 rgb = blackbodyRadiance(kelvin);
    EXPECT_GE(std::min({rgb.r, rgb.g, rgb.b}), 0.0) << kelvin;
    // Rec.709's luminance weights are rounded to four digits.
    EXPECT_NEAR(luminance(rgb) / blackbodyXyz(kelvin).y, 1.0, 1e-3) << kelvin;
  }
  EXPECT_EQ(blackbodyRadiance(0.0), glm::dvec3(0.0));
  EXPECT_EQ(blackbodyRadiance(-5.0), glm::dvec3(0.0));
}

TEST(Blackbody, LuminanceOfTheMeltingPointOfPlatinum) {
  // 60 cd/cm2 at 2042 K defined the candela until 1979, within 1 %.
  EXPECT_NEAR(683.0 * blackbodyXyz(2042.0).y / 6e5, 1.0, 0.01);
}

} // namespace
} // namespace tyndall::light

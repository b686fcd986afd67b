// SPDX-License-Identifier: Apache-2.0
#include "light/atmosphere.h"
#include "light/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall::light {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 sunAt(double elevationDegrees, double azimuthDegrees) {
  const double elevation = elevationDegrees * kPi / 180.0;
  const double azimuth = azimuthDegrees * kPi / 180.0;
  return -glm::dvec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth));
}

glm::dvec3 texel(const SkyMap& map, unsigned x, unsigned y) { return glm::dvec3(map.radiance[std::size_t(y) * map.size.x + x]); }

glm::dvec3 directionOf(const SkyMap& map, unsigned x, unsigned y) {
  const double azimuth = 2.0 * kPi * ((x + 0.5) / map.size.x - 0.5);
  const double polar = kPi * (y + 0.5) / map.size.y;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

/// Optical depth by brute force: midpoint rule with small steps, in vectors, without the table or the quadrature.
glm::dvec3 bruteDepth(const Atmosphere& atmosphere, const glm::dvec3& from, const glm::dvec3& direction, double length, int steps) {
  glm::dvec3 depth(0.0);
  for (int i = 0; i < steps; ++i) {
    // Small steps first: most of the matter is near the ground.
    const double a = std::pow(double(i) / steps, 2.0) * length;
    const double b = std::pow((i + 1.0) / steps, 2.0) * length;
    depth += atmosphere.at(glm::length(from + 0.5 * (a + b) * direction)).extinction * (b - a);
  }
  return depth;
}

double lengthToTop(const glm::dvec3& from, const glm::dvec3& direction) {
  const double b = glm::dot(from, direction);
  return -b + std::sqrt(b * b - glm::dot(from, from) + Atmosphere::kTopRadius * Atmosphere::kTopRadius);
}

/// [Nishita93]: single scattering along a ray that leaves the atmosphere.
glm::dvec3 bruteSky(const Atmosphere& atmosphere, const glm::dvec3& toSun, const glm::dvec3& w) {
  const glm::dvec3 viewer(0.0, Atmosphere::kGroundRadius + 0.2, 0.0);
  const double length = lengthToTop(viewer, w);
  const double cosine = glm::dot(toSun, w);
  const double rayleigh = 3.0 / (16.0 * kPi) * (1.0 + cosine * cosine);
  const double g = 0.76;
  const double haze = (1.0 - g * g) / (4.0 * kPi * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
  glm::dvec3 radiance(0.0);
  glm::dvec3 depth(0.0);
  const int steps = 1500;
  for (int i = 0; i < steps; ++i) {
    const double a = std::pow(double(i) / steps, 2.5) * length;
    const double b = std::pow((i + 1.0) / steps, 2.5) * length;
    const glm::dvec3 x = viewer + 0.5 * (a + b) * w;
    const Atmosphere::Coefficients medium = atmosphere.at(glm::length(x));
    const glm::dvec3 sun = bruteDepth(atmosphere, x, toSun, lengthToTop(x, toSun), 300);
    radiance += (medium.rayleigh * rayleigh + medium.haze * haze) * glm::exp(-depth - 0.5 * (b - a) * medium.extinction - sun) * (b - a);
    depth += medium.extinction * (b - a);
  }
  return radiance;
}

/// Largest relative difference between the map and brute force over a few directions above the horizon.
double worstSkyError(double turbidityOfMap, double turbidityOfOracle, double elevation) {
  const Atmosphere atmosphere(turbidityOfOracle);
  const glm::dvec3 sun = sunAt(elevation, 25.0);
  const SkyMap map = makeSky(sun, turbidityOfMap, glm::dvec3(0.3), {128, 64});
  double worst = 0.0;
  for (const unsigned y : {0u, 12u, 24u, 30u, 31u}) {
    for (const unsigned x : {0u, 37u, 72u, 73u, 101u}) {
      const glm::dvec3 expected = bruteSky(atmosphere, -sun, directionOf(map, x, y));
      const glm::dvec3 error = glm::abs(texel(map, x, y) / expected - 1.0);
      worst = std::max({worst, error.x, error.y, error.z});
    }
  }
  return worst;
}

TEST(Sky, EqualsBruteForceIntegration) {
  EXPECT_LT(worstSkyError(3.0, 3.0, 50.0), 0.005);
  EXPECT_LT(worstSkyError(1.0, 1.0, 20.0), 0.005);
  EXPECT_LT(worstSkyError(8.0, 8.0, 6.0), 0.005);
  EXPECT_GT(worstSkyError(3.1, 3.0, 50.0), 0.005); // the checker tells 3 % more haze
}

TEST(Sky, TransmittanceTableEqualsIntegration) {
  const Atmosphere atmosphere(3.0);
  for (const double height : {0.0, 0.2, 3.0, 12.0, 40.0}) {
    for (const double elevation : {0.0, 0.3, 1.0, 5.0, 30.0, 90.0}) {
      const glm::dvec3 from(0.0, Atmosphere::kGroundRadius + height, 0.0);
      const glm::dvec3 direction = -sunAt(elevation, 0.0);
      const glm::dvec3 expected = bruteDepth(atmosphere, from, direction, lengthToTop(from, direction), 20000);
      const glm::dvec3 depth = atmosphere.opticalDepthToTop(from.y, direction.y);
      for (int c = 0; c < 3; ++c) {
        // 0.5 % where light is left to speak of, 4e-4 of the sun where it is not.
        const double transmittance = std::exp(-expected[c]);
        EXPECT_NEAR(std::exp(-depth[c]), transmittance, 0.005 * transmittance + 4e-4) << height << ' ' << elevation;
      }
    }
  }
}

TEST(Sky, IsSymmetricAboutTheSunAndTurnsWithIt) {
  const SkyMap map = makeSky(sunAt(30.0, 0.0), 3.0, glm::dvec3(0.3), {64, 32});
  const SkyMap turned = makeSky(sunAt(30.0, 90.0), 3.0, glm::dvec3(0.3), {64, 32});
  for (unsigned y = 0; y < 32; ++y) {
    for (unsigned x = 0; x < 64; ++x) {
      EXPECT_NEAR(texel(map, x, y).g, texel(map, 63 - x, y).g, 1e-6);
      EXPECT_NEAR(texel(map, x, y).g, texel(turned, (x + 16) % 64, y).g, 1e-6);
    }
  }
}

TEST(Sky, LooksLikeASky) {
  const SkyMap noon = makeSky(sunAt(60.0, 0.0), 2.0, glm::dvec3(0.3), {128, 64});
  const glm::dvec3 zenith = texel(noon, 0, 0);
  EXPECT_GT(zenith.b, 1.5 * zenith.r);                    // blue
  EXPECT_GT(texel(noon, 0, 28).g, 1.2 * texel(noon, 0, 16).g); // brighter near the horizon
  EXPECT_GT(texel(noon, 64, 10).g, 5.0 * zenith.g);       // aureole about the sun
  const SkyMap sunset = makeSky(sunAt(1.0, 0.0), 2.0, glm::dvec3(0.3), {128, 64});
  EXPECT_GT(sunset.sunTransmittance.r, 3.0 * sunset.sunTransmittance.g);
  EXPECT_GT(sunset.sunTransmittance.g, 3.0 * sunset.sunTransmittance.b);
  EXPECT_GT(texel(sunset, 64, 31).r, 2.0 * texel(sunset, 64, 31).b);
}

TEST(Sky, SunBelowTheHorizonIsTwilightThenNight) {
  double previous = 1e9;
  for (const double elevation : {10.0, 0.0, -3.0, -8.0, -25.0}) {
    const SkyMap map = makeSky(sunAt(elevation, 0.0), 3.0, glm::dvec3(0.3), {64, 32});
    double sum = 0.0;
    for (const glm::vec3& value : map.radiance) {
      ASSERT_TRUE(std::isfinite(value.r) && std::isfinite(value.g) && std::isfinite(value.b));
      ASSERT_GE(std::min({value.r, value.g, value.b}), 0.0f);
      sum += static_cast<double>(value.g);
    }
    EXPECT_LT(sum, 0.7 * previous) << elevation;
    EXPECT_EQ(map.sunTransmittance == glm::dvec3(0.0), elevation < -2.0) << elevation;
    previous = sum;
  }
  EXPECT_LT(previous, 1e-6);
}

TEST(Sky, SunOverheadAndBlackGround) {
  const SkyMap map = makeSky({0.0, -1.0, 0.0}, 1.0, glm::dvec3(0.0), {32, 16});
  // Straight down lies 200 m of air in front of black ground.
  EXPECT_LT(texel(map, 3, 15).g, 1e-3);
  EXPECT_NEAR(texel(map, 3, 2).b, texel(map, 20, 2).b, 1e-6); // no azimuth is special
  // Pure air: Rayleigh's optical depth at 550 nm is 0.108, ozone's 0.028.
  EXPECT_NEAR(-std::log(map.sunTransmittance.g), 0.108 + 0.028, 0.005);
}

} // namespace
} // namespace tyndall::light

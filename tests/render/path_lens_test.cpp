// SPDX-License-Identifier: Apache-2.0
// The thin lens against closed forms: a small bright quad out of focus is a disc of known radius and irradiance.
#include "support/path_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace tyndall::test {
namespace {

constexpr double kLens = 0.3;  // radius
constexpr double kFocus = 4.0; // distance of the plane in focus
constexpr double kSide = 0.1;  // of the quad
constexpr double kRadiance = 50.0;
constexpr double kFov = 12.0;

/// Looks along -z from the origin at a quad at `distance`, off the axis by `aside`.
PathScene blurred(double distance, const glm::dvec2& aside) {
  PathScene test({24, 24});
  test.perspective({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, kFov);
  test.scene.camera.lensRadius = kLens;
  test.scene.camera.focusDistance = kFocus;
  test.lamp("lamp", kRadiance);
  test.quad("lamp", {aside.x - 0.5 * kSide, aside.y - 0.5 * kSide, -distance}, {kSide, 0.0, 0.0}, {0.0, kSide, 0.0});
  return test;
}

/// In the plane in focus, a point at distance z spreads over a disc of radius r |1 - f / z| about its projection, and a
/// quad of area A sends A / (pi r^2 (1 - z / f)^2) of its radiance to each point of it. Pixels near the rim: NaN.
std::vector<double> disc(const PathScene& test, double distance, const glm::dvec2& aside) {
  const double half = kFocus * std::tan(0.5 * glm::radians(kFov));
  const double pixel = 2.0 * half / test.scene.film.size.x;
  const double radius = kLens * std::abs(1.0 - kFocus / distance);
  const double share = kSide * kSide / (std::numbers::pi * kLens * kLens * std::pow(1.0 - distance / kFocus, 2));
  const double rim = std::sqrt(0.5) * (pixel + kSide * kFocus / distance); // half diagonals of a pixel and of the quad
  std::vector<double> picture;
  for (std::uint32_t y = 0; y < test.scene.film.size.y; ++y) {
    for (std::uint32_t x = 0; x < test.scene.film.size.x; ++x) {
      const glm::dvec2 point((x + 0.5) * pixel - half, half - (y + 0.5) * pixel);
      const double off = glm::length(point - aside * kFocus / distance) - radius;
      picture.push_back(std::abs(off) < rim ? std::numeric_limits<double>::quiet_NaN()
                                            : (off < 0.0 ? kRadiance * share : 0.0));
    }
  }
  return picture;
}

/// One standard error of the irradiance is 0.5 % in front, 2 % behind; outside of the disc not one sample may shine.
TEST(ThinLens, SpreadsASmallQuadOverItsCircleOfConfusion) {
  const glm::dvec2 aside(0.12, -0.08);
  for (const double distance : {1.9, 9.0}) { // in front of the plane in focus, and behind it
    PathScene test = blurred(distance, aside);
    const auto reference = disc(test, distance, aside);
    MomentOptions options = byPaths({.replicates = 32, .samples = 128});
    for (const double value : reference) {
      options.skip.push_back(std::isnan(value));
    }
    const Moments moments = renderMoments(test.scene, test.volumes, options);
    double inside = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      if (reference[i] == 0.0) {
        EXPECT_EQ(moments.mean(i), 0.0) << i;
      }
      inside += reference[i] > 0.0;
    }
    ASSERT_GT(inside, 20.0);
    EXPECT_AGREES(pixelTest(moments, reference)) << distance;
    EXPECT_AGREES(imageTest(moments, meanOf(reference), 0, 1e-5)) << distance;
    // Planted: a lens 10 % too large.
    EXPECT_DIFFERS(imageTest(moments, meanOf(reference) / (1.1 * 1.1), 0, 1e-5)) << distance;
  }
}

/// In the plane in focus the lens changes nothing.
TEST(ThinLens, KeepsWhatIsInFocusSharp) {
  PathScene test = blurred(kFocus, {0.1, 0.05});
  PathScene pinhole = test;
  pinhole.scene.camera.lensRadius = 0.0;
  const MomentOptions options = byPaths({.replicates = 32, .samples = 128});
  const Moments sharp =
      renderMoments(pinhole.scene, pinhole.volumes, byPaths({.replicates = 32, .samples = 128, .firstSeed = 1001}));
  const Moments focused = renderMoments(test.scene, test.volumes, options);
  EXPECT_AGREES(tileTest(focused, sharp));
  test.scene.camera.focusDistance = 2.5; // planted
  const Moments out = renderMoments(test.scene, test.volumes, options);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < sharp.pixels.size(); ++i) {
    lit += out.mean(i) > 0.0 && sharp.mean(i) == 0.0;
    EXPECT_TRUE(focused.mean(i) == 0.0 || sharp.mean(i) > 0.0) << i; // not one sample elsewhere
  }
  EXPECT_GT(lit, 10u);
}

} // namespace
} // namespace tyndall::test

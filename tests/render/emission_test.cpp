// SPDX-License-Identifier: Apache-2.0
// Emission (docs/theory.md A13): slabs, the isothermal cavity, heat without density, a steep temperature ramp. The
// layers beside the picture.
#include "light/blackbody.h"
#include "render/film_fixture.h"
#include "support/render_fixture.h"
#include "support/render_scenes.h"
#include "verify/oracle_radiance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tyndall::test {
namespace {

/// An orthographic view along -z whose pixels all look through the middle of [-1, 1]^3.
TestScene view() {
  TestScene test({8, 8});
  test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 0.5);
  return test;
}

scene::Emission linear(double j, bool tied = false) {
  scene::Emission emission;
  emission.scale = j;
  emission.colour = {1.0, 0.5, 0.25};
  emission.tiedToAbsorption = tied;
  return emission;
}

scene::Emission blackbody(double scale) {
  scene::Emission emission;
  emission.kind = scene::Emission::Kind::Blackbody;
  emission.scale = scale;
  return emission;
}

TEST(EmissiveSlab, HomogeneousHasTheClosedForm) {
  for (const double sigmaT : {0.0, 1e-6, 0.5, 20.0}) {
    TestScene test = view();
    test.box(glm::dvec3(-1.0), glm::dvec3(1.0), sigmaT, 0.0).emission = linear(3.0);
    const double length = sigmaT > 0.0 ? -std::expm1(-2.0 * sigmaT) / sigmaT : 2.0;
    for (const MomentOptions& options : eachMethod({.replicates = 8})) {
      const Moments moments = renderMoments(test.scene, test.volumes, options);
      EXPECT_AGREES(imageTest(moments, 3.0 * length, 0)) << sigmaT << nameOf(options);
      EXPECT_AGREES(imageTest(moments, 1.5 * length, 1)) << sigmaT << nameOf(options);
      EXPECT_AGREES(imageTest(moments, 0.75 * length, 2)) << sigmaT << nameOf(options);
      EXPECT_DIFFERS(imageTest(moments, 3.01 * length, 0)) << sigmaT << nameOf(options); // planted: 0.3 % off
    }
  }
}

/// Cut in two, a slab shines through the other half.
TEST(EmissiveSlab, TwoHomogeneousHalvesAddUp) {
  TestScene test = view();
  test.box(glm::dvec3(-1.0), {1.0, 1.0, 0.2}, 0.7, 0.0).emission = linear(3.0);
  test.box({-1.0, -1.0, 0.2}, glm::dvec3(1.0), 0.7, 0.0).emission = linear(3.0);
  for (const MomentOptions& options : eachMethod()) {
    EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), 3.0 * -std::expm1(-1.4) / 0.7))
        << nameOf(options);
  }
}

/// Emission and density of their own grids against quadrature, scattering in between.
TEST(EmissiveGrid, AgreesWithQuadrature) {
  for (const bool tied : {false, true}) {
    TestScene test = view();
    test.scene.film.size = {4, 4};
    test.grid(constantGrid(12, glm::dvec3(-0.9), glm::dvec3(0.9), 1.0), 0.8, 0.3);
    const auto glow = [](const glm::ivec3& index) { return 0.2 + 0.1 * index.z + 0.05 * index.x; };
    const volume::BrickGrid shape = constantGrid(9, glm::dvec3(-1.3), glm::dvec3(1.2), 1.0);
    test.emissionGrid(gridOf(glm::ivec3(9), glm::ivec3(0), shape.worldFromIndex, glow), linear(2.0, tied));
    test.sun({0.1, -1.0, -0.5}, 1.0);
    const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-6});
    const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 3);
    for (const MomentOptions& options : eachTracker({.replicates = 128, .samples = 32})) {
      const Moments moments = renderMoments(test.scene, test.volumes, options);
      EXPECT_AGREES(imageTest(moments, meanOf(reference), 0, 1e-4)) << "tied " << tied << nameOf(options);
      EXPECT_AGREES(pixelTest(moments, reference, 0, 1e-4)) << "tied " << tied << nameOf(options);
      const MomentOptions bad = withBug(options, interop::kBugHalfVoxel); // shifts the density against the emission
      EXPECT_DIFFERS(imageTest(renderMoments(test.scene, test.volumes, bad), meanOf(reference), 0, 1e-4));
    }
  }
}

/// Kirchhoff: emission tied to absorption, opaque and of one temperature, is the blackbody's radiance everywhere.
TEST(IsothermalCavity, HasTheRadianceOfABlackbody) {
  constexpr double kKelvin = 2400.0;
  const glm::dvec3 expected = light::blackbodyRadiance(kKelvin);
  TestScene homogeneous = view();
  scene::Emission emission = blackbody(1.0);
  emission.temperature = kKelvin;
  emission.tiedToAbsorption = true;
  homogeneous.box(glm::dvec3(-1.0), glm::dvec3(1.0), 40.0, 0.4).emission = emission;
  // A grid of heat that is larger than the grid of density, so that all of what absorbs has the temperature.
  TestScene grids = view();
  grids.grid(constantGrid(12, glm::dvec3(-0.9), glm::dvec3(0.9), 1.0), 8.0, 0.0);
  grids.emissionGrid(constantGrid(5, glm::dvec3(-2.0), glm::dvec3(2.0), kKelvin), emission);
  for (const MomentOptions& options : eachMethod({.replicates = 128})) {
    const Moments one = renderMoments(homogeneous.scene, homogeneous.volumes, options);
    const Moments two = renderMoments(grids.scene, grids.volumes, options);
    for (int channel = 0; channel < 3; ++channel) {
      // The homogeneous box scatters 40 % away: what it emits is (1 - albedo) B. 1e-3: the blackbody table's stated
      // error.
      EXPECT_AGREES(imageTest(one, 0.6 * expected[channel], channel, 1e-3)) << channel << nameOf(options);
      EXPECT_AGREES(imageTest(two, expected[channel], channel, 1e-3)) << channel << nameOf(options);
      EXPECT_DIFFERS(imageTest(two, 1.05 * expected[channel], channel, 1e-3))
          << channel << nameOf(options); // planted: 5 % off
    }
  }
}

TEST(Heat, GlowsWhereThereIsNoDensity) {
  TestScene test = view();
  const volume::BrickGrid density = constantGrid(6, {-0.5, -0.5, -3.0}, {0.5, 0.5, -2.0}, 1.0);
  test.grid(density, 0.5, 0.0);
  test.emissionGrid(constantGrid(6, glm::dvec3(-0.5), glm::dvec3(0.5), 1.0), linear(1.0));
  TestScene alone = view(); // "none": no density at all
  alone.grid(density);
  alone.volumes.uses[0].density.reset();
  alone.emissionGrid(constantGrid(6, glm::dvec3(-0.5), glm::dvec3(0.5), 1.0), linear(1.0));
  for (const MomentOptions& options : eachMethod()) {
    // Trapezoid: 1 unit inside and half a voxel (0.1) on either side; the density lies behind it.
    const Moments moments = renderMoments(test.scene, test.volumes, options);
    EXPECT_AGREES(imageTest(moments, 1.2)) << nameOf(options);
    EXPECT_AGREES(imageTest(renderMoments(alone.scene, alone.volumes, options), 1.2)) << nameOf(options);
    EXPECT_DIFFERS(imageTest(moments, 1.19)) << nameOf(options); // planted
  }
}

/// Planck's law is not linear: the temperature must be interpolated before it.
TEST(TemperatureRamp, IsInterpolatedBeforePlanck) {
  TestScene test = view();
  const volume::BrickGrid shape = constantGrid(5, glm::dvec3(-1.0), glm::dvec3(1.0), 1.0);
  test.grid(shape, 0.1, 0.0);
  const auto kelvin = [](const glm::ivec3& index) { return 700.0 + 500.0 * index.z; };
  scene::Emission emission = blackbody(1.0);
  test.emissionGrid(gridOf(glm::ivec3(5), glm::ivec3(0), shape.worldFromIndex, kelvin), emission);
  const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-6});
  const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 2);
  for (const MomentOptions& options : eachMethod({.replicates = 64})) {
    EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), meanOf(reference), 0, 1e-3))
        << nameOf(options);
  }
  const MomentOptions bad = withBug({.replicates = 64}, interop::kBugOneTapBlackbody); // the march has no such lookups
  EXPECT_DIFFERS(imageTest(renderMoments(test.scene, test.volumes, bad), meanOf(reference), 0, 1e-3));
}

/// Depth, opacity and albedo of a slab that is as deep everywhere; media of two albedos one behind the other.
TEST(Layers, OfTwoSlabsHaveTheClosedForm) {
  TestScene test({4, 4});
  test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 0.5);
  test.box({-1.0, -1.0, 0.0}, {1.0, 1.0, 1.0}, 0.7, 0.9);
  test.box({-1.0, -1.0, -1.0}, {1.0, 1.0, 0.0}, 1.1, 0.2);
  const double front = -std::expm1(-0.7);
  const double back = std::exp(-0.7) * -std::expm1(-1.1);
  // Mean of s over sigma exp(-sigma s) ds: (1 - exp(-x)(1 + x)) / sigma for a slab of optical depth x.
  const auto reach = [](double sigma) { return (1.0 - std::exp(-sigma) * (1.0 + sigma)) / sigma; };
  const double depth = 4.0 * front + reach(0.7) + 5.0 * back + std::exp(-0.7) * reach(1.1);
  for (const render::Method method : {render::Method::Tracking, render::Method::March}) {
    SCOPED_TRACE(render::methodName(method));
    FilmRunner runner(test, {.method = method, .aovs = true});
    std::vector<double> values[3];
    for (std::uint32_t seed = 0; seed < 32 * effort(); ++seed) {
      std::string stoppedBy;
      const film::Film film = runner.run({.samples = 64, .seconds = {}, .error = {}}, seed, stoppedBy);
      const int layers[] = {film::Opacity, film::Depth, film::AlbedoR};
      for (int i = 0; i < 3; ++i) {
        values[i].push_back(0.0);
        for (std::size_t pixel = 0; pixel < 16; ++pixel) {
          values[i].back() += film.extraMean(pixel, layers[i]) / 16.0;
        }
      }
    }
    const double expected[] = {front + back, depth, 0.9 * front + 0.2 * back};
    for (int i = 0; i < 3; ++i) {
      const film::SampleSummary summary = film::summarise(values[i]);
      const double error = std::sqrt(summary.variance / summary.count);
      EXPECT_NEAR(summary.mean, expected[i], 5.0 * error + 2e-6 * expected[i]) << i;
      EXPECT_GT(std::abs(summary.mean - 1.01 * expected[i]), 5.0 * error) << i; // planted: 1 % off
    }
  }
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// Numbers that must survive (docs/numbers-that-survive.md lists which line is which test):
// no sample is lost, everything is finite, and right where there is a closed form.
#include "render/film_fixture.h"
#include "support/render_fixture.h"
#include "verify/oracle_radiance.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>

namespace tyndall::test {
namespace {

using std::numbers::pi;

/// Transmittance below which the march counts a ray as opaque.
constexpr double kNoTransmittance = 1e-12;

/// Every mean finite; renderMoments itself fails on samples that were not and on exceeded majorants.
void expectFinite(const Moments& moments, const std::string& name) {
  for (const auto& pixel : moments.pixels) {
    for (const film::SampleSummary& channel : pixel) {
      ASSERT_TRUE(std::isfinite(channel.mean) && std::isfinite(channel.variance)) << name;
    }
  }
}

/// Validation A2's cube of a given size, as a box or as voxels, seen through its inside.
TestScene cube(double size, double sigmaT, bool grid, double albedo = 0.8) {
  TestScene test({8, 8});
  test.orthographic({0.0, 0.0, 5.0 * size}, {0.0, 0.0, 0.0}, 0.5 * size);
  test.sun({0.0, -1.0, 0.0}, 3.0);
  if (grid) {
    test.grid(constantGrid(9, glm::dvec3(-size), glm::dvec3(size), 1.0), sigmaT, albedo);
  } else {
    test.box(glm::dvec3(-size), glm::dvec3(size), sigmaT, albedo);
  }
  return test;
}

/// Transmittance, and light where the method sees any, of one cube.
void expectExtinctionAndLight(double size, double sigmaT, bool grid) {
  const TestScene test = cube(size, sigmaT, grid);
  const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-5});
  const double depth = oracle.opticalDepth(oracle.cameraRay({0.5, 0.5}), 1e30);
  const double light =
      depth < 20.0 ? meanOf(oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 3)) : 0.0;
  for (const MomentOptions& options : eachMethod({.replicates = 16})) {
    if (!marches(options) && grid && size * sigmaT > 1e6) {
      continue; // beyond an optical depth of 1e6: where density grows from 0, null collisions go as its root
    }
    const std::string name = fmt::format("{}, size {} extinction {} grid {}", nameOf(options), size, sigmaT, grid);
    const Moments moments = renderMoments(test.scene, test.volumes, options);
    expectFinite(moments, name);
    if (depth < (grid && !marches(options) ? 5.0 : 25.0)) {
      EXPECT_AGREES(imageTest(moments, std::exp(-depth), kTransmittance, 1e-6 * (2.0 + depth))) << name;
    } else { // by Markov's inequality, true of an unbiased estimate but for one case in 10,000
      EXPECT_LE(moments.image(kTransmittance).mean, 1e4 * std::exp(-depth) + kNoTransmittance) << name;
    }
    // In thinner grids tracking sees nothing in so few samples: there are no collisions.
    if (depth < 20.0 && (marches(options) || !grid || depth > 1e-2)) {
      EXPECT_AGREES(imageTest(moments, light, 0, 1e-3)) << name;
    }
  }
}

/// The fast version takes every other pair, the extremes among them.
TEST(Survives, ExtinctionAndSizeOverTheirRanges) {
  constexpr double kSizes[] = {1e-4, 1.0, 1e6};
  constexpr double kExtinctions[] = {1e-8, 1e-4, 1.0, 1e4, 1e8};
  for (std::size_t i = 0; i < std::size(kSizes); ++i) {
    for (std::size_t j = 0; j < std::size(kExtinctions); ++j) {
      if (effort() == 1 && (i + j) % 2 != 0) {
        continue;
      }
      for (const bool grid : {false, true}) {
        expectExtinctionAndLight(kSizes[i], kExtinctions[j], grid);
      }
    }
  }
}

TEST(Survives, ScenesFarFromTheOrigin) {
  const glm::dvec3 far(1e5, 1e5, -1e5);
  for (const bool grid : {false, true}) {
    TestScene near = cube(1.0, 1.0, grid);
    TestScene moved = near;
    moved.scene.camera.position += far;
    moved.scene.camera.target += far;
    moved.scene.media[0].worldFromMedium = glm::translate(glm::dmat4(1.0), far);
    for (MomentOptions options : eachMethod()) {
      const Moments expected = renderMoments(near.scene, near.volumes, options);
      options.firstSeed = 1000;
      EXPECT_AGREES(tileTest(expected, renderMoments(moved.scene, moved.volumes, options))) << grid << nameOf(options);
    }
  }
}

TEST(Survives, OpticalDepthZeroAndAMillion) {
  for (const MomentOptions& options : eachTracker({.replicates = 8})) {
    for (const bool grid : {false, true}) {
      const TestScene none = cube(1.0, 0.0, grid);
      const Moments empty = renderMoments(none.scene, none.volumes, options);
      EXPECT_AGREES(imageTest(empty, 1.0, kTransmittance, 1e-7)) << grid << nameOf(options);
      EXPECT_EQ(empty.image(0).mean, 0.0) << grid << nameOf(options);
      const TestScene dense = cube(1.0, 5e5, grid);
      const Moments opaque = renderMoments(dense.scene, dense.volumes, options);
      expectFinite(opaque, "opaque");
      EXPECT_LE(opaque.image(kTransmittance).mean, kNoTransmittance) << grid << nameOf(options);
    }
  }
}

/// An opaque half-space under light from the camera's side: Chandrasekhar's first order, albedo / (4 pi) / (1 +
/// mu/mu0).
TEST(Survives, OpaqueMediaReflectTheFirstOrder) {
  for (const double sigmaT : {50.0, 5e4, 5e5}) {
    for (const bool grid : {false, true}) {
      TestScene test({8, 8});
      test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 0.2);
      test.sun({0.0, 0.0, -1.0}, 1.0); // mu = mu0 = 1
      if (grid) { // as voxels, whose density grows over the first one: the albedo's first order does not mind
        test.grid(constantGrid(9, glm::dvec3(-1.0), glm::dvec3(1.0), 1.0), sigmaT, 0.8);
      } else {
        test.box(glm::dvec3(-1.0), glm::dvec3(1.0), sigmaT, 0.8);
      }
      // Floats at the entry are a quarter of the mean free path apart at 5e5: rounding r of the depth adds r^2 / 6.
      const double tolerance = sigmaT > 1e5 ? 1e-2 : 1e-3;
      for (const MomentOptions& options : eachMethod({.replicates = 64})) {
        EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), 0.8 / (4.0 * pi) / 2.0, 0, tolerance))
            << sigmaT << grid << nameOf(options);
      }
    }
  }
}

TEST(Survives, PeakedPhaseFunctions) {
  for (const double g : {0.9999, -0.9999}) {
    TestScene test({8, 8});
    test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 1.0);
    test.sphere(glm::dvec3(0.0), 1.0, 1.0, 0.9).phase = henyeyGreenstein(g);
    test.constant(1.0);
    // Light comes from where it goes (or from behind): straight through, or back out by the way in.
    const OracleScene oracle(test.scene, test.volumes);
    const auto reference = oracle.picture(
        [&](const OracleRay& ray) {
          const double depth = oracle.opticalDepth(ray, 1e30);
          const double scattered = g > 0.0 ? depth * std::exp(-depth) : -0.5 * std::expm1(-2.0 * depth);
          return 0.9 * scattered + std::exp(-depth);
        },
        4);
    TestScene sun = test;
    sun.scene.lights.clear();
    sun.sun({0.002, 0.0, -1.0}, 1.0, 0.53);
    sun.point({0.0, 0.0, -3.0});
    for (const MomentOptions& options : eachMethod()) {
      const Moments moments = renderMoments(test.scene, test.volumes, options);
      expectFinite(moments, "constant");
      EXPECT_AGREES(imageTest(moments, meanOf(reference), 0, 2e-3))
          << g << nameOf(options); // 2e-3: 1 - |g| = 1e-4 has a tail of its root
      expectFinite(renderMoments(sun.scene, sun.volumes, options), "sun");
    }
  }
}

/// A cube under a sun, a lamp and an environment of one strength.
TestScene litCube(double strength) {
  TestScene test = cube(1.0, 1.0, false);
  std::get<scene::SunLight>(test.scene.lights[0].light).irradiance = glm::dvec3(strength);
  test.point({0.0, 3.0, 0.0}, strength);
  test.constant(strength);
  return test;
}

TEST(Survives, LightsOfEveryStrength) {
  const TestScene unit = litCube(1.0);
  const OracleScene ofUnit(unit.scene, unit.volumes, {.relative = 1e-5});
  const double mean = meanOf(ofUnit.picture([&](const OracleRay& ray) { return ofUnit.total(ray); }, 2));
  for (const double strength : {1e-12, 1e12}) {
    const TestScene test = litCube(strength);
    for (const MomentOptions& options : eachMethod()) { // 3e-3: edges of the box in the sphere rule
      EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), strength * mean, 0, 3e-3))
          << strength << nameOf(options);
    }
  }
  // A faint light beside one that is 1e24 times brighter: finite, and the bright one right.
  TestScene both = cube(1.0, 1.0, false);
  both.point({0.0, 3.0, 0.0}, 1e12);
  both.point({0.0, -3.0, 0.0}, 1e-12);
  both.scene.lights.erase(both.scene.lights.begin());
  const OracleScene oracle(both.scene, both.volumes, {.relative = 1e-6});
  const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 3);
  for (const MomentOptions& options : eachMethod()) {
    EXPECT_AGREES(imageTest(renderMoments(both.scene, both.volumes, options), meanOf(reference), 0, 1e-4))
        << nameOf(options);
  }
}

/// A light in the middle of the picture and of the medium: radiance goes as 1 / h beside it, so pixels around it are
/// compared, those that hold it must be finite.
TEST(Survives, LightOnTheCameraRayAndInsideTheMedium) {
  TestScene test({9, 9});
  test.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 20.0);
  test.sphere(glm::dvec3(0.0), 1.0, 0.7, 0.9);
  test.point({0.0, 0.0, 0.0});
  const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-7});
  auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 10);
  for (int y = 3; y <= 5; ++y) {
    for (int x = 3; x <= 5; ++x) {
      reference[static_cast<std::size_t>(9 * y + x)] = std::nan("");
    }
  }
  TestScene grid = test;
  grid.scene.media.clear();
  grid.volumes = {};
  grid.grid(constantGrid(9, glm::dvec3(-1.0), glm::dvec3(1.0), 1.0), 0.7);
  grid.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 1e-7); // all rays meet the light
  for (const MomentOptions& options : eachMethod({.replicates = 64})) {
    const Moments moments = renderMoments(test.scene, test.volumes, options);
    expectFinite(moments, "on the ray");
    EXPECT_AGREES(pixelTest(moments, reference, 0, 1e-3)) << nameOf(options);
    expectFinite(renderMoments(grid.scene, grid.volumes, options), "grid");
  }
}

TEST(Survives, CameraInsideDenseFog) {
  for (const bool grid : {false, true}) {
    TestScene test({8, 8});
    test.perspective({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 20.0);
    if (grid) {
      test.grid(constantGrid(9, glm::dvec3(-1.0), glm::dvec3(1.0), 1.0), 200.0, 0.9);
    } else {
      test.box(glm::dvec3(-1.0), glm::dvec3(1.0), 200.0, 0.9);
    }
    test.point({0.01, 0.004, -0.02}, 1e-3);
    const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-6});
    const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 5);
    for (const MomentOptions& options : eachMethod({.replicates = 128})) {
      const Moments moments = renderMoments(test.scene, test.volumes, options);
      expectFinite(moments, "inside fog");
      EXPECT_AGREES(imageTest(moments, meanOf(reference), 0, 1e-3)) << grid << nameOf(options);
    }
  }
}

TEST(Survives, AlbedoZeroAndOne) {
  for (const bool grid : {false, true}) {
    const TestScene black = cube(1.0, 1.0, grid, 0.0);
    const TestScene white = cube(1.0, 1.0, grid, 1.0);
    const OracleScene oracle(white.scene, white.volumes, {.relative = 1e-5});
    const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 3);
    for (const MomentOptions& options : eachMethod()) {
      EXPECT_EQ(renderMoments(black.scene, black.volumes, options).image(0).mean, 0.0) << grid << nameOf(options);
      EXPECT_AGREES(imageTest(renderMoments(white.scene, white.volumes, options), meanOf(reference), 0, 1e-4))
          << grid << nameOf(options);
    }
  }
}

TEST(Survives, GridsOneVoxelThick) {
  for (int axis = 0; axis < 4; ++axis) { // 3: a single voxel
    glm::ivec3 size(axis == 3 ? 1 : 9);
    size[axis % 3] = 1;
    TestScene test({8, 8});
    test.grid(gridOf(size, glm::ivec3(-4), glm::dmat4(1.0), [](const glm::ivec3&) { return 1.0; }), 0.4, 0.9);
    test.perspective({5.0, 9.0, 14.0}, glm::dvec3(test.volumes.grids[0].worldBounds().centre()), 25.0);
    test.sun({0.2, -1.0, -0.5}, 1.0);
    const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-5});
    const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 6);
    for (const MomentOptions& options : eachMethod({.replicates = 64})) {
      EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), meanOf(reference), 0, 2e-3))
          << axis << nameOf(options);
    }
  }
}

TEST(Survives, ManySamplesOfOnePixelWithoutDrift) {
  const std::uint32_t samples = effort() > 1 ? 1u << 20 : 1u << 16;
  TestScene test({1, 1});
  test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 1e-6);
  test.sun({0.0, -1.0, 0.0}, 3.0);
  test.box(glm::dvec3(-1.0), glm::dvec3(1.0), 1.0, 0.8);
  for (const render::Method method : {render::Method::Tracking, render::Method::March}) {
    render::RenderOptions options;
    options.stop.samples = samples;
    options.estimator.method = method;
    const film::Film film = renderFilm(test, options);
    ASSERT_EQ(film.samples(0), samples);
    // Tracking's samples are all the same number, the march's nearly: whatever the sum loses shows.
    const double expected = 0.8 / (4.0 * pi) * 3.0 * std::exp(-1.0) * -std::expm1(-2.0);
    EXPECT_NEAR(film.mean(0, film::R) / expected, 1.0,
                2e-6 + 5.0 * std::sqrt(film.varianceOfMean(0, film::R)) / expected)
        << render::methodName(method);
    EXPECT_NEAR(film.mean(0, film::T) / std::exp(-2.0), 1.0, 2e-6) << render::methodName(method);
  }
}

} // namespace
} // namespace tyndall::test

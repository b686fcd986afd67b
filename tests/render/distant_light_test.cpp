// SPDX-License-Identifier: Apache-2.0
// Lights at infinity (docs/theory.md A14): environments, suns with a diameter, maps; all by MIS.
#include "film/exr.h"
#include "support/render_fixture.h"
#include "support/render_scenes.h"
#include "verify/oracle_radiance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace tyndall::test {
namespace {

using std::numbers::pi;

/// A sphere of radius 1 that fills the picture.
TestScene sphereView(double g) {
  TestScene test({4, 4});
  test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 1.2);
  test.sphere(glm::dvec3(0.0), 1.0, 1.1, 0.7).phase = henyeyGreenstein(g);
  return test;
}

/// Samples of most of these tests.
constexpr std::uint32_t kReplicates = 128;
std::vector<MomentOptions> eachMethodHere(std::uint32_t replicates = kReplicates) {
  return eachMethod({.replicates = replicates, .samples = 32});
}

Moments render(const TestScene& test, const MomentOptions& options) {
  return renderMoments(test.scene, test.volumes, options);
}

TEST(ConstantEnvironment, SphereAgreesWithQuadrature) {
  for (const double g : {0.0, 0.6}) {
    TestScene test = sphereView(g);
    test.constant(2.0);
    const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-5, .polarNodes = 20, .azimuths = 12});
    const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.total(ray); }, 4);
    for (const MomentOptions& options : eachMethodHere()) {
      const Moments moments = render(test, options);
      EXPECT_AGREES(imageTest(moments, meanOf(reference), 0, 1e-4)) << nameOf(options) << "\ng " << g;
      EXPECT_AGREES(pixelTest(moments, reference, 0, 1e-4)) << nameOf(options) << "\ng " << g;
      if (!marches(options)) { // whose other techniques count for little beside its set of directions
        const MomentOptions bad = withBug(options, interop::kBugBranchPdf);
        EXPECT_DIFFERS(imageTest(render(test, bad), meanOf(reference), 0, 1e-4)) << nameOf(options) << "\ng " << g;
      }
    }
  }
}

TEST(ConstantEnvironment, HiddenFromTheCameraStillLights) {
  TestScene test = sphereView(0.0);
  test.constant(2.0, false);
  const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-5, .polarNodes = 20, .azimuths = 12});
  const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 3);
  for (const MomentOptions& options : eachMethodHere()) {
    EXPECT_AGREES(imageTest(render(test, options), meanOf(reference), 0, 1e-4)) << nameOf(options);
  }
}

TEST(ConstantEnvironment, GridAgreesWithQuadrature) {
  TestScene test({4, 4});
  test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 1.0);
  test.grid(constantGrid(6, glm::dvec3(-0.7), glm::dvec3(0.7), 1.0), 1.0, 0.7).phase = henyeyGreenstein(0.4);
  test.constant(1.0);
  // Kinks of the box leave 1e-3 to this rule of directions.
  const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-4, .polarNodes = 32, .azimuths = 32});
  const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.total(ray); }, 1);
  for (const MomentOptions& options : eachTracker({.replicates = 64})) {
    EXPECT_AGREES(imageTest(render(test, options), meanOf(reference), 0, 2e-3)) << nameOf(options);
  }
}

TEST(Sun, DiscsAgreeWithQuadrature) {
  for (const double diameter : {0.5, 10.0}) {
    for (const double g : {0.0, 0.95}) {
      TestScene test = sphereView(g);
      test.sun({0.1, -0.2, 1.0}, 3.0, diameter); // 13 degrees from straight on: the phase function's peak matters
      const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-7});
      const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 4);
      for (const MomentOptions& options : eachMethodHere()) {
        const Moments moments = render(test, options);
        EXPECT_AGREES(imageTest(moments, meanOf(reference), 0, 5e-4)) << nameOf(options) << diameter << " g " << g;
        // Elsewhere phase samples count for nothing, with or without the bug; the march draws none towards suns.
        if (diameter > 5.0 && g > 0.5 && !marches(options)) {
          const MomentOptions bad = withBug(options, interop::kBugBranchPdf);
          EXPECT_DIFFERS(imageTest(render(test, bad), meanOf(reference), 0, 5e-4))
              << nameOf(options) << diameter << " g " << g;
        }
        EXPECT_DIFFERS(imageTest(moments, 1.02 * meanOf(reference), 0, 5e-4))
            << nameOf(options) << diameter << " g " << g; // planted: 2 %
      }
    }
  }
}

/// Writes a lat-long map, reads it into the scene with twice its radiance, renders.
Moments renderMap(TestScene test, const glm::uvec2& size, const std::vector<float>& texels,
                  const MomentOptions& options) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("tyndall-map-{}.exr", ::getpid());
  film::Image image;
  image.displaySize = size;
  image.window = {glm::uvec2(0), size};
  for (const char* channel : {"R", "G", "B"}) {
    image.channels[channel] = texels;
  }
  film::writeExr(file, image);
  scene::MapEnvironment map;
  map.file = file.string();
  map.scale = 2.0;
  test.scene.lights.push_back({"map", map, false});
  const Moments moments = render(test, options);
  std::filesystem::remove(file);
  return moments;
}

/// One bright texel is a small sun: bilinear lookups make it a tent of two texels' width whose integral is the texel's
/// solid angle.
TEST(MapEnvironment, OneBrightTexelIsADirectionalLight) {
  constexpr glm::uvec2 kSize{512, 256};
  constexpr glm::uvec2 kTexel{300, 90};
  std::vector<float> texels(std::size_t(kSize.x) * kSize.y, 0.0f);
  texels[kTexel.y * kSize.x + kTexel.x] = 1e4f;
  const double polar = pi * (kTexel.y + 0.5) / kSize.y;
  const double azimuth = 2.0 * pi * ((kTexel.x + 0.5) / kSize.x - 0.5); // from -z towards +x
  const glm::dvec3 toLight(std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth));
  const double solidAngle = 2.0 * pi / kSize.x * pi / kSize.y * std::sin(polar);
  TestScene sun = sphereView(0.5);
  sun.sun(-toLight, 2.0 * 1e4 * solidAngle);
  const OracleScene oracle(sun.scene, sun.volumes);
  const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 4);
  std::vector<float> upsideDown(texels.size(), 0.0f);
  upsideDown[(kSize.y - 1 - kTexel.y) * kSize.x + kTexel.x] = 1e4f;
  for (const MomentOptions& options : eachMethodHere()) {
    const Moments moments = renderMap(sphereView(0.5), kSize, texels, options);
    EXPECT_AGREES(imageTest(moments, meanOf(reference), 0, 1e-3))
        << nameOf(options); // 1e-3: the tent is 1.4 degrees wide
    EXPECT_AGREES(pixelTest(moments, reference, 0, 3e-3)) << nameOf(options);
    EXPECT_DIFFERS(pixelTest(renderMap(sphereView(0.5), kSize, upsideDown, options), reference, 0, 3e-3))
        << nameOf(options); // planted
  }
}

TEST(MapEnvironment, OfOneColourIsTheConstantOne) {
  TestScene constant = sphereView(0.6);
  constant.constant(2.0, false);
  const std::vector<float> texels(32 * 16, 1.0f);
  for (MomentOptions options : eachMethodHere()) {
    const Moments expected = render(constant, options);
    options.firstSeed = 100001; // the march draws the same numbers for both
    EXPECT_AGREES(tileTest(expected, renderMap(sphereView(0.6), {32, 16}, texels, options))) << nameOf(options);
    if (!marches(options)) {
      const MomentOptions bad = withBug(options, interop::kBugBranchPdf);
      EXPECT_DIFFERS(tileTest(expected, renderMap(sphereView(0.6), {32, 16}, texels, bad))) << nameOf(options);
    }
  }
}

/// Colours and many lights of every kind together, light selection included.
TEST(ManyLights, OfEveryKindAgreeWithQuadrature) {
  TestScene test({3, 3});
  test.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 20.0);
  test.sphere({0.2, 0.1, 0.0}, 1.4, 0.6, 1.0).phase = henyeyGreenstein(0.3);
  test.scene.media[0].albedo = {0.9, 0.5, 0.1};
  test.point({2.0, 0.0, 1.0}, 3.0);
  test.point({0.1, -0.3, 0.2}, 0.02);
  test.sun({0.0, -1.0, 0.2}, 0.5);
  test.sun({1.0, -0.3, 0.4}, 0.7, 6.0);
  test.constant(0.1);
  std::get<scene::PointLight>(test.scene.lights[0].light).intensity = {3.0, 1.0, 0.0};
  const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-5, .polarNodes = 16, .azimuths = 12});
  std::array<double, 3> expected{};
  for (int channel = 0; channel < 3; ++channel) {
    expected[std::size_t(channel)] =
        meanOf(oracle.picture([&](const OracleRay& ray) { return oracle.total(ray, channel); }, 3));
  }
  for (const MomentOptions& options : eachMethodHere(2 * kReplicates)) {
    const Moments moments = render(test, options);
    for (int channel = 0; channel < 3; ++channel) {
      const double mean = expected[std::size_t(channel)];
      EXPECT_AGREES(imageTest(moments, mean, channel, 3e-4)) << channel << nameOf(options);
      EXPECT_DIFFERS(imageTest(moments, 1.03 * mean, channel, 3e-4)) << channel << nameOf(options); // planted: 3 % off
    }
  }
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// Where everything is white, nothing can be seen (docs/theory.md A5); and light that comes back from a half-space (A6).
#include "support/path_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

/// Media of every kind and phase function, one inside the other, that absorb nothing.
void addWhiteMedia(PathScene& test) {
  test.sphere({0.2, 0.1, 0.0}, 0.9, 0.8).phase = henyeyGreenstein(0.8);
  test.sphere({-0.3, 0.0, 0.2}, 0.6, 2.0).phase = {PhaseId::Rayleigh, {}};
  test.box({-0.9, -0.9, -0.4}, {0.1, 0.3, 0.9}, 0.7).phase = {PhaseId::Draine, {0.5, 20.0, 0.0, 0.0}};
  test.box({-0.2, -0.8, -0.9}, {0.9, 0.8, 0.2}, 0.5).phase = {PhaseId::TwoLobe, {0.8, -0.3, 0.6, 0.0}};
  test.sphere({0.3, 0.4, 0.3}, 0.5, 0.6).phase = {PhaseId::Mie, {12.0, 0.0, 0.0, 0.0}};
  test.grid(puffGrid(), 2.0).phase = henyeyGreenstein(-0.3);
}

/// One standard error of the image is 0.05 %.
TEST(WhiteFurnace, OfMedia) {
  PathScene test;
  test.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 30.0);
  addWhiteMedia(test);
  test.constant(1.0);
  const Moments moments = renderMoments(test.scene, test.volumes, byPaths({.replicates = 24, .samples = 32}));
  const std::vector<double> white(moments.pixels.size(), 1.0);
  EXPECT_AGREES(pixelTest(moments, white));
  EXPECT_AGREES(imageTest(moments, 1.0));
  EXPECT_DIFFERS(imageTest(moments, 1.005)); // planted: half a percent too dark
}

/// A closed room whose walls shine with 1 and reflect one half has 2 everywhere, whatever scatters in it.
TEST(WhiteFurnace, OfAClosedRoomWithMedia) {
  PathScene test({8, 8});
  test.perspective({0.0, 0.0, 1.4}, {0.2, 0.1, 0.0}, 80.0);
  geometry::Material& wall = test.lamp("wall", 1.0);
  wall.colour = glm::dvec3(0.5);
  wall.twoSided = true; // faces of boxes look outwards
  test.crate("wall", glm::dvec3(-1.5), glm::dvec3(1.5));
  addWhiteMedia(test);
  const MomentOptions options = byPaths({.replicates = 24, .samples = 32});
  const Moments moments = renderMoments(test.scene, test.volumes, options);
  EXPECT_AGREES(pixelTest(moments, std::vector<double>(moments.pixels.size(), 2.0)));
  EXPECT_AGREES(imageTest(moments, 2.0));
  EXPECT_DIFFERS(imageTest(renderMoments(test.scene, test.volumes, withBug(options, interop::kBugRoulette)), 2.0));
}

/// Clear glass, glass full of white milk, and a mirror: nothing is lost, not even in float.
TEST(WhiteFurnace, OfGlassAndMirrors) {
  PathScene test({24, 12});
  test.perspective({0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, 25.0);
  test.material("glass", MaterialId::Dielectric, 1.0).ior = 1.5;
  test.material("mirror", MaterialId::Conductor, 1.0);
  test.ball("glass", {-1.6, 0.0, 0.0}, 0.8);
  test.ball("mirror", {0.0, 0.0, 0.0}, 0.7);
  test.ball("glass", {1.6, 0.0, 0.0}, 0.8);
  test.fill(3.0).phase = henyeyGreenstein(0.4);
  test.constant(1.0);
  const Moments moments = renderMoments(test.scene, test.volumes, byPaths({.replicates = 16, .samples = 64}));
  EXPECT_AGREES(pixelTest(moments, std::vector<double>(moments.pixels.size(), 1.0), 0, 1e-5));
  EXPECT_AGREES(imageTest(moments, 1.0, 0, 1e-5));
}

/// Inside glass radiance is higher by the square of the index. From the middle of a ball every ray leaves straight.
TEST(WhiteFurnace, SeenFromInsideGlass) {
  PathScene test({8, 8});
  test.perspective({1.0, 2.0, 3.0}, {1.0, 2.0, 0.0}, 60.0);
  test.material("glass", MaterialId::Dielectric, 1.0).ior = 1.5;
  test.ball("glass", {1.0, 2.0, 3.0}, 0.5);
  test.constant(1.0);
  const Moments moments = renderMoments(test.scene, test.volumes, byPaths({.replicates = 8}));
  EXPECT_AGREES(pixelTest(moments, std::vector<double>(moments.pixels.size(), 2.25), 0, 1e-5));
  EXPECT_DIFFERS(imageTest(moments, 2.25 * 1.001, 0, 1e-5)); // planted
}

/// A plate seen head-on keeps what single scattering does: docs/theory.md, "Energy".
double keptByMetal(double roughness, double cosine) {
  PathScene test({8, 8});
  test.perspective({0.0, 3.0 * cosine, 3.0 * std::sqrt(1.0 - cosine * cosine)}, {0.0, 0.0, 0.0}, 1e-4);
  test.scene.camera.up = {1.0, 0.0, 0.0};
  test.material("metal", MaterialId::Conductor, 1.0).roughness = roughness;
  test.quad("metal", {-9.0, 0.0, 9.0}, {18.0, 0.0, 0.0}, {0.0, 0.0, -18.0});
  test.constant(1.0);
  return renderMoments(test.scene, test.volumes, byPaths({.replicates = 16, .samples = 256})).image().mean;
}

/// One standard error is 0.0003.
TEST(WhiteFurnace, OfRoughMetalLosesWhatTheTableSays) {
  EXPECT_NEAR(keptByMetal(1.0, 1.0), 1.0 - std::numbers::ln2, 0.002);
  EXPECT_NEAR(keptByMetal(0.7, 0.5), 0.704, 0.0025); // of three digits
}

/// At roughness 0.1 the table's losses round to 0: 0.05 % for each of the few events of a path.
TEST(WhiteFurnace, OfHardlyRoughGlassAndMetal) {
  PathScene test({16, 8});
  test.perspective({0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, 20.0);
  geometry::Material& glass = test.material("glass", MaterialId::Dielectric, 1.0);
  glass.roughness = 0.1;
  test.material("metal", MaterialId::Conductor, 1.0).roughness = 0.1;
  test.ball("glass", {-1.0, 0.0, 0.0}, 0.9);
  test.ball("metal", {1.0, 0.0, 0.0}, 0.9);
  test.constant(1.0);
  const Moments moments = renderMoments(test.scene, test.volumes, byPaths({.replicates = 16, .samples = 64}));
  EXPECT_AGREES(imageTest(moments, 1.0, 0, 2e-3));
  EXPECT_DIFFERS(imageTest(moments, 0.99, 0, 2e-3)); // planted: 1 % lost
}

/// Radiance that leaves an isotropic half-space at cosine `out`, lit by perpendicular irradiance 1 at cosine `in`;
/// channels have albedos of their own. By H functions, 8 digits.
struct HalfSpace {
  double out, in;
  glm::dvec3 albedo, radiance;
};
const HalfSpace kHalfSpaces[] = {{1.0, 1.0, {0.5, 0.8, 0.9}, {0.031147627, 0.081306073, 0.122572307}},
                                 {0.5, 1.0, {0.3, 0.9, 0.99}, {0.019683938, 0.137453331, 0.240084980}},
                                 {1.0, 0.5, {0.5, 0.8, 0.99}, {0.019710875, 0.047931184, 0.120042490}},
                                 {1.0, 1.0, {0.3, 0.9, 0.99}, {0.015156861, 0.122572307, 0.240863393}},
                                 {0.5, 1.0, {0.5, 0.8, 0.9}, {0.039421750, 0.095862368, 0.137453331}},
                                 {1.0, 0.5, {0.3, 0.9, 0.8}, {0.009841969, 0.068726665, 0.047931184}}};

/// 40 mean free paths deep and 2000 wide. As a grid its surface is a ramp of 5, which a half-space does not care for.
PathScene halfSpace(const HalfSpace& row, bool asGrid) {
  PathScene test({8, 8});
  const glm::dvec3 out(std::sqrt(1.0 - row.out * row.out), 0.0, row.out);
  test.orthographic(50.0 * out, {0.0, 0.0, 0.0}, 0.1);
  test.sun({0.0, -std::sqrt(1.0 - row.in * row.in), -row.in});
  const glm::dvec3 low(-1000.0, -1000.0, -40.0);
  const glm::dvec3 high(1000.0, 1000.0, 0.0);
  scene::Medium& medium = asGrid ? test.grid(constantGrid(9, low, high, 1.0), 1.0) : test.box(low, high, 1.0);
  medium.albedo = row.albedo;
  return test;
}

/// One standard error is 0.2 to 0.4 %. The long version takes all rows of the table, and a quarter of that error.
TEST(HalfSpace, SendsBackWhatChandrasekharSays) {
  const std::size_t rows = effort() > 1 ? std::size(kHalfSpaces) : 2;
  for (std::size_t i = 0; i < rows; ++i) {
    const HalfSpace& row = kHalfSpaces[i];
    for (const bool asGrid : {false, true}) {
      if (effort() == 1 && asGrid == (i == 0)) {
        continue;
      }
      const PathScene test = halfSpace(row, asGrid);
      const Moments moments = renderMoments(test.scene, test.volumes, byPaths({.replicates = 24, .samples = 128}));
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_AGREES(imageTest(moments, row.radiance[channel], channel, 2e-5))
            << "row " << i << " channel " << channel << (asGrid ? " grid" : "");
        EXPECT_DIFFERS(imageTest(moments, 1.03 * row.radiance[channel], channel, 2e-5)); // planted: 3 % off
      }
    }
  }
}

} // namespace
} // namespace tyndall::test

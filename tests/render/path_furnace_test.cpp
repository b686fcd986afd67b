// SPDX-License-Identifier: Apache-2.0
// Where everything is white, nothing can be seen (docs/theory.md A5); and light that comes back from a half-space (A6).
#include "support/path_scenes.h"
#include "verify/references.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

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
  const PathScene test = whiteRoom();
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

// SPDX-License-Identifier: Apache-2.0
// Distances aimed at small lights in homogeneous media (theory.md, (68)): the same picture with less noise.
#include "support/path_scenes.h"

#include <gtest/gtest.h>

namespace tyndall::test {
namespace {

/// A point, a spot and a small ball shine in two media that overlap, over a floor and beside a puff; media glow too.
PathScene lampsInMist() {
  PathScene test({16, 16});
  test.perspective({0.0, 0.4, 4.0}, {0.0, 0.2, 0.0}, 30.0); // the ball is out of sight
  test.depth(3);
  test.material("floor", MaterialId::Diffuse, 0.5);
  test.lamp("lamp", 400.0);
  test.quad("floor", {-6.0, -1.0, 6.0}, {12.0, 0.0, 0.0}, {0.0, 0.0, -12.0});
  test.ball("lamp", {-0.5, 1.4, 0.1}, 0.04);
  test.point({0.7, 0.6, 0.0}, 1.0);
  test.spot({.position = {0.1, 1.0, -0.5}, .direction = {0.0, -1.0, 0.0}, .intensity = glm::dvec3(3.0)});
  test.box({-2.0, -1.0, -2.0}, {2.0, 1.5, 2.0}, 0.2, 0.9).phase = henyeyGreenstein(0.4);
  scene::Emission glow;
  glow.scale = 0.3;
  test.sphere({0.4, 0.4, 0.0}, 0.8, 0.3, 0.7).emission = glow;
  test.grid(puffGrid(), 0.5, 0.8);
  test.emissionGrid(puffGrid(), glow);
  return test;
}

MomentOptions aiming(bool aim, std::uint32_t firstSeed) {
  MomentOptions options = byPaths({.replicates = 16, .samples = 32, .firstSeed = firstSeed});
  options.estimator.aim = aim;
  return options;
}

/// Mean over the pixels of the replicates' variance. Without aiming few samples come close to a lamp, and those few are
/// most of it.
double noise(const Moments& moments) {
  double sum = 0.0;
  for (const auto& pixel : moments.pixels) {
    sum += pixel[0].variance;
  }
  return sum / double(moments.pixels.size());
}

TEST(PathAim, ChangesTheNoiseAlone) {
  const PathScene test = lampsInMist();
  const Moments aimed = renderMoments(test.scene, test.volumes, aiming(true, 2001));
  const Moments plain = renderMoments(test.scene, test.volumes, aiming(false, 501));
  EXPECT_AGREES(tileTest(aimed, plain));
  EXPECT_LT(noise(aimed), 0.5 * noise(plain));
  const Moments bad = renderMoments(test.scene, test.volumes, withBug(aiming(true, 1001), interop::kBugAimShare));
  EXPECT_DIFFERS(tileTest(bad, aimed));
}

} // namespace
} // namespace tyndall::test

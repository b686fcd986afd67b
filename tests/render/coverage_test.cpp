// SPDX-License-Identifier: Apache-2.0
// The coverage mask is conservative: a pixel that it leaves out sees nothing but the background.
#include "render/coverage.h"
#include "support/render_fixture.h"
#include "support/render_scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace tyndall::test {
namespace {

/// Small bricks far apart, so that there is something to leave out.
volume::BrickGrid islands(const glm::dmat4& worldFromIndex) {
  return gridOf(glm::ivec3(40), glm::ivec3(-20), worldFromIndex, [](const glm::ivec3& index) {
    return glm::all(glm::lessThan(index & 31, glm::ivec3(4))) ? 50.0 : 0.0;
  });
}

TestScene baseScene() {
  TestScene test({24, 24});
  test.point({0.3, 0.2, 0.1}, 100.0);
  test.perspective({0.0, 3.0, 60.0}, {0.0, 0.0, 0.0}, 50.0);
  return test;
}

/// Unmarked pixels, and how many of them see a medium all the same.
struct Misses {
  std::size_t unmarked = 0;
  std::size_t wrong = 0;
};

Misses missesOf(const TestScene& test, const std::vector<bool>& mask, MomentOptions options) {
  options.replicates = 2;
  options.samples = marches(options) ? 128 : 2048; // every ray of the march that meets a medium shows it
  options.skip = mask;
  const Moments moments = renderMoments(test.scene, test.volumes, options);
  Misses misses;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) {
      ++misses.unmarked;
      misses.wrong += moments.mean(i, kTransmittance) != 1.0 || moments.mean(i) != 0.0;
    }
  }
  return misses;
}

void expectConservative(const TestScene& test, std::size_t leastUnmarked, const std::string& name) {
  const std::vector<bool> mask = render::sceneCoverage(test.scene, test.volumes);
  for (const MomentOptions& options : eachMethod()) {
    const Misses misses = missesOf(test, mask, options);
    EXPECT_EQ(misses.wrong, 0u) << name << nameOf(options);
    EXPECT_GE(misses.unmarked, leastUnmarked) << name; // else the test says nothing
  }
}

/// The fast version takes the mirrored one and the one with all of the others' parts.
std::vector<NamedMap> mapsToTest() {
  std::vector<NamedMap> maps = affineMaps();
  if (effort() == 1) {
    maps.erase(maps.begin(), maps.end() - 2);
  }
  return maps;
}

TEST(Coverage, IsConservativeForMappedGrids) {
  for (const NamedMap& map : mapsToTest()) {
    TestScene test = baseScene();
    test.grid(islands(map.worldFromIndex));
    expectConservative(test, 50, map.name);
  }
}

TEST(Coverage, IsConservativeForHomogeneousMedia) {
  for (const NamedMap& map : mapsToTest()) {
    TestScene test = baseScene();
    test.box({-5.0, -4.0, -3.0}, {6.0, 2.0, 1.0}, 30.0).worldFromMedium = map.worldFromIndex;
    test.sphere({-8.0, 7.0, 2.0}, 3.0, 30.0).worldFromMedium = map.worldFromIndex;
    expectConservative(test, 50, map.name);
  }
}

TEST(Coverage, IsConservativeFromInsideBesideAndBehind) {
  TestScene test = baseScene();
  test.grid(islands(glm::dmat4(1.0)));
  test.perspective({-18.5, -18.5, -18.5}, {20.0, 3.0, 0.0}, 70.0); // inside an island
  expectConservative(test, 0, "inside");
  test.perspective({0.0, 0.0, 9.0}, {1.0, 0.0, 30.0}, 60.0); // between them: some are behind
  expectConservative(test, 0, "between");
  test.perspective({0.0, 0.0, 60.0}, {0.0, 0.0, 100.0}, 60.0); // all are behind
  expectConservative(test, 24 * 24, "behind");
  test.orthographic({3.0, 20.0, 30.0}, {0.0, 0.0, 0.0}, 60.0);
  expectConservative(test, 50, "orthographic");
  test.orthographic({0.0, 0.0, 0.0}, {1.0, 0.2, 0.3}, 60.0);
  expectConservative(test, 50, "orthographic from inside");
}

TEST(Coverage, OneMissingPixelIsSeen) {
  TestScene test = baseScene();
  test.grid(islands(glm::dmat4(1.0)));
  std::vector<bool> mask = render::sceneCoverage(test.scene, test.volumes);
  const Moments moments = renderMoments(test.scene, test.volumes, {.replicates = 2});
  std::size_t seen = 0;
  while (moments.mean(seen, kTransmittance) > 0.9) {
    ++seen;
  }
  mask[seen] = false; // planted
  for (const MomentOptions& options : eachMethod()) {
    EXPECT_EQ(missesOf(test, mask, options).wrong, 1u) << nameOf(options);
  }
}

} // namespace
} // namespace tyndall::test

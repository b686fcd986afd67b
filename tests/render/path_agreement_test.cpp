// SPDX-License-Identifier: Apache-2.0
// Ways to find light that must agree: techniques and selections of the pass `path`; the pass itself with tracking,
// where one event in media is all there is.
#include "support/path_scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace tyndall::test {
namespace {

PathScene view() {
  PathScene test({12, 12});
  test.perspective({0.8, 0.7, 4.2}, {0.0, 0.0, 0.0}, 34.0);
  return test;
}

scene::Emission glow(double scale) {
  scene::Emission emission;
  emission.scale = scale;
  return emission;
}

/// Emissive triangles, a sphere light, volumes that glow and an environment, in fog over a floor.
PathScene everyLight() {
  PathScene test = view();
  test.depth(3);
  test.constant(0.15);
  test.material("floor", MaterialId::Diffuse, 0.6);
  geometry::Material& metal = test.material("metal", MaterialId::Conductor, 0.9);
  metal.roughness = 0.5;
  test.lamp("lamp", 4.0);
  test.lamp("panel", 2.0).twoSided = true;
  test.quad("floor", {-5.0, -1.0, 5.0}, {10.0, 0.0, 0.0}, {0.0, 0.0, -10.0});
  test.ball("metal", {0.5, -0.5, 0.4}, 0.45);
  test.ball("lamp", {-1.0, 0.5, 0.2}, 0.25);
  test.quad("panel", {0.6, 0.1, -0.9}, {0.7, 0.2, 0.3}, {0.1, 0.7, 0.0});
  test.box({-1.4, -0.9, -1.1}, {1.4, 1.1, 1.1}, 0.3, 0.9).phase = henyeyGreenstein(0.6);
  test.sphere({0.1, 0.9, 0.0}, 0.4, 0.5, 0.4).emission = glow(1.5);
  scene::Medium& fire = test.grid(puffGrid(), 1.0, 0.5);
  fire.worldFromMedium = glm::scale(glm::translate(glm::dmat4(1.0), {-0.3, -0.4, -0.3}), glm::dvec3(0.5));
  test.emissionGrid(puffGrid(), glow(4.0));
  return test;
}

MomentOptions combined(std::uint32_t techniques, std::uint32_t selection) {
  MomentOptions options = byPaths({.replicates = 16, .samples = 32, .firstSeed = 1001});
  options.estimator.techniques = techniques;
  options.estimator.lightSelection = selection;
  return options;
}

/// One standard error of a tile is some 0.6 % with both techniques. The long version takes all combinations.
TEST(PathAgreement, OfTechniquesAndSelections) {
  constexpr std::uint32_t kBoth = interop::kTechniqueLight | interop::kTechniqueDirection;
  std::vector<MomentOptions> others = {combined(interop::kTechniqueLight, interop::kSelectTree),
                                       combined(interop::kTechniqueDirection, interop::kSelectTree),
                                       combined(kBoth, interop::kSelectUniform)};
  if (effort() > 1) {
    others.push_back(combined(kBoth, interop::kSelectPower));
    others.push_back(combined(interop::kTechniqueLight, interop::kSelectPower));
    others.push_back(combined(interop::kTechniqueLight, interop::kSelectUniform));
  }
  const PathScene test = everyLight();
  const Moments reference =
      renderMoments(test.scene, test.volumes, byPaths({.replicates = 24, .samples = 32, .firstSeed = 1}));
  for (const MomentOptions& options : others) {
    EXPECT_AGREES(tileTest(renderMoments(test.scene, test.volumes, options), reference)) << techniqueOf(options);
  }
  for (const std::uint32_t bug : {interop::kBugVolumePdf, interop::kBugBranchPdf}) {
    MomentOptions bad = withBug(combined(kBoth, interop::kSelectTree), bug);
    bad.replicates = 24;
    EXPECT_DIFFERS(tileTest(renderMoments(test.scene, test.volumes, bad), reference)) << bug;
  }
}

/// A scene of media alone, one event.
struct Case {
  const char* name;
  TestScene (*scene)();
};

TestScene stage() {
  TestScene test({16, 16});
  test.perspective({1.0, 0.5, 4.0}, {0.0, 0.0, 0.0}, 26.0);
  return test;
}

TestScene lampsAndSun() {
  TestScene test = stage();
  test.grid(puffGrid(), 1.0, 0.9).phase = henyeyGreenstein(0.3);
  test.sphere({0.0, 0.2, 0.0}, 2.0, 0.15, 0.8).phase = henyeyGreenstein(0.6);
  test.point({2.0, 1.8, 0.5}, 2.0);
  test.point({-1.5, 1.3, 0.9}, 1.0);
  test.sun({0.4, -1.0, -0.3}, 1.0, 3.0);
  return test;
}

TestScene gridsUnderAnEnvironment() {
  TestScene test = stage();
  test.grid(puffGrid(), 1.0, 0.9).phase = henyeyGreenstein(0.8);
  scene::Medium& other = test.grid(puffGrid({3, -9, 5}, volume::Storage::Half), 1.5, 0.6);
  other.phase = henyeyGreenstein(-0.5);
  other.worldFromMedium = glm::translate(glm::dmat4(1.0), {0.4, 0.3, -0.2}) *
                          glm::dmat4(glm::dmat3(0.3) * glm::dmat3(affineMaps().back().worldFromIndex));
  test.constant(0.3);
  test.sun({-0.4, -1.0, 0.3}, 0.5);
  return test;
}

TestScene glowingGrid() {
  TestScene test = stage();
  test.grid(puffGrid(), 1.0, 0.5);
  scene::Emission emission;
  emission.kind = scene::Emission::Kind::Blackbody;
  emission.scale = 1e-5;
  emission.temperatureScale = 1500.0;
  emission.temperatureAuto = false;
  emission.tiedToAbsorption = true;
  const volume::BrickGrid shape = constantGrid(9, glm::dvec3(-0.8), glm::dvec3(1.1), 1.0);
  test.emissionGrid(gridOf(glm::ivec3(9), glm::ivec3(0), shape.worldFromIndex,
                           [](const glm::ivec3& i) { return 0.6 + 0.07 * i.y + 0.04 * i.x; }),
                    emission);
  test.box({-0.4, -0.9, -0.8}, {0.9, 0.6, 0.5}, 0.6, 0.0).emission = glow(0.05);
  return test;
}

const Case kCases[] = {{"LampsAndSunInFogAndGrid", lampsAndSun},
                       {"GridsUnderAnEnvironment", gridsUnderAnEnvironment},
                       {"GlowingGrid", glowingGrid}};

/// Emission: as an event of its own it would be lit by what glows, which tracking leaves out; nothing scatters there.
Moments oneEvent(const TestScene& test, render::Method method, std::uint32_t seed, std::uint32_t bug) {
  MomentOptions options{.replicates = 16, .samples = 32, .firstSeed = seed};
  options.estimator.method = method;
  return renderMoments(test.scene, test.volumes, withBug(options, bug));
}

TEST(PathAgreement, WithTrackingWhereOneEventIsAll) {
  for (const Case& one : kCases) {
    TestScene test = one.scene();
    for (scene::Medium& medium : test.scene.media) {
      medium.albedo *= test.scene.lights.empty() ? 0.0 : 1.0;
    }
    const Moments tracking = oneEvent(test, render::Method::Tracking, 1, interop::kBugNone);
    EXPECT_AGREES(tileTest(oneEvent(test, render::Method::Path, 1001, interop::kBugNone), tracking)) << one.name;
    if (one.scene == gridsUnderAnEnvironment) {
      EXPECT_DIFFERS(tileTest(oneEvent(test, render::Method::Path, 1001, interop::kBugPhaseSign), tracking));
    }
    if (one.scene == glowingGrid) {
      EXPECT_DIFFERS(tileTest(oneEvent(test, render::Method::Path, 1001, interop::kBugHalfVoxel), tracking));
    }
  }
}

} // namespace
} // namespace tyndall::test

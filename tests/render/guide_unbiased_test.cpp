// SPDX-License-Identifier: Apache-2.0
// Guiding changes the variance alone: whatever the store holds, guided and unguided pictures have the same mean.
#include "guide_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tyndall::test {
namespace {

using scene::Integrator;

/// Four tiles.
PathScene view() {
  PathScene test({32, 32});
  test.perspective({0.4, 0.9, 4.0}, {0.0, 0.1, 0.0}, 36.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 3.0);
  return test;
}

/// Over the scene, shining down.
void lampAbove(PathScene& test) { test.quad("lamp", {-0.9, 1.6, -0.7}, {1.2, 0.0, 0.0}, {0.0, 0.0, 1.2}); }
void floorBelow(PathScene& test) { test.quad("white", {-4.0, -1.0, 3.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -6.0}); }

/// A box stands between the lamp and part of the floor; a rough metal ball.
PathScene surfaces() {
  PathScene test = view();
  test.depth(4);
  lampAbove(test);
  floorBelow(test);
  test.material("metal", MaterialId::Conductor, 0.8).roughness = 0.5;
  test.crate("white", {-0.8, 0.2, -0.6}, {0.0, 0.4, 0.3});
  test.ball("metal", {0.7, -0.5, 0.3}, 0.5);
  test.quad("white", {-4.0, -1.0, -1.5}, {8.0, 0.0, 0.0}, {0.0, 5.0, 0.0});
  return test;
}

/// One event in a homogeneous medium that glows in a part of it.
PathScene mist() {
  PathScene test = view();
  test.depth(1);
  lampAbove(test);
  test.box({-1.5, -1.2, -1.0}, {1.5, 1.2, 1.0}, 0.6, 0.9).phase = henyeyGreenstein(0.5);
  scene::Emission glow;
  glow.scale = 0.3;
  test.sphere({0.8, -0.6, 0.2}, 0.5, 0.4, 0.5).emission = glow;
  return test;
}

/// The same in a grid, under a dim sky.
PathScene smoke() {
  PathScene test = view();
  test.depth(1);
  test.constant(0.1);
  lampAbove(test);
  test.grid(puffGrid(), 1.5, 0.9).phase = henyeyGreenstein(0.4);
  return test;
}

/// Paths of any length between surfaces and media.
PathScene foggyRoom() {
  PathScene test = view();
  lampAbove(test);
  floorBelow(test);
  test.quad("white", {-4.0, -1.0, -1.5}, {8.0, 0.0, 0.0}, {0.0, 5.0, 0.0});
  test.ball("white", {0.6, -0.4, 0.0}, 0.5);
  test.box({-2.0, -1.0, -1.5}, {2.0, 1.4, 1.5}, 0.4, 0.9).phase = henyeyGreenstein(0.6);
  test.grid(puffGrid(), 0.7, 0.8);
  return test;
}

/// A mirror, clear and rough glass under a lamp and a sky.
PathScene glassware() {
  PathScene test = view();
  test.depth(6);
  test.constant(0.2);
  lampAbove(test);
  floorBelow(test);
  test.material("mirror", MaterialId::Conductor, 0.9);
  test.material("glass", MaterialId::Dielectric, 1.0);
  test.material("frosted", MaterialId::Dielectric, 1.0).roughness = 0.6;
  test.ball("mirror", {-0.9, -0.5, -0.4}, 0.5);
  test.ball("glass", {0.0, -0.55, 0.5}, 0.45);
  test.ball("frosted", {0.9, -0.5, -0.2}, 0.5);
  return test;
}

/// How paths are guided.
struct Way {
  Integrator integrator;
  bool lightSamples;
  bool garbage; ///< a store without sense that is read alone; else one that learns
};

std::string nameOf(const Way& way) {
  return fmt::format("{}, light samples {}, {}", integratorName(way.integrator), way.lightSamples ? "on" : "off",
                     way.garbage ? "garbage" : "learning");
}

std::vector<Way> everyWay() {
  std::vector<Way> result;
  for (const Integrator integrator : {Integrator::ScreenChains, Integrator::McpgPaper, Integrator::Mcpg}) {
    for (const bool lightSamples : {true, false}) {
      for (const bool garbage : {true, false}) {
        result.push_back({integrator, lightSamples, garbage});
      }
    }
  }
  return result;
}

/// 64 times the samples in the long version.
MomentOptions base(std::uint32_t firstSeed) {
  return {.replicates = 16, .samples = effort() > 1 ? 32u : 8u, .firstSeed = firstSeed};
}

/// A store that learns goes from replicate to replicate: given what it holds each is unbiased, so that they are
/// uncorrelated, though not independent.
Moments guided(const PathScene& test, const Way& way, std::uint32_t bug = interop::kBugNone) {
  scene::GuideSettings settings = scene::guideSettings(way.integrator);
  const StorePtr store = makeStore(settings, test);
  if (way.garbage) {
    learn(test, store, settings, way.lightSamples, 1);
    fillWithGarbage(*store, 7);
    settings.learn = false;
  }
  MomentOptions options = withBug(guidedBy(store, settings, base(5001)), bug);
  options.replicates *= bug != interop::kBugNone ? 2 : 1; // the store, and with it a bug, differs from run to run
  const Moments moments = render(test, way.lightSamples ? options : withoutLightSamples(options));
  EXPECT_TRUE(way.garbage || store->occupancy().unsound == 0u) << nameOf(way);
  return moments;
}

struct Case {
  const char* name;
  PathScene (*scene)();
  std::vector<Way> fast;
};

class GuideUnbiased : public testing::TestWithParam<Case> {};

/// Means of every tile and channel, and that of the whole picture, which sees the smallest bias. The fast version takes
/// a few ways, the long one all. One standard error of the picture's mean is printed.
TEST_P(GuideUnbiased, WhateverTheStoreHolds) {
  const std::vector<Way> ways = effort() > 1 ? everyWay() : GetParam().fast;
  if (ways.empty()) {
    GTEST_SKIP() << "long version only";
  }
  const PathScene test = GetParam().scene();
  const Moments reference = render(test, byPaths(base(1)));
  for (const Way& way : ways) {
    const Moments moments = guided(test, way);
    EXPECT_AGREES(tileTest(moments, reference)) << nameOf(way);
    const Verdict whole = channelTest(moments, reference);
    EXPECT_AGREES(whole) << nameOf(way);
    fmt::print("{}: {:+.3f} % +- {:.3f} %\n", nameOf(way), 100.0 * whole.bias, 100.0 * whole.resolution);
    std::fflush(stdout);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, GuideUnbiased,
                         testing::Values(Case{"Surfaces",
                                              surfaces,
                                              {{Integrator::McpgPaper, true, true},
                                               {Integrator::Mcpg, true, true},
                                               {Integrator::ScreenChains, true, true}}},
                                         Case{"Mist", mist, {}}, Case{"Smoke", smoke, {}},
                                         Case{"FoggyRoom", foggyRoom, {{Integrator::Mcpg, false, false},
                                                                   {Integrator::ScreenChains, false, false}}},
                                         Case{"Glassware", glassware, {}}),
                         [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

/// The faintest in the long version alone. Without light samples, where they have no part in it: those hide what
/// directions do wrong.
TEST(GuideUnbiasedChecks, PlantedBugsAreSeen) {
  const PathScene test = surfaces();
  MomentOptions options = base(1);
  options.replicates *= effort() > 1 ? 2 : 1;
  const Moments reference = render(test, byPaths(options));
  std::vector<std::uint32_t> bugs{interop::kBugChosenLobe, interop::kBugScatterShare};
  if (effort() > 1) {
    bugs.push_back(interop::kBugLightByScatter);
  }
  for (const std::uint32_t bug : bugs) {
    const Way way{Integrator::Mcpg, bug == interop::kBugLightByScatter, false};
    const Verdict verdict = tileTest(guided(test, way, bug), reference);
    EXPECT_DIFFERS(verdict) << bug;
    fmt::print("{}: {}\n", bug, verdict.text());
  }
}

TEST(GuideUnbiasedChecks, NeighboursMissingInTheDensityAreSeen) {
  const PathScene test = surfaces();
  const Moments reference = render(test, byPaths(base(1)));
  const Way way{Integrator::ScreenChains, true, false};
  EXPECT_DIFFERS(tileTest(guided(test, way, interop::kBugNoNeighbours), reference));
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// Chains in screen space: what they learn, which vertices they serve, and where a frame finds those of the one before.
// That they change no mean: GuideUnbiased.
#include "gpu_scene/motion.h"
#include "guide_fixture.h"
#include "support/probe.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tyndall::test {
namespace {

const scene::GuideSettings kScreen = scene::guideSettings(scene::Integrator::ScreenChains);

/// Nine booths on a floor with a lamp in each; one event. A picture as near as a part of a large one is: neighbours
/// some pixels away see the same lamp.
PathScene booths() {
  constexpr double kHalf = 0.04; // of a lamp
  constexpr double kWidth = 0.6; // of a booth
  PathScene test({32, 32});
  test.depth(1);
  test.perspective({0.1, 3.0, 0.4}, {0.1, 0.0, 0.1}, 5.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 5.0);
  test.quad("white", {-0.9, 0.0, 0.9}, {1.8, 0.0, 0.0}, {0.0, 0.0, -1.8});
  for (int i = 0; i < 4; ++i) {
    const double wall = kWidth * (i - 1.5);
    test.quad("white", {wall, 0.0, -0.9}, {0.0, 0.0, 1.8}, {0.0, 0.4, 0.0});
    test.quad("white", {-0.9, 0.0, wall}, {1.8, 0.0, 0.0}, {0.0, 0.4, 0.0});
  }
  for (int i = 0; i < 9; ++i) {
    const glm::dvec3 corner(kWidth * (i % 3 - 1) - kHalf, 0.3, kWidth * (i / 3 - 1) - kHalf);
    test.quad("lamp", corner, {2.0 * kHalf, 0.0, 0.0}, {0.0, 0.0, 2.0 * kHalf});
  }
  return test;
}

Noise noise(const PathScene& test, const MomentOptions& options) {
  return noiseOf(render(test, withoutLightSamples(options)));
}

MomentOptions many(std::uint32_t firstSeed) { return {.replicates = 8, .samples = 16, .firstSeed = firstSeed}; }

/// Chains that have learnt, and go on to, lower the noise where directions alone find the lamps. Planted: a store that
/// is empty and stays so.
TEST(GuideScreen, ChainsLowerTheNoise) {
  const PathScene test = booths();
  const StorePtr store = makeStore(kScreen, test);
  learn(test, store, kScreen);
  const Noise unguided = noise(test, byPaths(many(1)));
  const Ratio learnt = ratioOf(noise(test, guidedBy(store, kScreen, many(1001))), unguided);
  scene::GuideSettings frozen = kScreen;
  frozen.learn = false;
  const Ratio empty = ratioOf(noise(test, guidedBy(makeStore(kScreen, test), frozen, many(1001))), unguided);
  const guide::Occupancy full = store->occupancy();
  fmt::print("{} states, noise {}, without {}\n", full.states, learnt.text(), empty.text());
  EXPECT_EQ(full.unsound, 0u);
  EXPECT_LT(learnt.high, 0.1);
  EXPECT_GT(empty.low, 0.1) << "the planted lack of chains was not seen";
}

/// A strip of the picture, as wide as two facets of a folded wall: each faces away from the next, so that its states do
/// not serve the other. A long lens, far away; a lamp above the line of sight.
constexpr glm::uvec2 kStrip{128, 8};
constexpr double kFacet = 2.0;

PathScene foldedWall(double cameraX, double wallX) {
  PathScene test(kStrip);
  test.depth(4);
  test.perspective({cameraX, 0.0, 40.0}, {cameraX, 0.0, 0.0}, 0.358);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 5.0);
  for (int i = -3; i < 4; ++i) {
    const bool away = i % 2 == 0;
    test.quad("white", {wallX + kFacet * i, -2.0, away ? 0.0 : -kFacet}, {kFacet, 0.0, away ? -kFacet : kFacet},
              {0.0, 4.0, 0.0});
  }
  test.quad("lamp", {-8.0, 0.5, 6.0}, {0.0, 3.0, 0.0}, {16.0, 0.0, 0.0});
  return test;
}

std::vector<std::uint32_t> columns(std::uint32_t first, std::uint32_t end) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t y = 0; y < kStrip.y; ++y) {
    for (std::uint32_t x = first; x < end; ++x) {
      pixels.push_back(x | y << 16);
    }
  }
  return pixels;
}

/// A frame's samples, 16 for each pixel and seed. `previous`: where surfaces were.
render::GuideTotals frame(const PathScene& now, const PathScene* previous, const render::GuidePlan& plan,
                          const std::vector<std::uint32_t>& pixels, std::uint32_t seeds) {
  gpu_scene::Pose pose;
  if (previous != nullptr) {
    pose = gpu_scene::poseOf(previous->scene, previous->volumes.meshes);
  }
  const gpu_scene::GpuScene scene(probeDevice(), now.scene, now.volumes, gpu_scene::GridLayout::Paths,
                                  previous != nullptr ? &pose : nullptr);
  render::EstimatorOptions options = withoutLightSamples(byPaths()).estimator;
  options.guide = plan;
  const auto estimator = render::makeEstimator(probeDevice(), scene, now.volumes, options);
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    estimator->run(pixels, {0, 16}, seed);
  }
  return estimator->guiding()->totals();
}

double statesPerVertex(const render::GuideTotals& totals) { return double(totals.states) / double(totals.vertices); }

/// Chains of a wall that is seen by a camera at x = 0.
StorePtr learntStrip() {
  const PathScene test = foldedWall(0.0, 0.0);
  const StorePtr store = makeStore(kScreen, test);
  frame(test, nullptr, {.settings = kScreen, .store = store}, columns(0, kStrip.x), 2);
  return store;
}

/// Of all vertices of paths, the first alone asks; and a round has as many samples as it is told. Seen to fail where
/// all vertices on surfaces asked.
TEST(GuideScreen, FirstVerticesAskInRoundsOfTheirOwn) {
  const PathScene test = foldedWall(0.0, 0.0);
  scene::GuideSettings settings = kScreen;
  for (const std::uint32_t samples : {1u, 6u}) {
    settings.roundSamples = samples;
    const StorePtr store = makeStore(settings, test);
    const render::GuideTotals totals =
        frame(test, nullptr, {.settings = settings, .store = store}, columns(0, kStrip.x), 1);
    EXPECT_EQ(totals.vertices, 16u * kStrip.x * kStrip.y);
    EXPECT_EQ(store->round(), samples == 1 ? 16u : 3u);
    EXPECT_EQ(totals.accepted == totals.vertices, samples == 1) << "a round's first sample is taken whatever it found";
  }
}

/// What the next frame reads in columns that are a facet, hence 24 pixels and more, away from where they were before:
/// beyond that lie 2 % of the neighbours.
constexpr std::uint32_t kFirstColumn = 16;
constexpr std::uint32_t kEndColumn = 40;

double statesOfNextFrame(const PathScene& now, const PathScene* previous, const StorePtr& store,
                         const std::optional<scene::Camera>& before) {
  scene::GuideSettings frozen = kScreen;
  frozen.learn = false;
  const render::GuidePlan plan{.settings = frozen, .store = store, .before = before};
  return statesPerVertex(frame(now, previous, plan, columns(kFirstColumn, kEndColumn), 1));
}

/// A camera that has moved on by a facet finds the chains where its last frame had them. Planted: it does not know
/// that.
TEST(GuideScreen, ChainsAreFoundWhereTheLastCameraSawThem) {
  const StorePtr store = learntStrip();
  const PathScene now = foldedWall(kFacet, 0.0);
  const double found = statesOfNextFrame(now, nullptr, store, foldedWall(0.0, 0.0).scene.camera);
  const double planted = statesOfNextFrame(now, nullptr, store, std::nullopt);
  fmt::print("states of a vertex: {:.3f}, planted {:.3f}\n", found, planted);
  EXPECT_GT(found, 0.5);
  EXPECT_LT(planted, 0.25) << "the planted camera was not seen";
}

/// Likewise of a wall that has moved. Planted: its motion is not known.
TEST(GuideScreen, ChainsAreFoundWhereTheirSurfaceWas) {
  const StorePtr store = learntStrip();
  const PathScene before = foldedWall(0.0, 0.0);
  const PathScene now = foldedWall(0.0, -kFacet);
  const double found = statesOfNextFrame(now, &before, store, before.scene.camera);
  const double planted = statesOfNextFrame(now, nullptr, store, before.scene.camera);
  fmt::print("states of a vertex: {:.3f}, planted {:.3f}\n", found, planted);
  EXPECT_GT(found, 0.5);
  EXPECT_LT(planted, 0.25) << "the planted motion was not seen";
}

} // namespace
} // namespace tyndall::test

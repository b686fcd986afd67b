// SPDX-License-Identifier: Apache-2.0
// A frame's first round finds what the frame before has learnt where surfaces and camera were then.
#include "film/statistics.h"
#include "gpu_scene/motion.h"
#include "guide_fixture.h"
#include "support/probe.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kEdge = 16;
constexpr double kStep = 3.0; ///< a plate is as wide as 2: it leaves its place

/// A plate under a lamp that goes with it: its light lies the same way from all its places. One event.
PathScene plateAt(double x, double cameraX) {
  PathScene test({kEdge, kEdge});
  test.depth(1);
  test.perspective({cameraX, 4.0, 0.0}, {cameraX, 0.0, -0.01}, 20.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 50.0);
  test.quad("white", {x - 1.0, 0.0, 1.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, -2.0});
  test.ball("lamp", {x + 0.8, 0.6, 0.0}, 0.1);
  return test;
}

/// Chains as published, in fine cells of one level alone: nothing of another place is found by chance.
scene::GuideSettings fineCells() {
  scene::GuideSettings settings = scene::guideSettings(scene::Integrator::McpgPaper);
  settings.staticGrid = false;
  settings.cells.angle = 0.02;
  settings.cells.spread = 0.0;
  settings.unit = 0.01; // bounds move with the plate
  return settings;
}

std::vector<std::uint32_t> allPixels() {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t i = 0; i < kEdge * kEdge; ++i) {
    pixels.push_back(i % kEdge | i / kEdge << 16);
  }
  return pixels;
}

struct Frame {
  double statesPerVertex = 0.0;
  film::SampleSummary mean; ///< of the picture, over rounds
};

/// Rounds of a sample each, first ones all. @param previous null: of a first
/// frame.
Frame frame(const PathScene& now, const PathScene* previous, const StorePtr& store,
            const scene::GuideSettings& settings, std::uint32_t rounds) {
  gpu_scene::Pose pose;
  if (previous != nullptr) {
    pose = gpu_scene::poseOf(previous->scene, previous->volumes.meshes);
  }
  const gpu_scene::GpuScene scene(probeDevice(), now.scene, now.volumes, gpu_scene::GridLayout::Paths,
                                  previous != nullptr ? &pose : nullptr);
  render::EstimatorOptions options = withoutLightSamples(byPaths()).estimator;
  if (store) {
    options.guide = render::GuidePlan{.settings = settings, .store = store};
    if (previous != nullptr) {
      options.guide->before = previous->scene.camera;
    }
  }
  const auto estimator = render::makeEstimator(probeDevice(), scene, now.volumes, options);
  const std::vector<std::uint32_t> pixels = allPixels();
  std::vector<double> means;
  for (std::uint32_t round = 0; round < rounds; ++round) {
    double sum = 0.0;
    for (const interop::PixelSums& each : estimator->run(pixels, {0, 1}, 7000 + round)) {
      sum += each.moments[0];
    }
    means.push_back(sum / double(pixels.size()));
  }
  Frame result;
  result.mean = film::summarise(means);
  if (store) {
    const render::GuideTotals& totals = estimator->guiding()->totals();
    result.statesPerVertex = double(totals.states) / double(totals.vertices);
  }
  return result;
}

/// What a frame of the plate in its first place has learnt.
StorePtr learntStore() {
  const PathScene test = plateAt(0.0, 0.0);
  const StorePtr store = makeStore(fineCells(), test);
  frame(test, nullptr, store, fineCells(), 64);
  return store;
}

scene::GuideSettings frozen(bool previousLookup) {
  scene::GuideSettings settings = fineCells();
  settings.learn = false;
  settings.previousLookup = previousLookup;
  return settings;
}

/// The first round reads states where the plate was, and without the look-up none: of 5 cells that a vertex loads more
/// than 1 holds a state where the frame before has learnt, and none where nothing ever was. Whatever is found, the mean
/// is that of unguided paths: means of rounds by Welch's t at 1e-4.
TEST(GuidePrevious, StatesAreFoundWhereTheirSurfaceWas) {
  const PathScene before = plateAt(0.0, 0.0);
  const PathScene now = plateAt(kStep, kStep);
  const StorePtr store = learntStore();
  constexpr std::uint32_t kRounds = 256;
  const Frame found = frame(now, &before, store, frozen(true), kRounds);
  const Frame planted = frame(now, &before, store, frozen(false), 1);
  const Frame plain = frame(now, nullptr, nullptr, {}, kRounds);
  fmt::print("states of a vertex: {:.3f}, planted {:.3f}\n", found.statesPerVertex, planted.statesPerVertex);
  EXPECT_GT(found.statesPerVertex, 1.0);
  EXPECT_LT(planted.statesPerVertex, 0.1) << "the planted look-up was not seen";
  const double error = std::sqrt((found.mean.variance + plain.mean.variance) / kRounds);
  EXPECT_LT(std::abs(found.mean.mean - plain.mean.mean), film::studentTQuantile(1.0 - 0.5e-4, kRounds - 1.0) * error);
}

/// A camera at four times the distance asks for cells two levels and more coarser: fine ones alone have been written.
TEST(GuidePrevious, StatesAreFoundInCellsOfTheLastCamera) {
  const PathScene before = plateAt(0.0, 0.0);
  PathScene now = before;
  now.perspective({0.0, 16.0, 0.0}, {0.0, 0.0, -0.01}, 5.0);
  const StorePtr store = learntStore();
  const double found = frame(now, &before, store, frozen(true), 1).statesPerVertex;
  const double planted = frame(now, &before, store, frozen(false), 1).statesPerVertex;
  fmt::print("states of a vertex: {:.3f}, planted {:.3f}\n", found, planted);
  EXPECT_GT(found, 1.0);
  EXPECT_LT(planted, 0.1) << "the planted look-up was not seen";
}

/// Later rounds look where surfaces are: what this frame has learnt is there, and was not at previous places. A vertex
/// in 16 at least finds a state of 64 samples of its pixel.
TEST(GuidePrevious, LaterRoundsFindWhatTheFrameHasLearnt) {
  const PathScene before = plateAt(0.0, 0.0);
  const PathScene now = plateAt(kStep, kStep);
  const gpu_scene::Pose pose = gpu_scene::poseOf(before.scene, before.volumes.meshes);
  const gpu_scene::GpuScene scene(probeDevice(), now.scene, now.volumes, gpu_scene::GridLayout::Paths, &pose);
  const StorePtr store = makeStore(fineCells(), now);
  render::EstimatorOptions options = withoutLightSamples(byPaths()).estimator;
  options.guide = render::GuidePlan{.settings = fineCells(), .store = store, .before = before.scene.camera};
  const auto estimator = render::makeEstimator(probeDevice(), scene, now.volumes, options);
  for (std::uint32_t round = 0; round < 64; ++round) {
    estimator->run(allPixels(), {0, 1}, round);
  }
  EXPECT_EQ(estimator->guiding()->totals().states, 0u);
  estimator->run(allPixels(), {1, 1}, 64);
  EXPECT_GT(estimator->guiding()->totals().states, kEdge * kEdge / 16);
}

} // namespace
} // namespace tyndall::test

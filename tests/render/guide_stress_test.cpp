// SPDX-License-Identifier: Apache-2.0
// Stores that are driven far: round counters that wrap, very many rounds, and frames that leap in time.
#include "gpu_scene/motion.h"
#include "guide_fixture.h"
#include "support/probe.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tyndall::test {
namespace {

using scene::Integrator;

constexpr double kLampHeight = 0.6;
constexpr double kRadius = 0.1;

/// A floor under a ball that shines, of one event: targets are means of points of the ball.
PathScene floorUnder(const glm::dvec3& lamp, std::uint32_t size) {
  PathScene test({size, size});
  test.depth(1);
  test.perspective({0.0, 1.5, 2.0}, {0.0, 0.0, 0.0}, 30.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 50.0);
  test.quad("white", {-1.0, 0.0, 1.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, -2.0});
  test.ball("lamp", lamp, kRadius);
  return test;
}

std::vector<std::uint32_t> pixelsOf(const PathScene& test) {
  std::vector<std::uint32_t> pixels;
  const std::uint32_t width = test.scene.film.size.x;
  for (std::uint32_t i = 0; i < width * test.scene.film.size.y; ++i) {
    pixels.push_back(i % width | i / width << 16);
  }
  return pixels;
}

/// A picture's scene on the device with an estimator, which lives as long.
class Learner {
public:
  Learner(const PathScene& test, const StorePtr& store, const scene::GuideSettings& settings,
          const PathScene* before = nullptr, double time = 0.0, double frameTime = 1.0)
      : volumes_(test.volumes), pixels_(pixelsOf(test)) {
    if (before != nullptr) {
      pose_ = gpu_scene::poseOf(before->scene, before->volumes.meshes);
    }
    scene_ = std::make_unique<gpu_scene::GpuScene>(probeDevice(), test.scene, volumes_, gpu_scene::GridLayout::Paths,
                                                   before != nullptr ? &pose_ : nullptr);
    render::EstimatorOptions options = withoutLightSamples(guidedBy(store, settings)).estimator;
    options.guide->deterministic = true;
    options.guide->time = time;
    options.guide->frameTime = frameTime;
    estimator_ = render::makeEstimator(probeDevice(), *scene_, volumes_, options);
  }

  /// Each takes a sample of each pixel.
  void rounds(std::uint32_t count) {
    for (std::uint32_t done = 0; done < count; done += kAtOnce) {
      estimator_->run(pixels_, {0, std::min(kAtOnce, count - done)}, done);
    }
  }
  std::uint64_t unsound() const { return estimator_->guiding()->report().totals.unsound; }

private:
  static constexpr std::uint32_t kAtOnce = 16;

  gpu_scene::VolumeSet volumes_;
  std::vector<std::uint32_t> pixels_;
  gpu_scene::Pose pose_;
  std::unique_ptr<gpu_scene::GpuScene> scene_;
  std::unique_ptr<render::Estimator> estimator_;
};

/// Farthest target from the lamp's middle.
double farthest(const std::vector<interop::ChainState>& states, const glm::dvec3& lamp) {
  double worst = 0.0;
  for (const interop::ChainState& state : states) {
    worst = std::max(worst, glm::length(glm::dvec3(state.target) - lamp));
  }
  return worst;
}

/// What a store holds after some rounds from `first` on; stamps count from there.
guide::StoreContent learntFrom(std::uint32_t first, Learner& learner, guide::Store& store) {
  store.clear();
  guide::StoreContent content = store.content();
  content.round = first;
  store.restore(content);
  learner.rounds(48);
  content = store.content();
  for (std::size_t i = 0; i < content.cells.size(); i += sizeof(interop::GuideCell)) {
    interop::GuideCell cell;
    std::memcpy(&cell, &content.cells[i], sizeof(cell));
    cell.stamp = cell.fingerprint == 0 ? 0 : cell.stamp - first;
    std::memcpy(&content.cells[i], &cell, sizeof(cell));
  }
  return content;
}

/// Ages are differences: across the counter's end the store learns the same bits. Seen to fail where the cell of the
/// smallest stamp gives way.
TEST(GuideStress, RoundsGoOnAcrossTheEndOfTheirCounter) {
  const PathScene test = floorUnder({0.0, kLampHeight, 0.0}, 8);
  scene::GuideSettings settings = scene::guideSettings(Integrator::Mcpg);
  settings.slots = 16; // so few that the oldest cells give way, which stamps decide
  const StorePtr store = makeStore(settings, test);
  Learner learner(test, store, settings);
  const guide::StoreContent plain = learntFrom(0, learner, *store);
  const guide::StoreContent wrapped = learntFrom(0xffffffffu - 23u, learner, *store);
  EXPECT_EQ(wrapped.round, 24u);
  EXPECT_TRUE(wrapped.cells == plain.cells);
  EXPECT_TRUE(wrapped.states == plain.states);
}

/// Round after round on a few pixels: targets stay on the lamp, whose points they are means of, and nothing overflows.
/// The same bound refuses the place beside it.
TEST(GuideStress, VeryManyRoundsDoNotDrift) {
  const glm::dvec3 lamp(0.0, kLampHeight, 0.0);
  const PathScene test = floorUnder(lamp, 4);
  const scene::GuideSettings settings = scene::guideSettings(Integrator::Mcpg);
  const StorePtr store = makeStore(settings, test);
  Learner learner(test, store, settings);
  learner.rounds(effort() > 1 ? 100000 : 1000);
  const std::vector<interop::ChainState> states = statesOf(*store);
  EXPECT_GT(states.size(), 20u);
  EXPECT_EQ(store->occupancy().unsound, 0u);
  EXPECT_EQ(learner.unsound(), 0u);
  fmt::print("{} states, the farthest {:.4g} from the lamp's middle\n", states.size(), farthest(states, lamp));
  EXPECT_LT(farthest(states, lamp), kRadius * 1.0001);
  EXPECT_GT(farthest(states, lamp + glm::dvec3(kRadius)), kRadius * 1.0001) << "the planted place was not seen";
}

/// Two lamps on either side of the floor, moving along it by a step a frame.
constexpr double kStep = 0.05;
constexpr double kFrameTime = 1.0 / 24.0;
constexpr double kSide = 0.8;

PathScene lampsAfter(int steps) {
  const double z = -0.1 + kStep * steps;
  PathScene test = floorUnder({-kSide, 0.3, z}, 16);
  test.ball("lamp", {kSide, 0.3, z}, kRadius);
  return test;
}

/// Farthest that a target lies from the rectangle between the lamps' paths: a state that serves both lamps aims at a mean
/// of points on the two.
double farthestFromPaths(const std::vector<interop::ChainState>& states, int steps) {
  double worst = 0.0;
  for (const interop::ChainState& state : states) {
    const glm::dvec3 target(state.target);
    const double x = std::clamp(target.x, -kSide, kSide);
    const double z = std::clamp(target.z, -0.1, -0.1 + kStep * steps);
    worst = std::max(worst, glm::length(target - glm::dvec3(x, 0.3, z)));
  }
  return worst;
}

/// Frames 2 and 100000: a target moves ahead once a frame, for `most_time` at most. Seen to fail where that is a
/// million seconds.
TEST(GuideStress, LeapsInTimeDoNotThrowTargetsAway) {
  scene::GuideSettings settings = scene::guideSettings(Integrator::Mcpg);
  const StorePtr store = makeStore(settings, lampsAfter(0));
  const int frames[] = {2, 100000};
  for (int i = 0; i < 2; ++i) {
    const PathScene before = lampsAfter(i - 1);
    Learner learner(lampsAfter(i), store, settings, &before, frames[i] * kFrameTime, kFrameTime);
    learner.rounds(32);
    EXPECT_EQ(learner.unsound(), 0u);
  }
  EXPECT_EQ(store->occupancy().unsound, 0u);
  const std::vector<interop::ChainState> states = statesOf(*store);
  EXPECT_GT(states.size(), 100u);
  const double ahead = kStep / kFrameTime * settings.mostTime;
  fmt::print("{} states, the farthest {:.4g} from the lamps' paths\n", states.size(), farthestFromPaths(states, 1));
  EXPECT_LT(farthestFromPaths(states, 1), kRadius + 2.0 * ahead);
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// What chains learn: where light is, for surfaces and media alike, at any scale, and never a number that is none.
#include "guide_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tyndall::test {
namespace {

using scene::Integrator;

const scene::GuideSettings kMcpg = scene::guideSettings(Integrator::Mcpg);

/// Lamps are squares that shine down from just below the ceiling.
constexpr double kLampHeight = 0.95;
constexpr double kLampHalf = 0.15;
constexpr double kWideLamp = 0.4; ///< half, where unguided paths must find it often enough to tell their noise
constexpr double kFloor = -1.0;

void hangLamp(PathScene& test, const std::string& material, double x, double half = kLampHalf, double scale = 1.0) {
  const double edge = 2.0 * half * scale;
  test.quad(material, glm::dvec3(x - half, kLampHeight, -half) * scale, {edge, 0.0, 0.0}, {0.0, 0.0, edge});
}

/// A closed box whose camera sees the floor alone; one event.
PathScene room() {
  PathScene test({16, 16});
  test.depth(1);
  test.perspective({0.0, 0.5, 0.5}, {0.0, kFloor, -0.1}, 30.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.crate("white", glm::dvec3(-1.0), glm::dvec3(1.0));
  return test;
}

PathScene roomWithLamp(double x) {
  PathScene test = room();
  test.lamp("lamp", 5.0);
  hangLamp(test, "lamp", x);
  return test;
}

bool onLamp(const interop::ChainState& state, double x) {
  constexpr double kRounding = 1e-4;
  const glm::dvec3 target(state.target);
  return std::abs(target.x - x) <= kLampHalf + kRounding && std::abs(target.z) <= kLampHalf + kRounding &&
         std::abs(target.y - kLampHeight) <= kRounding;
}

double shareOnLamp(const std::vector<interop::ChainState>& states, double x) {
  const auto count = std::count_if(states.begin(), states.end(), [&](const auto& state) { return onLamp(state, x); });
  return double(count) / double(std::max<std::size_t>(states.size(), 1));
}

/// Mean of 1 - cos that states of many samples have.
double meanSpread(const std::vector<interop::ChainState>& states) {
  constexpr float kMany = 16.0f;
  double sum = 0.0;
  double count = 0.0;
  for (const interop::ChainState& state : states) {
    if (state.evidence >= kMany) {
      sum += double(state.spread);
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : -1.0;
}

/// That of directions from below the lamp to points that are spread evenly over it.
double lampSpread() {
  constexpr int kPoints = 64;
  double sum = 0.0;
  for (int i = 0; i < kPoints * kPoints; ++i) {
    const double x = kLampHalf * (2.0 * (i % kPoints + 0.5) / kPoints - 1.0);
    const double z = kLampHalf * (2.0 * (i / kPoints + 0.5) / kPoints - 1.0);
    const double height = kLampHeight - kFloor;
    sum += 1.0 - height / std::sqrt(x * x + z * z + height * height);
  }
  return sum / (kPoints * kPoints);
}

scene::GuideSettings frozen() {
  scene::GuideSettings settings = kMcpg;
  settings.learn = false;
  return settings;
}

MomentOptions many(std::uint32_t firstSeed, std::uint32_t samples = 16) {
  return {.replicates = 16, .samples = samples, .firstSeed = firstSeed};
}

Noise unguidedNoise(const PathScene& test) { return noiseOf(render(test, withoutLightSamples(byPaths(many(1, 32))))); }

Noise frozenNoise(const PathScene& test, const StorePtr& store) {
  return noiseOf(render(test, withoutLightSamples(guidedBy(store, frozen(), many(1001, 32)))));
}

/// All targets are means of points of the one lamp, hence on it; lobes are about as wide as it is, and noise falls.
/// They are narrower rather than wider: a chain's first sample, drawn by scattering, has by far its largest score. The
/// same checks refuse another lamp's place and a store without sense.
TEST(GuideChains, AimAtTheLamp) {
  const PathScene test = roomWithLamp(0.4);
  const StorePtr store = makeStore(kMcpg, test);
  learn(test, store, kMcpg, false, 24);
  const std::vector<interop::ChainState> states = statesOf(*store);
  EXPECT_GT(states.size(), 200u);
  EXPECT_EQ(shareOnLamp(states, 0.4), 1.0);
  EXPECT_LT(shareOnLamp(states, 0.05), 0.5) << "the planted place was not seen";
  const double width = meanSpread(states) / lampSpread();
  EXPECT_GT(width, 0.25);
  EXPECT_LT(width, 1.5);
  const Noise unguided = unguidedNoise(test);
  const Ratio gain = ratioOf(frozenNoise(test, store), unguided);
  EXPECT_LT(gain.high, 0.5) << gain.text();
  fillWithGarbage(*store, 3);
  EXPECT_FALSE(meanSpread(statesOf(*store)) / lampSpread() < 1.5) << "the planted garbage was not seen";
  const Ratio spoilt = ratioOf(frozenNoise(test, store), unguided);
  EXPECT_GT(spoilt.high, 0.5) << "the planted garbage was not seen: " << spoilt.text();
  fmt::print("{} states, width {:.3g} of the lamp's, noise {}, with garbage {}\n", states.size(), width, gain.text(),
             spoilt.text());
}

/// Two lamps, one ten times as bright: both are known, the bright one better. Chains that jump between them have
/// targets in the middle.
TEST(GuideChains, KnowBothOfTwoLamps) {
  PathScene test = room();
  test.lamp("bright", 10.0);
  test.lamp("dim", 1.0);
  hangLamp(test, "bright", 0.6);
  hangLamp(test, "dim", -0.6);
  const StorePtr store = makeStore(kMcpg, test);
  learn(test, store, kMcpg);
  const std::vector<interop::ChainState> states = statesOf(*store);
  const double bright = shareOnLamp(states, 0.6);
  const double dim = shareOnLamp(states, -0.6);
  fmt::print("shares: bright {:.3f}, dim {:.3f}, between {:.3f}\n", bright, dim, 1.0 - bright - dim);
  EXPECT_GT(bright, 0.5);
  EXPECT_GT(dim, 0.002);
  EXPECT_LT(dim, bright);
  const StorePtr alone = makeStore(kMcpg, test);
  const PathScene one = roomWithLamp(0.6);
  learn(one, alone, kMcpg);
  EXPECT_LT(shareOnLamp(statesOf(*alone), -0.6), 0.002) << "the planted lack of a lamp was not seen";
}

/// Fog lies on a floor; what does not scatter is black.
PathScene foggyFloor(double floorColour, double fogAlbedo) {
  PathScene test({16, 16});
  test.depth(1);
  test.perspective({0.0, 0.4, 2.5}, {0.0, -0.9, 0.0}, 30.0);
  test.material("floor", MaterialId::Diffuse, floorColour);
  test.lamp("lamp", 5.0);
  test.quad("floor", {-2.0, kFloor, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0});
  hangLamp(test, "lamp", 0.0, kWideLamp);
  test.box({-2.0, kFloor, -2.0}, {2.0, -0.8, 2.0}, 3.0, fogAlbedo);
  return test;
}

/// One store: what surfaces have learnt serves media, and the reverse. An empty store does not.
TEST(GuideChains, ServeSurfacesAndMediaAlike) {
  if (effort() == 1) {
    GTEST_SKIP() << "long version only";
  }
  const PathScene floor = foggyFloor(0.7, 0.0);
  const PathScene fog = foggyFloor(0.0, 0.9);
  const StorePtr ofFloor = makeStore(kMcpg, floor);
  const StorePtr ofFog = makeStore(kMcpg, fog);
  learn(floor, ofFloor, kMcpg);
  learn(fog, ofFog, kMcpg);
  const Noise unguidedFog = unguidedNoise(fog);
  const Ratio media = ratioOf(frozenNoise(fog, ofFloor), unguidedFog);
  const Ratio surfaces = ratioOf(frozenNoise(floor, ofFog), unguidedNoise(floor));
  const Ratio nothing = ratioOf(frozenNoise(fog, makeStore(kMcpg, fog)), unguidedFog);
  fmt::print("noise of media by surfaces' chains {}, of surfaces by media's {}, by none {}\n", media.text(),
             surfaces.text(), nothing.text());
  EXPECT_LT(media.high, 0.7);
  EXPECT_LT(surfaces.high, 0.7);
  EXPECT_GT(nothing.high, 0.7) << "the planted lack of chains was not seen";
}

PathScene scaledRoom(double scale) {
  PathScene test({16, 16});
  test.depth(2);
  test.perspective(glm::dvec3(0.0, 0.5, 0.5) * scale, glm::dvec3(0.0, kFloor, -0.1) * scale, 30.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 5.0);
  test.crate("white", glm::dvec3(-scale), glm::dvec3(scale));
  hangLamp(test, "lamp", 0.3, kWideLamp, scale);
  test.box(glm::dvec3(-0.9 * scale), glm::dvec3(0.9 * scale), 0.3 / scale, 0.9);
  return test;
}

Noise learningNoise(double scale, double unit, std::uint32_t seed) {
  const PathScene test = scaledRoom(scale);
  scene::GuideSettings settings = kMcpg;
  settings.unit = unit;
  const StorePtr store = makeStore(settings, test);
  return noiseOf(render(test, withoutLightSamples(guidedBy(store, settings, many(seed)))));
}

/// Nothing is in absolute lengths: noise is the same at any scale. A unit of a fixed length is seen.
TEST(GuideChains, DoNotKnowTheScale) {
  if (effort() == 1) {
    GTEST_SKIP() << "long version only";
  }
  const Noise plain = learningNoise(1.0, 0.0, 1);
  for (const double scale : {1e-4, 1e6}) {
    const Ratio ratio = ratioOf(learningNoise(scale, 0.0, 1001), plain);
    fmt::print("noise at scale {}: {}\n", scale, ratio.text());
    EXPECT_LT(ratio.low, 1.0) << scale;
    EXPECT_GT(ratio.high, 1.0) << scale;
  }
  const Ratio wrong = ratioOf(learningNoise(1e-4, 0.003, 2001), plain);
  fmt::print("with a fixed unit: {}\n", wrong.text());
  EXPECT_GT(wrong.low, 1.0) << "the planted length was not seen";
}

/// Lamps of 24 decades, and a store of 16 cells that every vertex fights for: sound states, the same picture.
class GuideLimits : public testing::TestWithParam<Integrator> {};

TEST_P(GuideLimits, HugeAndTinyLightInATinyStore) {
  scene::GuideSettings settings = scene::guideSettings(GetParam());
  settings.slots = 16; // a thousandth of what such a picture is given
  PathScene test = room();
  test.depth(3);
  test.lamp("huge", 1e12);
  test.lamp("tiny", 1e-12);
  hangLamp(test, "huge", 0.6);
  hangLamp(test, "tiny", -0.6);
  const StorePtr store = makeStore(settings, test);
  EXPECT_EQ(store->size().cells, 16u);
  const Moments guided = render(test, guidedBy(store, settings, many(1001)));
  const guide::Occupancy full = store->occupancy();
  EXPECT_GT(full.states, 0u);
  EXPECT_EQ(full.unsound, 0u);
  const Verdict verdict = channelTest(guided, render(test, byPaths(many(1))));
  EXPECT_AGREES(verdict);
  fmt::print("{} states; {}\n", full.states, verdict.text());
  if (GetParam() == Integrator::Mcpg && effort() > 1) { // the fast version sees it in GuideUnbiasedChecks
    const MomentOptions wrong = withBug(guidedBy(store, settings, many(2001)), interop::kBugScatterShare);
    EXPECT_DIFFERS(channelTest(render(test, wrong), guided));
  }
  fillWithGarbage(*store, 5);
  EXPECT_GT(store->occupancy().unsound, 0u) << "the planted numbers were not seen";
}

INSTANTIATE_TEST_SUITE_P(Integrators, GuideLimits, testing::Values(Integrator::McpgPaper, Integrator::Mcpg),
                         [](const testing::TestParamInfo<Integrator>& tested) {
                           return tested.param == Integrator::Mcpg ? "Mcpg" : "McpgPaper";
                         });

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// Guided distances on camera rays: they change no mean, they lower the noise where light is far down a ray, and chains
// are found where a camera that has moved sees them.
#include "guide/store_file.h"
#include "guide_fixture.h"
#include "render/distance_frames.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace tyndall::test {
namespace {

using scene::Integrator;

PathScene view() {
  PathScene test({16, 16});
  test.depth(1);
  test.perspective({0.4, 0.9, 4.0}, {0.0, 0.1, 0.0}, 36.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 3.0);
  test.quad("lamp", {-0.9, 1.6, -0.7}, {1.2, 0.0, 0.0}, {0.0, 0.0, 1.2});
  return test;
}

void wallBehind(PathScene& test) {
  test.quad("white", {-1.0, -2.0, -1.5}, {2.0, 0.0, 0.0}, {0.0, 3.0, 0.0}); // the sky is seen beside it
}

/// Two homogeneous media that overlap, beside a wall and the sky; a point that rays are aimed at.
PathScene mist() {
  PathScene test = view();
  test.constant(0.2);
  wallBehind(test);
  test.point({0.6, 0.2, 0.4}, 0.5);
  test.box({-1.5, -1.2, -1.0}, {1.5, 1.2, 1.0}, 0.6, 0.9).phase = henyeyGreenstein(0.5);
  test.sphere({0.5, -0.3, 0.2}, 0.6, 0.8, 0.7);
  return test;
}

/// A grid in thin mist, whose densities the majorants of bricks overstate.
PathScene smoke() {
  PathScene test = view();
  test.constant(0.2);
  wallBehind(test);
  test.box({-1.5, -1.2, -1.0}, {1.5, 1.2, 1.0}, 0.1, 0.9);
  test.grid(puffGrid(), 2.0, 0.9).phase = henyeyGreenstein(0.4);
  return test;
}

/// Boundaries that bend nothing, so that a camera ray has several parts.
PathScene boxOfMist() {
  PathScene test = view();
  wallBehind(test);
  test.material("none", MaterialId::Null);
  test.crate("none", {-1.0, -0.8, -0.6}, {1.0, 0.8, 0.8});
  test.fill(0.8, 0.9);
  return test;
}

/// Any number of events, in a medium and between surfaces.
PathScene foggyRoom() {
  PathScene test = view();
  test.depth(16);
  wallBehind(test);
  test.quad("white", {-4.0, -1.0, 3.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -6.0});
  test.box({-2.0, -1.0, -1.5}, {2.0, 1.4, 1.5}, 0.4, 0.9).phase = henyeyGreenstein(0.6);
  return test;
}

struct Way {
  Integrator integrator;
  bool garbage; ///< chains without sense that are read alone; else ones that learn
};

/// 16 times the replicates in the long version.
MomentOptions base(std::uint32_t firstSeed) { return {.replicates = 16, .samples = 16, .firstSeed = firstSeed}; }

scene::GuideSettings settingsOf(Integrator integrator) {
  scene::GuideSettings settings = scene::guideSettings(integrator);
  settings.distanceShare = 0.6;
  settings.distanceWidth = 6.0; // of a small picture
  settings.distanceSigma = 30.0;
  return settings;
}

Moments guided(const PathScene& test, const Way& way, std::uint32_t bug = interop::kBugNone) {
  scene::GuideSettings settings = settingsOf(way.integrator);
  const StorePtr store = makeStore(settings, test);
  if (way.garbage) {
    fillWithGarbage(*store, 7);
    settings.learn = false;
  }
  const Moments moments = render(test, withBug(guidedBy(store, settings, base(5001)), bug));
  EXPECT_GT(store->occupancy().distances, 0u);
  EXPECT_TRUE(way.garbage || store->occupancy().unsound == 0u);
  return moments;
}

/// Without guiding; made once for each scene.
const Moments& referenceOf(PathScene (*scene)()) {
  static std::map<PathScene (*)(), Moments> references;
  const auto known = references.find(scene);
  return known != references.end() ? known->second
                                   : references.emplace(scene, render(scene(), byPaths(base(1)))).first->second;
}

struct Case {
  const char* name;
  PathScene (*scene)();
  std::vector<Way> fast;
};

const std::vector<Way> kWays{
    {Integrator::Mcpg, true}, {Integrator::Mcpg, false}, {Integrator::McpgPaper, true}, {Integrator::McpgPaper, false}};

class GuideDistance : public testing::TestWithParam<Case> {};

/// Means of tiles and of the picture, and of what is seen behind the media, whatever chains say. The fast version takes
/// a few ways, the long one all.
TEST_P(GuideDistance, ChangesNoMean) {
  const std::vector<Way> ways = effort() > 1 ? kWays : GetParam().fast;
  if (ways.empty()) {
    GTEST_SKIP() << "long version only";
  }
  const PathScene test = GetParam().scene();
  const Moments reference = referenceOf(GetParam().scene);
  for (const Way& way : ways) {
    const Moments moments = guided(test, way);
    const Verdict whole = channelTest(moments, reference);
    const std::string name =
        fmt::format("{}, {}", integratorName(way.integrator), way.garbage ? "garbage" : "learning");
    EXPECT_AGREES(tileTest(moments, reference)) << name;
    EXPECT_AGREES(whole) << name;
    EXPECT_AGREES(channelTest(moments, reference, 3)) << name << ", transmittance";
    fmt::print("{}: {:+.3f} % +- {:.3f} %\n", name, 100.0 * whole.bias, 100.0 * whole.resolution);
    std::fflush(stdout);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, GuideDistance,
                         testing::Values(Case{"Mist", mist, {kWays[1], kWays[2]}}, Case{"Smoke", smoke, {kWays[1]}},
                                         Case{"BoxOfMist", boxOfMist, {}}, Case{"FoggyRoom", foggyRoom, {}}),
                         [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

TEST(GuideDistanceChecks, CollisionsWithoutTheirWeightAreSeen) {
  const Way fixedShare{Integrator::McpgPaper, false};
  EXPECT_DIFFERS(channelTest(guided(mist(), fixedShare, interop::kBugDistanceWeight), referenceOf(mist)));
}

/// A narrow beam across the far end of thin fog, which fills the picture.
PathScene searchlight() {
  PathScene test({16, 16});
  test.depth(1);
  test.perspective({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 0.8);
  scene::SpotLight spot;
  spot.position = {-6.0, 0.0, -40.0};
  spot.direction = {1.0, 0.0, 0.0};
  spot.outerAngle = 4.0;
  spot.innerAngle = 3.0;
  spot.intensity = glm::dvec3(100.0);
  test.spot(spot);
  test.box({-20.0, -20.0, -60.0}, {20.0, 20.0, 0.0}, 0.02, 0.9);
  return test;
}

Moments beam(const PathScene& test, const StorePtr& store, const scene::GuideSettings& settings) {
  MomentOptions options = guidedBy(store, settings, base(1001));
  options.estimator.aim = false; // rays that are aimed at the lamp seldom find its cone
  return render(test, options);
}

/// Chains lower the noise of a beam, that of learning included, and do not change its mean. Planted: no chains.
TEST(GuideDistanceChecks, ChainsLowerTheNoiseOfABeam) {
  const PathScene test = searchlight();
  scene::GuideSettings settings = settingsOf(Integrator::Mcpg);
  const Moments learnt = beam(test, makeStore(settings, test), settings);
  const StorePtr empty = makeStore(settings, test);
  settings.learn = false;
  const Moments planted = beam(test, empty, settings);
  const Ratio ratio = ratioOf(noiseOf(learnt), noiseOf(planted));
  const Verdict means = channelTest(learnt, planted);
  fmt::print("noise over that without chains {}, means {}\n", ratio.text(), means.text());
  EXPECT_AGREES(means);
  EXPECT_LT(ratio.high, 0.5);
}

/// Saved chains come back, and what is learnt of their share. Seen to fail where the shares were not written.
TEST(DistanceFrames, StoreFileHoldsThem) {
  guide::StoreContent content;
  content.size = {.distanceColumns = 3, .distanceRows = 2, .distanceStates = 5};
  content.distances.resize(30 * sizeof(interop::DistanceState), std::byte(7));
  content.distanceShares.resize(6 * sizeof(interop::DistanceShare), std::byte(9));
  const guide::StoreContent read = guide::unpackStore(guide::packStore(content));
  EXPECT_TRUE(read.size == content.size);
  EXPECT_EQ(read.distances, content.distances);
  EXPECT_EQ(read.distanceShares, content.distanceShares);
}

/// A chain in the middle of a picture is as far away as the camera has left it, at the vertex that sees the place.
/// Planted: a camera that is not told of.
TEST(DistanceFrames, ChainsStayWhereTheyAreInTheWorld) {
  constexpr double kWidth = 25.0;
  const glm::uvec2 picture(100, 100);
  scene::GuideSettings settings = settingsOf(Integrator::Mcpg);
  settings.distanceWidth = kWidth;
  const guide::StoreSize size = guide::storeSize(settings, picture, 1e9);
  scene::Camera before;
  before.position = {0.0, 0.0, 10.0};
  before.target = {0.0, 0.0, 0.0};
  before.verticalFov = 90.0;
  std::vector<interop::DistanceState> states(size.distanceVertices() * size.distanceStates);
  const std::size_t middle = (2 * size.distanceColumns + 2) * size.distanceStates; // 50 of 100 pixels
  states[middle] = {1.0f, 8.0f, 0.25f, 7.0f};
  scene::Camera nearer = before;
  nearer.position.z = 7.0;
  const auto approached = render::movedDistances(states, size, kWidth, {before, nearer, picture});
  EXPECT_NEAR(approached[middle].mean, 5.0f, 1e-4f);
  EXPECT_EQ(approached[middle].variance, 0.25f);
  scene::Camera aside = before; // at a distance of 8 a vertex is 4 wide
  aside.position.x = aside.target.x = 4.0;
  const auto shifted = render::movedDistances(states, size, kWidth, {before, aside, picture});
  EXPECT_NEAR(shifted[middle - size.distanceStates].mean, std::sqrt(80.0f), 1e-3f);
  EXPECT_EQ(shifted[middle].weight, 0.0f);
  const auto planted = render::movedDistances(states, size, kWidth, {before, before, picture});
  EXPECT_NEAR(planted[middle].mean, 8.0f, 1e-4f);
}

} // namespace
} // namespace tyndall::test

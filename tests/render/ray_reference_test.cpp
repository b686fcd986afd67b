// SPDX-License-Identifier: Apache-2.0
// References along rays against the slow oracle, closed forms and themselves.
#include "base/error.h"
#include "support/ray_reference.h"
#include "support/ray_sets.h"
#include "support/render_scenes.h"
#include "volume/depth.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kSeed = 7;

volume::BrickGrid spikes() { return spikyGrid({30, 21, 26}, 3, volume::Storage::Float, glm::dmat4(1.0)); }

/// Largest |a - b| relative to the larger of |b| and `floor`.
double worst(const std::vector<double>& a, const std::vector<double>& b, double floor) {
  double result = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    result = std::max(result, std::abs(a[i] - b[i]) / std::max(std::abs(b[i]), floor));
  }
  return result;
}

std::vector<double> slowDepths(const volume::BrickGrid& grid, const std::vector<OracleRay>& rays, double tMax) {
  std::vector<double> depths;
  for (const OracleRay& ray : rays) {
    depths.push_back(volume::exactOpticalDepth(grid, ray.origin, ray.direction, 0.0, tMax));
  }
  return depths;
}

TEST(RayDepths, AgreeWithTheOtherWalkOnEveryKindOfRay) {
  const volume::BrickGrid grid = spikes();
  volume::BrickGrid shifted = grid;
  shifted.worldFromIndex = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 1e-4, 0.0)); // planted
  for (const RayKind kind : kRayKinds) {
    SCOPED_TRACE(rayKindName(kind));
    const RaySet set = rays(kind, 400, kSeed, grid.indexBounds());
    const std::vector<double> all = opticalDepths(grid, glm::dmat4(1.0), set.exact);
    const std::vector<double> some = opticalDepths(grid, glm::dmat4(1.0), set.exact, std::vector<double>(400, 7.25));
    EXPECT_LT(worst(all, slowDepths(grid, set.exact, std::numeric_limits<double>::infinity()), 0.01), 1e-10);
    EXPECT_LT(worst(some, slowDepths(grid, set.exact, 7.25), 0.01), 1e-10);
    if (kind != RayKind::Missing) {
      EXPECT_GT(worst(all, slowDepths(shifted, set.exact, std::numeric_limits<double>::infinity()), 0.01), 1e-10);
    }
  }
}

/// A linear field is its value in the middle times the length.
TEST(RayDepths, OfALinearFieldAreExact) {
  const auto field = [](const glm::dvec3& p) { return 3.0 + 0.25 * p.x - 0.125 * p.y + 0.0625 * p.z; };
  const glm::dmat4 map = affineMaps().back().worldFromIndex;
  const volume::BrickGrid grid =
      gridOf({19, 9, 24}, glm::ivec3(0), map, [&](const glm::ivec3& index) { return field(glm::dvec3(index)); });
  std::vector<OracleRay> chords;
  std::vector<double> lengths;
  std::vector<double> expected;
  const RaySet ends = rays(RayKind::FromInside, 400, kSeed, {glm::dvec3(0.0), {18.0, 8.0, 23.0}});
  for (std::size_t i = 0; i + 1 < ends.exact.size(); i += 2) {
    const glm::dvec3 a = ends.exact[i].origin;
    const glm::dvec3 b = ends.exact[i + 1].origin;
    const glm::dvec3 chord = glm::dmat3(map) * (b - a);
    chords.push_back({glm::dvec3(map * glm::dvec4(a, 1.0)), glm::normalize(chord)});
    lengths.push_back(glm::length(chord));
    expected.push_back(lengths.back() * field(0.5 * (a + b)));
  }
  EXPECT_LT(worst(opticalDepths(grid, map, chords, lengths), expected, 0.0), 1e-12);
  expected[17] *= 1.0 + 1e-11; // planted
  EXPECT_GT(worst(opticalDepths(grid, map, chords, lengths), expected, 0.0), 1e-12);
}

struct NamedScene {
  std::string name;
  TestScene test;
};

volume::BrickGrid blobs(const glm::dmat4& worldFromIndex, double phase, const glm::ivec3& size = {11, 9, 10}) {
  return gridOf(size, glm::ivec3(-4, 2, -3), worldFromIndex, [phase](const glm::ivec3& i) {
    const double wave = std::sin(1.1 * i.x + phase) * std::cos(0.9 * i.y) + std::sin(0.7 * i.z + 2.0 * phase);
    return std::max(0.0, wave);
  });
}

NamedScene blobUnderASun(const std::string& name, double density, const glm::dvec3& sun) {
  NamedScene scene{name, TestScene()};
  scene.test.sun(sun, 2.0);
  scene.test.grid(blobs(glm::dmat4(1.0), 0.3), density, 0.9).phase = henyeyGreenstein(0.3);
  return scene;
}

NamedScene pointInFog(const std::string& name, double fog, const glm::dvec3& light) {
  NamedScene scene{name, TestScene()};
  scene.test.point(light, 50.0);
  scene.test.grid(blobs(glm::dmat4(1.0), 0.3), 0.4, 0.9).phase = henyeyGreenstein(-0.4);
  scene.test.box({}, {}, fog, 0.7).shape = scene::MediumShape::Unbounded;
  return scene;
}

NamedScene overlappingGrids() {
  NamedScene scene{"overlapping grids", TestScene()};
  scene.test.sun({0.4, -1.0, -0.3}, 1.0);
  scene.test.point({8.0, 12.0, -9.0}, 30.0);
  scene.test.grid(blobs(affineMaps()[2].worldFromIndex, 0.3), 0.3, 0.9).phase = henyeyGreenstein(0.6);
  scene.test.grid(blobs(affineMaps().back().worldFromIndex, 1.9), 0.2, 0.5).phase = {PhaseId::Rayleigh, {}};
  scene.test.scene.media.back().worldFromMedium = glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, -2.0, 0.5));
  return scene;
}

NamedScene homogeneousMedia() {
  NamedScene scene{"box and sphere", TestScene()};
  scene.test.sun({0.2, -0.5, -1.0}, 1.0);
  scene.test.point({-1.0, 4.0, 5.0}, 20.0);
  scene.test.box({-4.0, 1.0, -3.0}, {3.0, 7.0, 4.0}, 0.2, 0.8).phase = henyeyGreenstein(0.5);
  scene.test.scene.media.back().worldFromMedium = affineMaps()[2].worldFromIndex;
  scene.test.sphere({2.0, 5.0, 2.0}, 4.0, 0.15, 0.6);
  scene.test.scene.media.back().worldFromMedium = affineMaps()[4].worldFromIndex; // an ellipsoid
  return scene;
}

std::vector<NamedScene> sceneKinds() {
  const glm::dvec3 slanted(0.4, -1.0, -0.3);
  return {blobUnderASun("thin", 0.02, slanted),
          blobUnderASun("normal", 0.5, slanted),
          blobUnderASun("dense", 20.0, slanted),
          blobUnderASun("sun along an axis", 0.5, {0.0, -1.0, 0.0}),
          pointInFog("point in thin fog beside a grid", 0.02, {6.0, 17.0, 3.0}),
          pointInFog("point in fog, in a grid", 0.4, {0.3, 6.2, 1.1}),
          overlappingGrids(),
          homogeneousMedia()};
}

/// Rays of all kinds that meet the media of sceneKinds(). The oracle does not see bounded homogeneous media from more
/// than 45 mean free paths away, and far rays are left out.
std::vector<OracleRay> fewRays() {
  std::vector<OracleRay> result;
  for (const RayKind kind : kRayKinds) {
    const std::size_t count = kind == RayKind::Far || kind == RayKind::Missing ? 0 : 2;
    const RaySet set = rays(kind, count, kSeed, {glm::dvec3(-4.0, 1.0, -4.0), {6.0, 10.0, 6.0}});
    result.insert(result.end(), set.exact.begin(), set.exact.end());
  }
  return result;
}

constexpr double kTolerance = 1e-6;

TEST(RayReference, AgreesWithTheOracle) {
  const std::vector<OracleRay> few = fewRays();
  for (const NamedScene& scene : sceneKinds()) {
    SCOPED_TRACE(scene.name);
    const OracleScene oracle(scene.test.scene, scene.test.volumes, {.relative = 1e-10});
    std::vector<double> expected;
    for (const OracleRay& ray : few) {
      expected.push_back(oracle.radiance(ray));
    }
    EXPECT_GT(std::count_if(expected.begin(), expected.end(), [](double v) { return v > 0.0; }), 10);
    const std::vector<double> found = singleScattering(scene.test.scene, scene.test.volumes, few);
    EXPECT_LT(worst(found, expected, 1e-12), kTolerance);
    TestScene planted = scene.test;
    auto& media = planted.scene.media;
    media.back().sigmaT *= 1.00001;
    media.back().densityScale *= 1.00001;
    EXPECT_GT(worst(singleScattering(planted.scene, planted.volumes, few), expected, 1e-12), kTolerance)
        << "extinction";
    media = scene.test.scene.media;
    media.back().phase = henyeyGreenstein(0.61);
    EXPECT_GT(worst(singleScattering(planted.scene, planted.volumes, few), expected, 1e-12), kTolerance) << "phase";
    media = scene.test.scene.media;
    media.front().worldFromMedium[3].y += 1e-3;
    EXPECT_GT(worst(singleScattering(planted.scene, planted.volumes, few), expected, 1e-12), kTolerance) << "place";
  }
}

/// A sun across the rays dims all of a ray alike: albedo p E exp(-sigma y) (1 - exp(-sigma x)).
TEST(RayReference, AgreesWithABoxUnderASun) {
  constexpr double kSigma = 0.7;
  TestScene test;
  test.sun({0.0, -1.0, 0.0}, 3.0);
  test.box({0.0, 0.0, 0.0}, {5.0, 2.0, 4.0}, kSigma, 0.8);
  std::vector<OracleRay> across;
  std::vector<double> expected;
  for (double y = 0.125; y < 2.0; y += 0.25) {
    across.push_back({{-3.0, y, 1.5}, {1.0, 0.0, 0.0}});
    const double dimmed = std::exp(-kSigma * (2.0 - y)) * (1.0 - std::exp(-kSigma * 5.0));
    expected.push_back(0.8 * 3.0 / (4.0 * std::numbers::pi) * dimmed);
  }
  EXPECT_LT(worst(singleScattering(test.scene, test.volumes, across), expected, 0.0), 1e-12);
  expected[3] *= 1.0 + 1e-11; // planted
  EXPECT_GT(worst(singleScattering(test.scene, test.volumes, across), expected, 0.0), 1e-12);
}

/// Twice the nodes on pieces half as long change nothing; pieces left rough do.
TEST(RayReference, HasConverged) {
  const RaySet set = rays(RayKind::Random, 100, kSeed, {glm::dvec3(-4.0, 1.0, -4.0), {6.0, 10.0, 6.0}});
  const RayReferenceSettings fine{.nodes = 12, .opticalDepth = 0.5, .angle = 0.1, .voxels = 1.0, .roughness = 1e-8};
  const RayReferenceSettings rough{.nodes = 2, .roughness = 1.0}; // planted
  for (const NamedScene& scene : sceneKinds()) {
    const std::vector<double> converged = singleScattering(scene.test.scene, scene.test.volumes, set.exact, fine);
    EXPECT_LT(worst(singleScattering(scene.test.scene, scene.test.volumes, set.exact), converged, 1e-12), kTolerance)
        << scene.name;
    EXPECT_GT(worst(singleScattering(scene.test.scene, scene.test.volumes, set.exact, rough), converged, 1e-12),
              kTolerance)
        << scene.name;
  }
}

/// Through nothing, distance does not matter.
TEST(RayReference, DoesNotDependOnTheDistance) {
  const RaySet set = rays(RayKind::Random, 40, kSeed, {glm::dvec3(-4.0, 1.0, -4.0), {6.0, 10.0, 6.0}});
  std::vector<OracleRay> near;
  std::vector<OracleRay> far;
  std::vector<OracleRay> planted;
  for (const OracleRay& ray : set.exact) {
    near.push_back({pointAt(ray, -50.0), ray.direction});
    far.push_back({pointAt(ray, -8000.0), ray.direction});
    planted.push_back({pointAt(ray, -8000.0) + glm::dvec3(0.0, 1e-4, 0.0), ray.direction});
  }
  for (const NamedScene& scene : {overlappingGrids(), homogeneousMedia()}) {
    const std::vector<double> expected = singleScattering(scene.test.scene, scene.test.volumes, near);
    EXPECT_LT(worst(singleScattering(scene.test.scene, scene.test.volumes, far), expected, 1e-12), kTolerance);
    EXPECT_GT(worst(singleScattering(scene.test.scene, scene.test.volumes, planted), expected, 1e-12), kTolerance);
  }
}

TEST(RayReference, RejectsWhatItDoesNotKnow) {
  TestScene disc;
  disc.sun({0.0, -1.0, 0.0}, 1.0, 0.5);
  EXPECT_THROW(singleScattering(disc.scene, disc.volumes, {}), Error);
  TestScene sky;
  sky.constant(1.0);
  EXPECT_THROW(singleScattering(sky.scene, sky.volumes, {}), Error);
  const std::vector<double> one{1.0};
  EXPECT_THROW(opticalDepths(spikes(), glm::dmat4(1.0), {}, one), Error);
}

} // namespace
} // namespace tyndall::test

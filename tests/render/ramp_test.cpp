// SPDX-License-Identifier: Apache-2.0
// Optical depth along rays: linear ramps under affine maps (docs/theory.md A4), regular tracking as the oracle on whole
// volumes (A7), sound majorants (A11).
#include "base/error.h"
#include "film/statistics.h"
#include "render/walk_probe.h"
#include "support/render_fixture.h"
#include "support/render_scenes.h"
#include "verify/oracle_radiance.h"
#include "volume/depth.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>

namespace tyndall::test {
namespace {

constexpr int kRampVoxels = 20;
constexpr glm::ivec3 kRampFirst{-3, 11, 5}; // an index-space offset that is no multiple of a brick
constexpr std::uint32_t kCollide = 0;
constexpr std::uint32_t kTransmit = 1;

struct Expected {
  std::vector<ProbeSegment> segments;
  std::vector<double> transmittance;
};

/// Bound on the probability that the mean of `count` values in [0, 1] of expectation `expected` is as far off as
/// `mean`: holds however skewed they are. @see [Hoeffding63] theorem 1
double hoeffdingP(double mean, double expected, double count) {
  const auto term = [](double x, double y) { return x > 0.0 ? x * std::log(x / y) : 0.0; };
  return std::min(1.0, 2.0 * std::exp(-count * (term(mean, expected) + term(1.0 - mean, 1.0 - expected))));
}

/// Estimates against exact values: every one, and the sum of all.
Verdict judge(const std::vector<SegmentEstimate>& estimates, const std::vector<double>& expected) {
  Verdict verdict;
  double smallest = 1.0;
  double sum = 0.0;
  double total = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const SegmentEstimate& estimate = estimates[i];
    const double rounding = 2e-5 * expected[i] + 1e-7;
    const double difference = estimate.transmittance - expected[i];
    const double reduced = std::copysign(std::max(0.0, std::abs(difference) - rounding), difference);
    sum += difference;
    total += expected[i];
    variance += estimate.standardError * estimate.standardError;
    const double p = reduced == 0.0 ? 1.0 : hoeffdingP(expected[i] + reduced, expected[i], estimate.walks);
    if (p <= smallest) {
      smallest = p;
      verdict.worst = i;
      verdict.worstT = difference / estimate.standardError;
      verdict.bias = difference / expected[i];
    }
  }
  const double excess = std::max(0.0, std::abs(sum) - 2e-6 * total) / std::sqrt(variance);
  verdict.resolution = std::sqrt(variance) / total;
  verdict.familyP =
      film::sidakFamilyP(std::min(smallest, film::normalTwoSidedP(excess)), double(estimates.size()) + 1.0);
  return verdict;
}

volume::BrickGrid ramp(int axis, const glm::dmat4& worldFromIndex) {
  return gridOf(glm::ivec3(kRampVoxels), kRampFirst, worldFromIndex,
                [axis](const glm::ivec3& index) { return 0.02 + 0.01 * (index[axis] - kRampFirst[axis]); });
}

/// Segments between random points within the voxel centres, with A4's closed form.
Expected rampSegments(int axis, const glm::dmat4& worldFromIndex, double densityScale) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0.0, kRampVoxels - 1.0);
  const auto point = [&] {
    return glm::dvec3(kRampFirst) + glm::dvec3(uniform(random), uniform(random), uniform(random));
  };
  const auto density = [&](const glm::dvec3& index) { return 0.02 + 0.01 * (index[axis] - kRampFirst[axis]); };
  Expected expected;
  for (int i = 0; i < 64; ++i) {
    const glm::dvec3 a = point();
    const glm::dvec3 b = point();
    const glm::dvec3 worldA(worldFromIndex * glm::dvec4(a, 1.0));
    const glm::dvec3 worldB(worldFromIndex * glm::dvec4(b, 1.0));
    const double length = glm::distance(worldA, worldB);
    expected.segments.push_back({worldA, (worldB - worldA) / length, length});
    expected.transmittance.push_back(std::exp(-densityScale * length * 0.5 * (density(a) + density(b))));
  }
  return expected;
}

TEST(LinearRamp, SegmentsHaveTheClosedFormUnderEveryMap) {
  for (const NamedMap& map : affineMaps()) {
    for (int axis = 0; axis < 3; ++axis) {
      TestScene test;
      test.grid(ramp(axis, map.worldFromIndex), 0.7);
      const Expected expected = rampSegments(axis, map.worldFromIndex, 0.7);
      const WalkReport report = WalkProbe(test).run(expected.segments, {.walks = 64 * effort()});
      EXPECT_AGREES(judge(report.segments, expected.transmittance)) << map.name << " axis " << axis;
      EXPECT_EQ(report.exceeded, 0.0) << map.name;
    }
  }
}

TEST(LinearRamp, HalfVoxelShiftIsSeen) {
  for (const NamedMap& map : affineMaps()) {
    TestScene test;
    test.grid(ramp(1, map.worldFromIndex), 0.7);
    const Expected expected = rampSegments(1, map.worldFromIndex, 0.7);
    const WalkProbe probe(test, {.plantedBug = interop::kBugHalfVoxel});
    EXPECT_DIFFERS(judge(probe.run(expected.segments, {}).segments, expected.transmittance)) << map.name;
  }
}

TEST(LinearRamp, TransmittancePictureUnderEveryMap) {
  for (const NamedMap& map : affineMaps()) {
    TestScene test({12, 12});
    const volume::BrickGrid grid = ramp(0, map.worldFromIndex);
    const Bounds3 bounds = grid.worldBounds();
    test.grid(grid, 0.5);
    test.perspective(bounds.centre() + glm::dvec3(0.7, 0.4, 1.5) * glm::length(bounds.size()), bounds.centre(), 30.0);
    const OracleScene oracle(test.scene, test.volumes);
    const auto reference = oracle.transmittancePicture(8);
    for (const MomentOptions& options : eachMethod({.replicates = 64})) {
      EXPECT_AGREES(
          imageTest(renderMoments(test.scene, test.volumes, options), meanOf(reference), kTransmittance, 1e-4))
          << map.name << nameOf(options);
      const MomentOptions bad = withBug(options, interop::kBugHalfVoxel);
      // The picture's mean sees half a voxel; its pixels do even where the mean does not change.
      EXPECT_DIFFERS(pixelTest(renderMoments(test.scene, test.volumes, bad), reference, kTransmittance, 1e-3))
          << map.name << nameOf(options);
    }
  }
}

/// Random segments through a grid, some that start inside and some that end inside.
std::vector<ProbeSegment> randomSegments(const volume::BrickGrid& grid, unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Bounds3 bounds = grid.worldBounds();
  const auto point = [&](double margin) {
    const glm::dvec3 u(uniform(random), uniform(random), uniform(random));
    return bounds.min + bounds.size() * ((1.0 + 2.0 * margin) * u - margin);
  };
  std::vector<ProbeSegment> segments;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 a = point(i % 3 == 0 ? 0.0 : 0.5);
    const glm::dvec3 b = point(0.0);
    const double length = glm::distance(a, b);
    segments.push_back({a, (b - a) / length, i % 4 == 0 ? length : 1e30});
  }
  return segments;
}

/// A7 on one grid, scaled to a median optical depth of `depth`.
void checkAgainstRegularTracking(const volume::BrickGrid& grid, double depth, const std::string& name) {
  SCOPED_TRACE(name);
  const double median = volume::medianOpticalDepth(grid, 200);
  ASSERT_GT(median, 0.0);
  TestScene test;
  test.grid(grid, depth / median);
  Expected expected{randomSegments(grid, 5, 1000), {}};
  for (const ProbeSegment& segment : expected.segments) {
    expected.transmittance.push_back(std::exp(
        -depth / median * volume::exactOpticalDepth(grid, segment.origin, segment.direction, 0.0, segment.tMax)));
  }
  for (const std::uint32_t mode : {kCollide, kTransmit}) {
    for (const bool delta : {false, true}) {
      if (mode == kTransmit && delta) {
        continue; // the same code
      }
      const WalkReport report =
          WalkProbe(test, {.deltaTracking = delta}).run(expected.segments, {.walks = 32 * effort(), .mode = mode});
      EXPECT_AGREES(judge(report.segments, expected.transmittance)) << "mode " << mode << " delta " << delta;
      EXPECT_EQ(report.exceeded, 0.0);
    }
  }
  const WalkProbe shifted(test, {.plantedBug = interop::kBugHalfVoxel});
  EXPECT_DIFFERS(judge(shifted.run(expected.segments, {.walks = 32}).segments, expected.transmittance));
}

TEST(RegularTracking, AgreesOnTheProjectsVolumes) {
  for (const char* name : {"volumes/cloud.vdb", "volumes/plume.vdb"}) {
    checkAgainstRegularTracking(volume::loadGrid(name, {}), 2.0, name);
  }
}

/// Any folder of .vdb files: every grid that a bare file's picture would use.
TEST(RegularTracking, AgreesOnTheUsersVolumes) {
  const char* folder = std::getenv("TYNDALL_TEST_VOLUMES");
  if (folder == nullptr) {
    GTEST_SKIP() << "set TYNDALL_TEST_VOLUMES to a folder of .vdb files";
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".vdb") {
      continue;
    }
    volume::BrickGrid grid;
    try {
      grid = volume::loadGrid(entry.path(), {});
    } catch (const Error& error) {
      std::cout << "left out: " << error.what() << '\n'; // nothing to render in it
      continue;
    }
    if (!grid.empty() && volume::medianOpticalDepth(grid, 200) > 0.0) {
      checkAgainstRegularTracking(grid, 2.0, entry.path().string());
    }
  }
}

/// Lookups above their majorant in walks through a grid of spikes.
double exceededIn(const volume::BrickGrid& grid, std::uint32_t bug, double& lookups) {
  TestScene test;
  test.grid(grid, 0.05);
  const WalkReport report =
      WalkProbe(test, {.deltaTracking = true, .plantedBug = bug})
          .run(randomSegments(grid, 9, 256), {.invocationsPerRay = 32, .walks = 64, .mode = kCollide});
  lookups = report.lookups;
  return report.exceeded;
}

TEST(Majorants, HoldForSpikesOnBrickBordersInEveryStorage) {
  double total = 0.0;
  for (const auto storage : {volume::Storage::Unorm8, volume::Storage::Half, volume::Storage::Float}) {
    for (const NamedMap& map : {affineMaps().front(), affineMaps().back()}) {
      const volume::BrickGrid grid = spikyGrid({45, 37, 41}, 3, storage, map.worldFromIndex);
      double lookups = 0.0;
      EXPECT_EQ(exceededIn(grid, interop::kBugNone, lookups), 0.0) << volume::storageName(storage) << map.name;
      total += lookups;
    }
  }
  EXPECT_GT(total, 1e6);
}

TEST(Majorants, WithoutTheSupportAreCaught) {
  volume::BrickGrid grid = spikyGrid({45, 37, 41}, 3, volume::Storage::Float, glm::dmat4(1.0));
  // The planted bug: maxima over a brick's own voxels only, without the layer that its lookups share with the next one.
  for (std::size_t b = 0; b < grid.bricks.size(); ++b) {
    const glm::ivec3 brick(int(b) % grid.brickCount.x, int(b) / grid.brickCount.x % grid.brickCount.y,
                           int(b) / (grid.brickCount.x * grid.brickCount.y));
    float own = 0.0f;
    for (int i = 0; i < volume::kBrickVoxels; ++i) {
      own = std::max(own, grid.voxel(grid.firstVoxel + 8 * brick + glm::ivec3(i & 7, i >> 3 & 7, i >> 6)));
    }
    grid.ranges[b].max = own;
  }
  double lookups = 0.0;
  EXPECT_GT(exceededIn(grid, interop::kBugNone, lookups), 100.0);
}

} // namespace
} // namespace tyndall::test

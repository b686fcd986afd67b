// SPDX-License-Identifier: Apache-2.0
// Free flight through grids (docs/theory.md A8b): Kolmogorov-Smirnov test of delta tracking's distances against
// sigma_t(t) T(t), and the share that leaves, with tight, loose and per-cell majorants.
#include "film/statistics.h"
#include "render/walk_probe.h"
#include "support/render_fixture.h"
#include "volume/depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tyndall::test {
namespace {

enum class Majorant { Tight, Loose, PerGrid };

/// A bell along z over several bricks, lowest 0; extinction 1 at its top.
volume::BrickGrid bell(Majorant majorant) {
  volume::BrickGrid grid = gridOf({16, 16, 60}, glm::ivec3(0), glm::dmat4(1.0), [](const glm::ivec3& index) {
    const double u = (index.z - 25.0) / 12.0;
    return index.z >= 44 ? 0.0 : std::exp(-u * u);
  });
  const float top = grid.maximum();
  for (volume::Range& range : grid.ranges) {
    range.max = majorant == Majorant::Loose ? 3.0f * range.max : majorant == Majorant::PerGrid ? top : range.max;
  }
  return grid;
}

constexpr double kThin = 1e-3;
/// The bell's majorant depth is less than this many times its depth, loose majorants included.
constexpr double kMajorantRatio = 10.0;

struct FlightResult {
  double distanceP = 1.0;   ///< Kolmogorov-Smirnov
  double leavingP = 1.0;    ///< of the number of collisions
  double collisions = 0.0;
};

/// Flies `walks` times along +z through a grid scaled to the optical depth `tau`. Below kThin the first draw is
/// conditioned on the few xi that can collide: else nearly all walks would say nothing.
FlightResult fly(const volume::BrickGrid& grid, double tau, double walks, std::uint32_t bug) {
  const ProbeSegment segment{{7.3, 6.6, -4.0}, {0.0, 0.0, 1.0}, 1e30};
  const double unit = volume::exactOpticalDepth(grid, segment.origin, segment.direction, 0.0, 1e30);
  TestScene test;
  test.grid(grid, tau / unit);
  const WalkProbe probe(test, {.deltaTracking = true, .plantedBug = bug});
  constexpr std::uint32_t kWalks = 256;
  const auto invocations = static_cast<std::uint32_t>(std::ceil(walks / kWalks));
  const double share = tau < kThin ? kMajorantRatio * tau : 1.0;
  const WalkReport report = probe.run({segment}, {.invocationsPerRay = invocations, .walks = kWalks, .mode = 0, .distances = true, .firstXi = static_cast<float>(share)});
  std::vector<double> distances;
  for (const float distance : report.distances) {
    if (distance >= 0.0f) {
      distances.push_back(double(distance));
    }
  }
  FlightResult result;
  result.collisions = double(distances.size());
  const double expected = -std::expm1(-tau) / share;
  const double n = double(report.distances.size());
  const double sigma = std::sqrt(std::max(n * expected * (1.0 - expected), 1.0));
  result.leavingP = film::normalTwoSidedP((result.collisions - n * expected) / sigma);
  // 20,000 are enough; more would see the rounding of float distances.
  distances.resize(std::min<std::size_t>(distances.size(), 20000));
  const auto cdf = [&](double t) {
    return std::expm1(-tau / unit * volume::exactOpticalDepth(grid, segment.origin, segment.direction, 0.0, t)) / std::expm1(-tau);
  };
  result.distanceP = distances.size() < 8 ? 1.0 : film::kolmogorovSmirnovTest(distances, cdf).p;
  return result;
}

TEST(FreeFlight, DistancesFollowTheirDensity) {
  for (const Majorant majorant : {Majorant::Tight, Majorant::Loose, Majorant::PerGrid}) {
    const volume::BrickGrid grid = bell(majorant);
    for (const double tau : {0.01, 0.3, 2.0, 10.0, 50.0}) {
      const FlightResult result = fly(grid, tau, 3e5 * effort(), interop::kBugNone);
      EXPECT_GT(result.distanceP, kFamilyRate) << "tau " << tau << " majorant " << static_cast<int>(majorant);
      EXPECT_GT(result.leavingP, kFamilyRate) << "tau " << tau << " majorant " << static_cast<int>(majorant);
    }
  }
}

TEST(FreeFlight, ThinMediaCollideAsOftenAndWhereTheyShould) {
  for (const Majorant majorant : {Majorant::Tight, Majorant::Loose, Majorant::PerGrid}) {
    for (const double tau : {1e-4, 1e-6, 1e-8}) {
      const FlightResult result = fly(bell(majorant), tau, 3e5 * effort(), interop::kBugNone);
      EXPECT_GT(result.collisions, 1e4) << tau;
      EXPECT_GT(result.leavingP, kFamilyRate) << tau;
      EXPECT_GT(result.distanceP, kFamilyRate) << tau;
    }
  }
}

TEST(FreeFlight, PlantedBugsAreSeen) {
  // 1 - xi has 17 values within 1e-6 of 1. Where the driver's log is bad near 1, 1e-4 fails as well.
  EXPECT_LT(fly(bell(Majorant::Tight), 1e-6, 3e5, interop::kBugPlainLog).distanceP, kFamilyRate);
  EXPECT_LT(fly(bell(Majorant::Loose), 2.0, 3e5, interop::kBugHalfVoxel).distanceP, kFamilyRate);
}

} // namespace
} // namespace tyndall::test

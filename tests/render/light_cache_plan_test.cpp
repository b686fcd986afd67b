// SPDX-License-Identifier: Apache-2.0
// What is planned for light caches: spacing, memory, and lattices that hold the whole grid.
#include "render/light_cache_lattice.h"
#include "render/light_cache_plan.h"
#include "support/render_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace tyndall::test {
namespace {

using render::LightCachePlan;
using render::LightCacheRequest;

/// A full cube of `edge` voxels of density 1, voxels half a unit long, and its plans.
struct PlannedCube {
  explicit PlannedCube(int edge) {
    const double half = 0.25 * (edge - 1);
    test.grid(constantGrid(edge, glm::dvec3(-half), glm::dvec3(half), 1.0));
    media = gpu_scene::packMedia(test.scene, test.volumes, glm::dvec3(0.0));
  }
  std::vector<LightCachePlan> plans(const std::vector<LightCacheRequest>& requests, double bytes) const {
    return render::planLightCaches(requests, media, test.volumes, bytes);
  }
  TestScene test;
  gpu_scene::PackedMedia media;
};

LightCacheRequest sunRequest(double sigmaT, double spacing = 0.0) {
  return {0, sigmaT, true, glm::normalize(glm::dvec3(0.2, 1.0, -0.3)), spacing};
}

double bytesOf(const std::vector<LightCachePlan>& plans) {
  return std::accumulate(plans.begin(), plans.end(), 0.0,
                         [](double sum, const LightCachePlan& plan) { return sum + plan.bytes(); });
}

TEST(LightCachePlan, SpacingFollowsTheDensity) {
  const PlannedCube cube(32);
  EXPECT_EQ(cube.plans({sunRequest(0.1)}, 1e12).front().spacing, 1.0);
  EXPECT_EQ(cube.plans({sunRequest(1.9)}, 1e12).front().spacing, 1.0); // voxels have depths up to 0.95
  EXPECT_EQ(cube.plans({sunRequest(4.0)}, 1e12).front().spacing, 0.5); // depth 2, and half of it in bricks at faces
  EXPECT_EQ(cube.plans({sunRequest(4.0, 3.0)}, 1e12).front().spacing, 3.0);
}

TEST(LightCachePlan, ASunAlongAnAxisTakesOneNodePerVoxelPlane) {
  const PlannedCube cube(32); // its field is 0 from one voxel outside on: 33 voxels across
  LightCacheRequest request = sunRequest(0.1);
  request.light = {0.0, 0.0, -1.0};
  EXPECT_EQ(cube.plans({request}, 1e12).front().header.count, glm::ivec3(34));
}

TEST(LightCachePlan, KeepsToItsBudgetAndTheFirstRequestsLongest) {
  const PlannedCube cube(32);
  std::vector<LightCacheRequest> requests(5, sunRequest(0.1));
  requests[1] = {0, 0.1, false, {0.4, 0.2, 0.1}, 0.0};
  requests[2] = {0, 0.1, false, {0.4, 90.0, 0.1}, 0.0};
  const double all = bytesOf(cube.plans(requests, 1e12));
  std::size_t kept = requests.size();
  bool someDropped = false;
  for (double share = 1.0; share > 1e-4; share *= 0.8) {
    const std::vector<LightCachePlan> plans = cube.plans(requests, share * all);
    EXPECT_LE(bytesOf(plans), share * all);
    EXPECT_LE(plans.size(), kept);
    for (std::size_t i = 1; i < plans.size(); ++i) {
      EXPECT_GE(plans[i].spacing, plans[i - 1].spacing) << share;
      EXPECT_LE(plans[i].spacing, 2.0 * plans.front().spacing) << share;
      EXPECT_GT(plans[i].request, plans[i - 1].request);
    }
    kept = plans.size();
    someDropped = someDropped || (kept > 0 && kept < requests.size());
  }
  EXPECT_TRUE(someDropped);
  EXPECT_TRUE(cube.plans(requests, 100.0).empty());
}

TEST(LightCachePlan, DenseMediaAreDroppedRatherThanCoarse) {
  const PlannedCube cube(32);
  const double thinBytes = 1.01 * cube.plans({sunRequest(0.1, 8.0)}, 1e12).front().bytes();
  EXPECT_EQ(cube.plans({sunRequest(0.1)}, thinBytes).size(), 1u);
  EXPECT_EQ(cube.plans({sunRequest(5.0)}, thinBytes).size(), 0u); // 8 voxels would be an optical depth of 20
}

TEST(LightCachePlan, LimitsTheNodesAcrossTheOctahedron) {
  const PlannedCube cube(320);
  const LightCachePlan plan = cube.plans({{0, 0.1, false, {0.4, 0.2, 0.1}, 0.0}}, 1e12).front();
  EXPECT_EQ(plan.header.kind, interop::kCacheOctahedral);
  EXPECT_LE(plan.header.count.x, 512);
  EXPECT_GE(plan.header.count.x, 500);
}

/// Lattice coordinates of a point, from the plan's matrix.
glm::dvec3 latticePlace(const interop::LightCache& cache, const glm::dvec3& point) {
  const glm::dvec4 place = glm::dmat4(cache.latticeFromVoxel) * glm::dvec4(point, 1.0);
  EXPECT_GT(place.w, 0.0);
  return {place.x / place.w, place.y / place.w, place.z};
}

TEST(LightCachePlan, LatticesHoldTheWholeGrid) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Bounds3 bounds{glm::dvec3(-1.0, 2.0, 0.0), glm::dvec3(40.0, 31.0, 77.0)};
  std::size_t pencils = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = uniform(random);
    const double y = uniform(random);
    const glm::dvec3 way(x, y, uniform(random));
    const bool distant = i % 2 == 0;
    const double reach = i % 10 == 1 ? 1e4 : 150.0;
    const render::LightCacheTarget target{bounds, distant ? way : bounds.centre() + reach * way, distant};
    const interop::LightCache cache = render::lightCacheLattice(target, i % 3 == 0 ? 0.5 : 1.7);
    const glm::dvec3 last = glm::dvec3(cache.count - 1) + 1e-3;
    pencils += cache.kind == interop::kCacheProjective && !distant ? 1 : 0;
    for (int corner = 0; corner < 8; ++corner) {
      glm::dvec3 place(0.0);
      if (cache.kind == interop::kCacheProjective) {
        place = latticePlace(cache, bounds.corner(corner));
      } else {
        const double radius = glm::length(bounds.corner(corner) - target.light);
        place.z = (radius - double(cache.firstRadius)) / double(cache.radiusStep);
      }
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(place, glm::dvec3(-1e-3))))
          << place.x << ' ' << place.y << ' ' << place.z;
      EXPECT_TRUE(glm::all(glm::lessThanEqual(place, last))) << place.x << ' ' << place.y << ' ' << place.z;
    }
  }
  EXPECT_GT(pencils, 100u);
}

} // namespace
} // namespace tyndall::test

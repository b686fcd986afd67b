// SPDX-License-Identifier: Apache-2.0
// Light caches against regular tracking in double (A7): nodes are exact, lookups between them converge, and points
// outside the grid see what their rays to the light meet.
#include "render/light_cache_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tyndall::test {
namespace {

constexpr double kSigmaT = 0.7;

std::vector<CacheLight> lightsAround(const Bounds3& bounds) {
  const glm::dvec3 size = bounds.size();
  const glm::dvec3 middle = bounds.centre();
  std::vector<CacheLight> lights{{"sun along +x", {1, 0, 0}, true},
                                 {"sun along -y", {0, -1, 0}, true},
                                 {"sun along +z", {0, 0, 1}, true},
                                 {"sun along the diagonal", {-1, 1, 1}, true},
                                 {"sun along two axes", {0, 1, -1}, true},
                                 {"sun just off an axis", {1e-4, -1, 3e-5}, true},
                                 {"sun that leans", {0.31, 0.87, -0.42}, true}};
  lights.push_back({"inside", bounds.min + glm::dvec3(0.31, 0.56, 0.62) * size});
  lights.push_back({"on a voxel", glm::round(middle)});
  lights.push_back({"on a face", {bounds.min.x, middle.y + 1.3, middle.z - 0.2}});
  lights.push_back({"on a corner", bounds.max});
  lights.push_back({"close to a face", {middle.x, bounds.max.y + 1.5, middle.z + 3.1}});
  lights.push_back({"beyond a face", {middle.x + 3.3, middle.y, bounds.min.z - 1.2 * size.z}});
  lights.push_back({"beyond a corner", bounds.min - 0.9 * size});
  lights.push_back({"far", middle + 1e4 * glm::normalize(glm::dvec3(0.4, -1.0, 0.3))});
  return lights;
}

/// Worst error over about `wanted` nodes, in units of what floats are granted: relative error 1e-5, and the depth of
/// 3e-5 voxels for where nodes and planes are rounded to.
double worstNode(const CacheScene& scene, const CacheLight& light, const render::LightCachePlan& built,
                 const render::LightCachePlan& meant, std::size_t wanted) {
  const std::vector<float> depths = scene.nodes(scene.build(built), built);
  double worst = 0.0;
  for (std::size_t i = 0; i < depths.size(); i += depths.size() / wanted + 1) {
    const double exact = scene.exact(light, nodePlace(meant.header, nodeOf(meant.header, i)));
    const double error = std::abs(double(depths[i]) - exact) / (1e-5 * exact + 3e-5 * scene.voxelDepth());
    worst = std::isnan(error) ? 1e30 : std::max(worst, error);
  }
  return worst;
}

TEST(LightCache, NodesAreExact) {
  for (const NamedMap& map : affineMaps()) {
    const CacheScene scene(spikyGrid({19, 26, 14}, 11, volume::Storage::Float, map.worldFromIndex), kSigmaT);
    for (const CacheLight& light : lightsAround(scene.bounds())) {
      for (const double spacing : {1.0, 0.5, 3.0}) {
        const render::LightCachePlan plan = scene.plan(light, spacing);
        EXPECT_LT(worstNode(scene, light, plan, plan, 500), 1.0) << map.name << ", " << light.name << ", " << spacing;
      }
    }
  }
}

TEST(LightCache, EveryKindIsTested) {
  const CacheScene scene(spikyGrid({19, 26, 14}, 11, volume::Storage::Float, glm::dmat4(1.0)), kSigmaT);
  std::size_t octahedral = 0;
  std::size_t pencils = 0;
  for (const CacheLight& light : lightsAround(scene.bounds())) {
    const interop::LightCache header = scene.plan(light, 1.0).header;
    octahedral += header.kind == interop::kCacheOctahedral ? 1 : 0;
    pencils += header.kind == interop::kCacheProjective && !light.distant ? 1 : 0;
  }
  EXPECT_GE(octahedral, 4u);
  EXPECT_GE(pencils, 2u);
}

TEST(LightCache, PlantedBugsInNodesAreSeen) {
  const CacheScene scene(spikyGrid({19, 26, 14}, 11, volume::Storage::Float, affineMaps()[4].worldFromIndex), kSigmaT);
  for (const CacheLight& light : lightsAround(scene.bounds())) {
    const render::LightCachePlan meant = scene.plan(light, 1.0);
    render::LightCachePlan shifted = meant;
    shifted.header.origin0 += 0.5f * (meant.header.originA + meant.header.originB);
    shifted.header.firstRadius += 0.5f * meant.header.radiusStep;
    EXPECT_GT(worstNode(scene, light, shifted, meant, 1500), 10.0) << light.name;
    render::LightCachePlan unmeasured = meant;
    unmeasured.header.worldFromVoxel = glm::mat4x3(1.0f);
    const bool alongX = std::abs(light.place.y) + std::abs(light.place.z) == 0.0; // where voxels are 1 unit long
    EXPECT_TRUE(worstNode(scene, light, unmeasured, meant, 1500) > 10.0 || alongX) << light.name;
  }
}

/// Points in `bounds`, grown by `margin` voxels.
std::vector<glm::dvec3> randomPoints(const Bounds3& bounds, double margin, std::size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = uniform(random);
    const double y = uniform(random);
    points.push_back(bounds.min - margin + glm::dvec3(x, y, uniform(random)) * (bounds.size() + 2.0 * margin));
  }
  return points;
}

TEST(LightCache, LookupsAtNodesGiveTheNodes) {
  for (const NamedMap& map : affineMaps()) {
    const CacheScene scene(spikyGrid({19, 26, 14}, 11, volume::Storage::Float, map.worldFromIndex), kSigmaT);
    const Bounds3 bounds = scene.bounds();
    for (const CacheLight& light : lightsAround(bounds)) {
      const render::LightCachePlan plan = scene.plan(light, 1.0);
      std::vector<glm::dvec3> points;
      for (std::size_t i = 0; i < plan.nodes(); i += plan.nodes() / 1500 + 1) {
        const glm::dvec3 point = nodePlace(plan.header, nodeOf(plan.header, i));
        if (glm::all(glm::greaterThanEqual(point, bounds.min)) && glm::all(glm::lessThanEqual(point, bounds.max))) {
          points.push_back(point);
        }
      }
      ASSERT_GT(points.size(), 50u) << light.name;
      const std::vector<float> depths = scene.inside(scene.build(plan), points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        // Places are rounded to 1e-4 nodes; between nodes a depth changes by a few voxels' depths.
        ASSERT_NEAR(double(depths[i]), scene.exact(light, points[i]), 1e-3 * scene.voxelDepth())
            << map.name << ", " << light.name;
      }
    }
  }
}

/// A ball that is smooth down to 0 at the faces of the grid.
volume::BrickGrid smoothBall() {
  return gridOf({40, 40, 40}, glm::ivec3(-3, 5, 9), affineMaps()[6].worldFromIndex, [](const glm::ivec3& index) {
    const glm::dvec3 offset = (glm::dvec3(index) - glm::dvec3(16.5, 24.5, 28.5)) / 9.0;
    return std::max(std::exp(-glm::dot(offset, offset)) - std::exp(-19.5 * 19.5 / 81.0), 0.0);
  });
}

/// A wide ball that the faces of the grid cut.
volume::BrickGrid cutBall() {
  return gridOf({30, 30, 30}, glm::ivec3(4, -7, 2), affineMaps()[6].worldFromIndex, [](const glm::ivec3& index) {
    const glm::dvec3 offset = (glm::dvec3(index) - glm::dvec3(18.5, 7.5, 16.5)) / 20.0;
    return std::exp(-glm::dot(offset, offset));
  });
}

struct LookupError {
  double rms = 0.0;
  double worst = 0.0;
  double deepest = 0.0; ///< the largest exact depth
};

LookupError errorOf(const CacheScene& scene, const CacheLight& light, const std::vector<glm::dvec3>& points,
                    const std::vector<float>& depths) {
  LookupError error;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double exact = scene.exact(light, points[i]);
    const double difference = std::abs(double(depths[i]) - exact);
    error.rms += difference * difference / double(points.size());
    error.worst = std::isnan(difference) ? 1e30 : std::max(error.worst, difference);
    error.deepest = std::max(error.deepest, exact);
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

TEST(LightCache, LookupsConvergeWithTheSquareOfTheSpacing) {
  const CacheScene scene(smoothBall(), kSigmaT);
  const std::vector<glm::dvec3> points = randomPoints(scene.bounds(), 0.0, 4000);
  for (const CacheLight& light : lightsAround(scene.bounds())) {
    const auto errorAt = [&](double spacing) {
      return errorOf(scene, light, points, scene.inside(scene.build(scene.plan(light, spacing)), points));
    };
    const LookupError fine = errorAt(2.0);
    EXPECT_LT(fine.worst, 0.05 * fine.deepest) << light.name;
    EXPECT_GT(errorAt(4.0).rms, 3.0 * fine.rms) << light.name;
    EXPECT_LT(errorAt(1.0).worst, 0.01 * fine.deepest) << light.name;
  }
}

TEST(LightCache, LookupsBesideTheirPlaceAreSeen) {
  const CacheScene scene(smoothBall(), kSigmaT);
  const std::vector<glm::dvec3> points = randomPoints(scene.bounds(), 0.0, 4000);
  std::vector<glm::dvec3> beside = points;
  for (glm::dvec3& point : beside) {
    point += 0.5;
  }
  for (const CacheLight& light : lightsAround(scene.bounds())) {
    const render::LightCaches caches = scene.build(scene.plan(light, 1.0));
    const LookupError error = errorOf(scene, light, points, scene.inside(caches, beside));
    EXPECT_GT(error.worst, 0.01 * error.deepest) << light.name;
  }
}

TEST(LightCache, IsContinuousAcrossTheOctahedronsEdges) {
  const CacheScene scene(smoothBall(), kSigmaT);
  const CacheLight light{"inside", scene.bounds().centre() + glm::dvec3(0.7, -1.9, 3.2)};
  const render::LightCachePlan plan = scene.plan(light, 2.0);
  ASSERT_EQ(plan.header.kind, interop::kCacheOctahedral);
  const render::LightCaches caches = scene.build(plan);
  // The square's edges are the half planes x = 0 and y = 0 below the light, its fold is the plane z = 0.
  const auto largestStep = [&](double apart) {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& point : randomPoints({glm::dvec3(-15.0), glm::dvec3(15.0)}, 0.0, 1500)) {
      for (const double side : {-0.5, 0.5}) {
        points.push_back(light.place + glm::dvec3(side * apart, point.y, -std::abs(point.z)));
        points.push_back(light.place + glm::dvec3(point.x, side * apart, -std::abs(point.z)));
        points.push_back(light.place + glm::dvec3(point.x, point.y, side * apart));
      }
    }
    const std::vector<float> depths = scene.inside(caches, points);
    double largest = 0.0;
    for (std::size_t i = 0; i + 5 < depths.size(); i += 6) {
      for (std::size_t k = 0; k < 3; ++k) {
        largest = std::max(largest, std::abs(double(depths[i + k]) - double(depths[i + k + 3])));
      }
    }
    return largest;
  };
  EXPECT_LT(largestStep(1e-4), 1e-3 * scene.voxelDepth());
  EXPECT_GT(largestStep(1.0), 1e-2 * scene.voxelDepth()); // planted: points that are not beside each other
}

/// Points around the grid, and points whose ways to the light lead through it, up to `distance` voxels behind it.
std::vector<glm::dvec3> pointsOutside(const Bounds3& bounds, const CacheLight& light, double distance) {
  std::vector<glm::dvec3> points = randomPoints(bounds, 0.0, 3000);
  for (glm::dvec3& point : points) {
    point += distance * glm::normalize(light.distant ? -light.place : point - light.place);
  }
  const std::vector<glm::dvec3> around = randomPoints(bounds, distance, 1000);
  points.insert(points.end(), around.begin(), around.end());
  return points;
}

TEST(LightCache, PointsOutsideSeeWhatTheirRaysMeet) {
  const CacheScene scene(cutBall(), kSigmaT);
  for (const CacheLight& light : lightsAround(scene.bounds())) {
    const render::LightCaches caches = scene.build(scene.plan(light, 1.0));
    for (const double distance : {5.0, 40.0, 2000.0}) {
      const std::vector<glm::dvec3> points = pointsOutside(scene.bounds(), light, distance);
      const LookupError error = errorOf(scene, light, points, scene.from(caches, light, points));
      EXPECT_LT(error.rms, 0.01 * error.deepest) << light.name << ", " << distance;
      EXPECT_LT(error.worst, 0.15 * error.deepest) << light.name << ", " << distance; // where rays graze a face
      CacheLight turned = light; // planted: the light is on the other side of the grid
      turned.place = light.distant ? -light.place : 2.0 * scene.bounds().centre() - light.place + 6.0;
      const LookupError wrong = errorOf(scene, light, points, scene.from(caches, turned, points));
      EXPECT_GT(wrong.rms, 0.01 * error.deepest) << light.name << ", " << distance;
    }
  }
}

TEST(LightCache, TheLightItselfHasNoDepth) {
  const CacheScene scene(smoothBall(), kSigmaT);
  const CacheLight light{"on a voxel", glm::round(scene.bounds().centre())};
  const render::LightCaches caches = scene.build(scene.plan(light, 1.0));
  EXPECT_NEAR(double(scene.inside(caches, {light.place}).front()), 0.0, 1e-5);
  EXPECT_GT(scene.inside(caches, {light.place + glm::dvec3(0.3, 0.0, 0.0)}).front(), 1e-2f); // planted
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// The traversal against every primitive in double.
#include "geometry/ray_world.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace tyndall::test {
namespace {

using interop::ProbeHit;
using interop::ProbeRay;

constexpr std::size_t kRays = 20000;

std::vector<ProbeRay> randomRays(std::size_t count, float spread, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-spread, spread);
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = uniform(random);
    const float y = uniform(random);
    const glm::vec3 origin(x, y, uniform(random));
    glm::vec3 direction = randomDirection(random);
    if (i % 4 == 0) { // along an axis, or within a plane of two
      direction[int(i / 4) % 3] = 0.0f;
      direction[int(i / 4 + 1) % 3] *= i % 8 == 0 ? 0.0f : 1.0f;
    }
    direction *= i % 5 == 0 ? 0.25f : 1.0f; // of any length
    rays.push_back({origin, direction, glm::vec3(0.0f), i % 7 == 0 ? 1.0f : 1e30f, 0});
  }
  return rays;
}

struct Verdict {
  std::size_t hits = 0;
  std::size_t doubtful = 0;
  std::size_t wrongHits = 0;  ///< hit or miss, primitive, instance
  double worstDistance = 0.0; ///< times the cosine, over coordinates: what a float's rounding explains is 1e-6
  double worstBarycentric = 0.0;
  std::size_t wrongAnyHits = 0;
};

/// Blocked by something opaque, or at the closest surface, which is not opaque.
bool anyHitIsSound(const RayWorld& world, const ProbeHit& found, const ExactHit& exact) {
  if (found.blocked != 0) {
    return exact.opaqueHit && found.t == 0.0f;
  }
  const bool hits = found.primitive != interop::kBvhEmpty;
  const bool opaque = hits && (world.bvh.primitives[found.primitive].id & interop::kPrimitiveOpaque) != 0;
  return found.primitive == exact.primitive && !opaque;
}

/// @param reach coordinates that floats are rounded from.
Verdict judge(const RayWorld& world, std::vector<ProbeRay> rays, double reach, std::uint32_t plantedBug = 0) {
  const std::vector<ProbeHit> closest = world.run(rays, interop::kRayCast, 0, plantedBug);
  for (ProbeRay& ray : rays) {
    ray.anyHit = 1;
  }
  const std::vector<ProbeHit> any = world.run(rays, interop::kRayCast, 0, plantedBug);
  Verdict verdict;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ExactHit exact = exactHit(world, rays[i]);
    if (exact.doubtful) {
      ++verdict.doubtful;
      continue;
    }
    const bool hits = exact.primitive != interop::kBvhEmpty;
    verdict.hits += hits ? 1 : 0;
    verdict.wrongAnyHits += anyHitIsSound(world, any[i], exact) ? 0 : 1;
    if (closest[i].primitive != exact.primitive || closest[i].instance != exact.instance || closest[i].blocked != 0) {
      ++verdict.wrongHits;
      continue;
    }
    if (!hits) {
      verdict.wrongHits += closest[i].t == rays[i].tMax ? 0 : 1;
      continue;
    }
    const double length = glm::length(glm::dvec3(rays[i].direction));
    const double distance = std::abs(double(closest[i].t) - exact.t) * length * exact.cosine;
    verdict.worstDistance = std::max(verdict.worstDistance, distance / reach);
    if ((world.bvh.primitives[exact.primitive].id & interop::kPrimitiveKindMask) == interop::kPrimitiveTriangle) {
      const glm::dvec2 error = glm::abs(glm::dvec2(closest[i].barycentric) - exact.barycentric);
      verdict.worstBarycentric = std::max(verdict.worstBarycentric, std::max(error.x, error.y) * exact.cosine);
    }
  }
  return verdict;
}

void expectSound(const Verdict& verdict, std::size_t rays, double barycentricError = 1e-4) {
  EXPECT_GT(verdict.hits, rays / 30);
  EXPECT_LT(verdict.doubtful, rays / 5);
  EXPECT_EQ(verdict.wrongHits, 0u);
  EXPECT_EQ(verdict.wrongAnyHits, 0u);
  EXPECT_LT(verdict.worstDistance, 1e-6);
  EXPECT_LT(verdict.worstBarycentric, barycentricError);
}

TEST(RayCast, FindsTheClosestOfASoup) {
  for (const float size : {0.05f, 0.3f, 1.0f}) {
    SCOPED_TRACE(size);
    expectSound(judge(RayWorld(randomTriangles(1000, size, 7)), randomRays(kRays, 1.5f, 11), 3.0), kRays);
  }
}

TEST(RayCast, FindsTheClosestOfAGrid) {
  const RayWorld world(closedBox(glm::vec3(1.0f, 0.7f, 0.4f), 8));
  expectSound(judge(world, randomRays(kRays, 1.5f, 12), 3.0), kRays);
}

Soup spheresAndTriangles() {
  Soup soup = randomTriangles(150, 0.3f, 3);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  for (std::uint32_t i = 0; i < 150; ++i) {
    const float x = uniform(random);
    const float y = uniform(random);
    soup.push_back(sphere({x, y, uniform(random)}, 0.02f + 0.2f * std::abs(uniform(random)), i, i % 2 == 0));
  }
  return soup;
}

TEST(RayCast, FindsTheClosestOfSpheresFromOutsideAndInside) {
  expectSound(judge(RayWorld(spheresAndTriangles()), randomRays(kRays, 1.2f, 13), 3.0), kRays);
}

TEST(RayCast, FarSpheresKeepTheirPlace) {
  const RayWorld world({sphere({0.0f, 0.0f, 0.0f}, 1.0f, 0)});
  std::mt19937 random(17);
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < 2000; ++i) {
    const glm::vec3 target = 0.9f * randomDirection(random);
    const glm::vec3 origin = 1000.0f * randomDirection(random);
    rays.push_back({origin, glm::normalize(target - origin), glm::vec3(0.0f), 1e30f, 0});
  }
  expectSound(judge(world, rays, 1000.0), rays.size());
}

RayWorld instancedWorld() {
  Soup world = randomTriangles(40, 0.3f, 21);
  std::vector<RayWorld::Place> places;
  std::mt19937 random(23);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (std::uint32_t i = 0; i < 60; ++i) {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), {uniform(random), uniform(random), uniform(random)});
    matrix = glm::rotate(matrix, 3.0 * uniform(random), glm::dvec3(randomDirection(random)));
    // Unequal and, in one of three, mirrored.
    matrix = glm::scale(matrix, {0.1 + 0.1 * uniform(random) * uniform(random), 0.15, i % 3 == 0 ? -0.2 : 0.1});
    places.push_back({i % 2, matrix});
  }
  return RayWorld(world, {icosphere(1), spheresAndTriangles()}, places);
}

TEST(RayCast, FindsTheClosestOfInstances) {
  const RayWorld world = instancedWorld();
  ASSERT_GT(world.bvh.primitives.size(), world.worldPrimitives);
  expectSound(judge(world, randomRays(5000, 1.3f, 14), 30.0), 5000); // an object's space is up to 10 times larger
}

TEST(RayCast, CoincidentPrimitivesFitTheStack) {
  Soup coincident;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    coincident.push_back(triangle({-1.0f, -1.0f, 0.0f}, {1.0f, -1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, i));
  }
  const RayWorld world(coincident);
  EXPECT_LE(world.bvh.depth, geometry::kBvhLevels);
  const std::vector<ProbeHit> hits = world.run({{{0.1f, 0.0f, -2.0f}, {0.0f, 0.0f, 1.0f}, glm::vec3(0.0f), 1e30f, 0},
                                                {{2.0f, 0.0f, -2.0f}, {0.0f, 0.0f, 1.0f}, glm::vec3(0.0f), 1e30f, 0}},
                                               interop::kRayCast);
  EXPECT_EQ(hits[0].t, 2.0f);
  EXPECT_EQ(hits[1].primitive, interop::kBvhEmpty);
}

/// Each triangle twice as large and as far as the last: splits by area take them off one by one.
TEST(RayCast, AChainOfGrowingTrianglesFitsTheStack) {
  Soup chain;
  for (std::uint32_t copy = 0; copy < 40; ++copy) {
    for (int power = -50; power < 50; ++power) {
      const float size = std::ldexp(1.0f, power);
      const float x = size * (1.0f + 0.001f * float(copy));
      chain.push_back(triangle({x, 0.0f, 0.0f}, {x, 0.3f * size, 0.0f}, {x, 0.0f, 0.3f * size},
                               static_cast<std::uint32_t>(chain.size())));
    }
  }
  const RayWorld world(chain);
  EXPECT_LE(world.bvh.depth, geometry::kBvhLevels);
  std::vector<ProbeRay> rays;
  for (int power = -48; power < 48; ++power) {
    const float size = std::ldexp(1.0f, power);
    rays.push_back({{0.75f * size, 0.1f * size, 0.1f * size}, {1.0f, 0.0f, 0.0f}, glm::vec3(0.0f), 1e30f, 0});
  }
  const std::vector<ProbeHit> hits = world.run(rays, interop::kRayCast);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_NEAR(hits[i].t / rays[i].origin.x, 1.0f / 3.0f, 1e-5f) << i;
  }
}

TEST(RayCast, AnEmptyWorldIsMissed) {
  const RayWorld world(Soup{});
  const std::vector<ProbeHit> hits =
      world.run({{glm::vec3(0.0f), {0.0f, 0.0f, 1.0f}, glm::vec3(0.0f), 5.0f, 1}}, interop::kRayCast);
  EXPECT_EQ(hits[0].primitive, interop::kBvhEmpty);
  EXPECT_EQ(hits[0].t, 5.0f);
  EXPECT_EQ(hits[0].blocked, 0u);
}

/// Spoils the tree: the checker must see it.
TEST(RayCast, APlantedShiftIsSeen) {
  RayWorld world(randomTriangles(1000, 0.3f, 7));
  for (interop::BvhPrimitive& primitive : world.bvh.primitives) {
    primitive.v0.x += 1e-4f; // of the reference's triangles only
  }
  const Verdict verdict = judge(world, randomRays(2000, 1.5f, 11), 3.0);
  EXPECT_GT(verdict.worstDistance, 1e-6);
  EXPECT_GT(verdict.worstBarycentric, 1e-4);
}

} // namespace
} // namespace tyndall::test

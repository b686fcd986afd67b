// SPDX-License-Identifier: Apache-2.0
// Rays through edges and vertices of closed bodies, and rays that leave surfaces, at scales far apart.
#include "geometry/ray_world.h"
#include "interop/planted_bugs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace tyndall::test {
namespace {

using interop::ProbeHit;
using interop::ProbeRay;

constexpr std::size_t kRays = 1000000;

struct Place {
  std::string name;
  float scale = 1.0f;
  glm::vec3 shift{0.0f};
};

const std::vector<Place> kPlaces{
    {"of unit size", 1.0f},
    {"tiny", 1e-4f},
    {"huge", 1e6f},
    {"of unit size, far from the origin", 1.0f, {1e5f, -0.7e5f, 0.4e5f}},
};

glm::vec3 corner(const geometry::BvhInput& input, std::size_t i) {
  const interop::BvhPrimitive& primitive = input.primitive;
  return i % 3 == 0 ? primitive.v0 : (i % 3 == 1 ? primitive.v1 : primitive.v2);
}

glm::vec3 centreOf(const Place& place) { return place.shift; }

/// From points inside, at edges and at vertices of random triangles.
std::vector<ProbeRay> raysAtEdges(const Soup& soup, const Place& place, std::size_t count) {
  std::mt19937 random(31);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const geometry::BvhInput& input = soup[random() % soup.size()];
    const std::size_t side = random();
    const glm::vec3 a = corner(input, side);
    const glm::vec3 b = corner(input, side + 1);
    const float along = i % 3 == 0 ? 0.0f : uniform(random);
    const glm::vec3 target = a + along * (b - a);
    // The centre is a symmetric case of its own: every tenth ray.
    const float off = i % 10 == 0 ? 0.0f : 0.5f * uniform(random);
    const glm::vec3 origin = centreOf(place) + off * place.scale * randomDirection(random);
    rays.push_back({origin, glm::normalize(target - origin), glm::vec3(0.0f), 1e30f, 0});
  }
  return rays;
}

std::size_t escapes(const Soup& soup, const Place& place, std::uint32_t plantedBug, std::size_t count) {
  const std::vector<ProbeHit> hits =
      RayWorld(soup).run(raysAtEdges(soup, place, count), interop::kRayCast, 0, plantedBug);
  return static_cast<std::size_t>(
      std::count_if(hits.begin(), hits.end(), [](const ProbeHit& hit) { return hit.primitive == interop::kBvhEmpty; }));
}

std::vector<Soup> bodies() {
  return {closedBox({1.0f, 0.9f, 0.8f}, 1), closedBox({0.8f, 1.0f, 0.9f}, 7), icosphere(3)};
}

TEST(RayWatertight, NothingEscapesThroughEdgesAndVertices) {
  for (const Place& place : kPlaces) {
    for (const Soup& body : bodies()) {
      EXPECT_EQ(escapes(moved(body, place.scale, place.shift), place, 0, kRays), 0u)
          << place.name << ", " << body.size() << " triangles";
    }
  }
}

TEST(RayWatertight, ExclusiveEdgesAreSeenToLeak) {
  for (const Soup& body : bodies()) {
    EXPECT_GT(escapes(body, kPlaces[0], interop::kBugExclusiveEdges, kRays), 10u) << body.size() << " triangles";
  }
}

/// A body seen from inside and outside, by rays that leave what they hit.
struct Body {
  std::string name;
  RayWorld world;
};

std::vector<Body> placedBodies(const Place& place) {
  std::vector<Body> result;
  const auto put = [&](const Soup& soup) { return moved(soup, place.scale, place.shift); };
  result.push_back({"box", RayWorld(put(closedBox({1.0f, 0.9f, 0.8f}, 1)))});
  result.push_back({"icosphere", RayWorld(put(icosphere(3)))});
  result.push_back({"sphere", RayWorld(put({sphere(glm::vec3(0.0f), 1.0f, 0)}))});
  // Turned, sheared and mirrored; the mesh itself lies off its own origin.
  glm::dmat4 matrix(glm::dvec4(0.8, 0.1, -0.3, 0.0) * double(place.scale),
                    glm::dvec4(0.2, -0.9, 0.1, 0.0) * double(place.scale),
                    glm::dvec4(0.1, 0.3, 0.7, 0.0) * double(place.scale), glm::dvec4(glm::dvec3(place.shift), 1.0));
  matrix = matrix * glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -30, 20, 10, 1);
  const glm::vec3 own(30.0f, -20.0f, -10.0f);
  result.push_back({"instanced box", RayWorld({}, {moved(closedBox(glm::vec3(1.0f), 1), 1.0f, own)}, {{0, matrix}})});
  result.push_back({"instanced sphere", RayWorld({}, {{sphere(own, 1.0f, 0)}}, {{0, matrix}})});
  return result;
}

/// Rays from around the body to random places of it. `next`: anywhere.
std::vector<ProbeRay> raysAt(const Place& place, float distance, std::size_t count) {
  std::mt19937 random(37);
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 origin = centreOf(place) + distance * place.scale * randomDirection(random);
    const glm::vec3 target = centreOf(place) + 0.4f * place.scale * randomDirection(random);
    rays.push_back({origin, glm::normalize(target - origin), randomDirection(random), 1e30f, 0});
  }
  return rays;
}

struct Leaving {
  std::size_t left = 0;       ///< rays that hit and went on outward
  std::size_t selfHits = 0;   ///< of a convex body, which a ray that leaves it never meets again
  double largestOffset = 0.0; ///< over the body's size
};

/// Points on the body, then rays away from it, every other one all but tangential.
Leaving leave(const Body& body, const Place& place, std::uint32_t plant, std::size_t count) {
  std::vector<ProbeRay> rays = raysAt(place, 4.0f, count);
  const std::vector<ProbeHit> points = body.world.run(rays, interop::kRayLeave);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const glm::vec3 normal = points[i].normal;
    const float height = glm::dot(rays[i].next, normal);
    rays[i].next += (std::abs(height) - height) * normal; // to the outside
    rays[i].next = glm::normalize(i % 2 == 0 ? rays[i].next : rays[i].next - 0.9999f * std::abs(height) * normal);
  }
  const std::vector<ProbeHit> hits = body.world.run(rays, interop::kRayLeave, plant);
  Leaving result;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool started = glm::length(hits[i].normal) > 0.5f && glm::dot(rays[i].next, hits[i].normal) > 0.0f;
    result.left += started ? 1 : 0;
    result.selfHits += started && hits[i].primitive != interop::kBvhEmpty ? 1 : 0;
    result.largestOffset = std::max(result.largestOffset, double(hits[i].error) / double(place.scale));
  }
  return result;
}

TEST(RayOffset, RaysThatLeaveAConvexBodyDoNotMeetIt) {
  for (const Place& place : kPlaces) {
    for (const Body& body : placedBodies(place)) {
      const Leaving result = leave(body, place, 0, kRays / 4);
      EXPECT_GT(result.left, kRays / 5) << body.name << ' ' << place.name;
      EXPECT_EQ(result.selfHits, 0u) << body.name << ' ' << place.name;
      // A few roundings of the coordinates; an instance's are those of its object too, 30 units off its origin.
      const double coordinates =
          (body.world.instances.empty() ? 2.0 : 40.0) + double(glm::length(place.shift)) / double(place.scale);
      EXPECT_LT(result.largestOffset, 3e-6 * coordinates) << body.name << ' ' << place.name;
    }
  }
}

TEST(RayOffset, WithoutItRaysAreSeenToMeetTheirSurface) {
  for (const Body& body : placedBodies(kPlaces[3])) {
    if (body.name == "box") {
      continue; // along the axes, where points lie on their planes exactly
    }
    EXPECT_GT(leave(body, kPlaces[3], interop::kPlantNoOffset, 100000).selfHits, 100u) << body.name;
  }
}

/// From inside a convex body no surface is in the way from one of its points to another.
std::size_t shadowed(const Body& body, const Place& place, std::uint32_t plant, std::size_t count) {
  std::vector<ProbeRay> rays = raysAt(place, 0.3f, count);
  const std::vector<ProbeHit> hits = body.world.run(rays, interop::kRayShadow, plant);
  return static_cast<std::size_t>(
      std::count_if(hits.begin(), hits.end(), [](const ProbeHit& hit) { return hit.blocked != 0; }));
}

TEST(RayOffset, ShadowRaysEndBeforeTheSurfaceTheyAimAt) {
  for (const Place& place : kPlaces) {
    for (const Body& body : placedBodies(place)) {
      // Far from the origin a float is 1 / 128: so near an edge, a point of one face lies beyond the other one.
      const std::size_t allowed = place.shift == glm::vec3(0.0f) ? 0 : kRays / 4 / 50;
      EXPECT_LE(shadowed(body, place, 0, kRays / 4), allowed) << body.name << ' ' << place.name;
    }
  }
}

TEST(RayOffset, ShadowRaysWithoutOffsetsAreSeenToBeBlocked) {
  for (const Body& body : placedBodies(kPlaces[0])) {
    EXPECT_GT(shadowed(body, kPlaces[0], interop::kPlantNoOffset, 100000), 100u) << body.name;
  }
}

/// A ground much larger than the scene on it must not push rays off by its own size.
TEST(RayOffset, AHugeGroundIsLeftByLittle) {
  const float far = 1e6f;
  const RayWorld world({triangle({-far, 0.0f, -far}, {-far, 0.0f, far}, {far, 0.0f, far}, 0),
                        triangle({-far, 0.0f, -far}, {far, 0.0f, far}, {far, 0.0f, -far}, 1)});
  std::mt19937 random(41);
  std::vector<ProbeRay> rays;
  for (std::size_t i = 0; i < 100000; ++i) {
    glm::vec3 next = randomDirection(random);
    next.y = std::abs(next.y) + 1e-6f;
    glm::vec3 direction = randomDirection(random);
    direction.y = -std::abs(direction.y) - 0.1f;
    rays.push_back({{0.3f, 2.0f, -0.8f}, direction, next, 1e30f, 0});
  }
  const std::vector<ProbeHit> hits = world.run(rays, interop::kRayLeave);
  for (const ProbeHit& hit : hits) {
    ASSERT_EQ(hit.primitive, interop::kBvhEmpty);
    ASSERT_LT(hit.error, 2e-5f); // hits lie up to 20 units away
    ASSERT_GT(hit.error, 0.0f);
    ASSERT_EQ(hit.position.y, 0.0f);
  }
  // Along the plane they are as exact as their rays, and not rounded as the ground's corners are.
  const std::size_t apart = static_cast<std::size_t>(std::count_if(
      hits.begin(), hits.end(), [](const ProbeHit& hit) { return std::fmod(hit.position.x, 0.0625f) != 0.0f; }));
  EXPECT_GT(apart, hits.size() / 2);
}

} // namespace
} // namespace tyndall::test

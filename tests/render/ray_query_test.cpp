// SPDX-License-Identifier: Apache-2.0
// Pictures by the device's ray queries against those through our own tree, which has tests of its own: with the same
// seeds the same paths, but where an edge is taken for the neighbour's.
#include "base/error.h"
#include "gpu_scene/gpu_scene.h"
#include "gpu_scene/ray_query.h"
#include "support/path_scenes.h"
#include "support/probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

using render::RayCaster;

#define NEEDS_RAY_QUERY()                                                                                              \
  if (!probeDevice().info().rayQuery) {                                                                                \
    GTEST_SKIP() << probeDevice().info().name << " has no ray queries";                                                \
  }

MomentOptions with(RayCaster rays, std::uint32_t bug = interop::kBugNone) {
  MomentOptions options = withBug(byPaths({.replicates = 8, .samples = 8}), bug);
  options.estimator.rays = rays;
  return options;
}

Moments picture(const PathScene& test, RayCaster rays, std::uint32_t bug = interop::kBugNone) {
  return renderMoments(test.scene, test.volumes, with(rays, bug));
}

/// Share of the pixels that are the same to float rounding, in all channels.
double sameShare(const Moments& a, const Moments& b) {
  std::size_t same = 0;
  for (std::size_t pixel = 0; pixel < a.pixels.size(); ++pixel) {
    bool equal = true;
    for (int channel = 0; channel < 4; ++channel) {
      const double scale = std::abs(a.mean(pixel, channel)) + std::abs(b.mean(pixel, channel));
      equal = equal && std::abs(a.mean(pixel, channel) - b.mean(pixel, channel)) <= 1e-5 * scale;
    }
    same += equal ? 1 : 0;
  }
  return double(same) / double(a.pixels.size());
}

/// Both pictures agree and are nearly the same, and the bug is seen.
void expectSame(const PathScene& test, std::uint32_t bug, double atLeast = 0.95) {
  const Moments tree = picture(test, RayCaster::Tree);
  const Moments query = picture(test, RayCaster::Query);
  ASSERT_GT(tree.image().mean, 0.0);
  EXPECT_AGREES(tileTest(tree, query));
  EXPECT_GE(sameShare(tree, query), atLeast);
  const Moments bad = picture(test, RayCaster::Query, bug);
  EXPECT_DIFFERS(tileTest(tree, bad));
  EXPECT_LT(sameShare(tree, bad), atLeast);
}

/// A closed room from inside, without light.
PathScene room() {
  PathScene test({32, 32});
  test.perspective({0.3, 0.9, 1.7}, {-0.1, 0.8, -1.0}, 60.0);
  test.material("walls", MaterialId::Diffuse, 0.7);
  test.crate("walls", {-1.0, 0.0, -1.0}, {1.0, 2.0, 2.0});
  return test;
}

PathScene litRoom() {
  PathScene test = room();
  test.lamp("lamp", 6.0);
  test.quad("lamp", {-0.4, 1.99, -0.3}, {0.8, 0.0, 0.0}, {0.0, 0.0, 0.8});
  return test;
}

/// A ring of 2 * 64^2 triangles around the y axis.
geometry::Mesh ring() {
  constexpr std::uint32_t kAround = 64;
  geometry::Mesh mesh;
  for (std::uint32_t i = 0; i < kAround * kAround; ++i) {
    const double u = 2.0 * std::numbers::pi * (i % kAround) / kAround;
    const double v = 2.0 * std::numbers::pi * (i / kAround) / kAround;
    const double radius = 0.3 + 0.12 * std::cos(v);
    mesh.positions.emplace_back(radius * std::cos(u), 0.12 * std::sin(v), radius * std::sin(u));
    const std::uint32_t right = i % kAround + 1 == kAround ? i + 1 - kAround : i + 1;
    const std::uint32_t up = (i + kAround) % (kAround * kAround);
    const std::uint32_t both = (right + kAround) % (kAround * kAround);
    mesh.triangles.emplace_back(i, up, right);
    mesh.triangles.emplace_back(right, up, both);
  }
  return mesh;
}

/// Placed, turned, mirrored and sheared.
std::vector<glm::dmat4> places() {
  const auto moved = [](double x, double y, double z) {
    glm::dmat4 place(1.0);
    place[3] = {x, y, z, 1.0};
    return place;
  };
  glm::dmat4 turned(1.0);
  turned[1] = {0.0, 0.6, 0.8, 0.0};
  turned[2] = {0.0, -0.8, 0.6, 0.0};
  glm::dmat4 mirrored(1.0);
  mirrored[0].x = -0.8;
  mirrored[1] = {0.3, 1.4, 0.0, 0.0};
  return {moved(-0.5, 0.4, -0.4), moved(0.4, 0.5, 0.0) * turned, moved(0.0, 1.2, -0.3) * turned * mirrored};
}

TEST(RayQuery, OfALitRoomGivesTheSamePicture) {
  NEEDS_RAY_QUERY();
  PathScene test = litRoom();
  test.material("block", MaterialId::Diffuse, 0.4);
  test.crate("block", {-0.6, 0.0, -0.6}, {-0.1, 1.1, -0.1});
  const Moments tree = picture(test, RayCaster::Tree);
  const Moments query = picture(test, RayCaster::Query);
  EXPECT_AGREES(tileTest(tree, query));
  EXPECT_GE(sameShare(tree, query), 0.95);
  test.scene.objects.back().box.max.y = 0.7; // planted: a lower block
  const Moments bad = picture(test, RayCaster::Query);
  EXPECT_DIFFERS(tileTest(tree, bad));
  EXPECT_LT(sameShare(tree, bad), 0.95);
}

/// The sky is bright, the room closed: any light in it came through an edge. A ray starts from each surface's rounding.
TEST(RayQuery, OfAClosedRoomLetsNothingIn) {
  NEEDS_RAY_QUERY();
  PathScene test = room();
  test.constant(1000.0);
  test.mesh("walls", ring()).worldFromObject = places().front();
  const auto light = [](const Moments& moments) { return moments.image().mean + moments.image(kTransmittance).mean; };
  EXPECT_EQ(light(picture(test, RayCaster::Query)), 0.0);
  test.scene.objects.front().box.max.x = 0.0; // planted: a wall that the camera stands behind
  EXPECT_GT(light(picture(test, RayCaster::Query)), 0.0);
}

TEST(RayQuery, OfSpheresGivesTheSamePicture) {
  NEEDS_RAY_QUERY();
  PathScene test = litRoom();
  test.material("glass", MaterialId::Dielectric).ior = 1.5;
  test.ball("glass", {-0.4, 0.5, -0.2}, 0.4);
  test.ball("walls", {0.5, 0.3, 0.1}, 0.3);
  test.lamp("small lamp", 40.0);
  test.ball("small lamp", {0.6, 1.4, -0.5}, 0.05);
  expectSame(test, interop::kBugRaySpheres);
}

TEST(RayQuery, OfInstancesGivesTheSamePicture) {
  NEEDS_RAY_QUERY();
  PathScene test = litRoom();
  test.mesh("walls", ring()).instances = places();
  test.ball("walls", {0.6, 0.2, 0.4}, 0.2);
  const gpu_scene::GpuScene packed(probeDevice(), test.scene, test.volumes, gpu_scene::GridLayout::Paths);
  ASSERT_EQ(packed.surfaces().instances.size(), 3u);
  expectSame(test, interop::kBugRayPlace);
}

/// Shadow rays go through what encloses a medium, and end at what is opaque.
TEST(RayQuery, ThroughNullBoundariesGivesTheSamePicture) {
  NEEDS_RAY_QUERY();
  PathScene test = litRoom();
  test.material("boundary", MaterialId::Null);
  test.crate("boundary", {-0.8, 0.1, -0.8}, {0.8, 1.2, 0.2});
  test.fill(1.5, 0.9);
  test.ball("walls", {0.0, 0.3, -0.2}, 0.2);
  expectSame(test, interop::kBugRayCounts);
}

/// Holes in triangles, instances and spheres. Whether an opaque surface is found before a hole in front of it is the
/// traversal's affair, and a hole draws a random number: paths differ from there on, their mean does not.
TEST(RayQuery, ThroughHolesGivesTheSameMeans) {
  NEEDS_RAY_QUERY();
  PathScene test = litRoom();
  geometry::Material& lace = test.material("lace", MaterialId::Diffuse, 0.5);
  lace.opacity = 0.3;
  lace.alpha = geometry::Alpha::Blend;
  test.mesh("lace", ring()).instances = places();
  test.ball("lace", {0.5, 0.9, 0.2}, 0.25);
  test.quad("lace", {-0.9, 1.5, -0.9}, {1.8, 0.0, 0.0}, {0.0, 0.0, 2.0});
  test.ball("walls", {0.0, 0.3, -0.2}, 0.2);
  const Moments tree = picture(test, RayCaster::Tree);
  EXPECT_AGREES(tileTest(tree, picture(test, RayCaster::Query)));
  EXPECT_DIFFERS(tileTest(tree, picture(test, RayCaster::Query, interop::kBugRayCounts)));
}

/// Nothing but spheres: the world's triangles are all left out.
TEST(RayQuery, OfSpheresAloneGivesTheSamePicture) {
  NEEDS_RAY_QUERY();
  PathScene test({16, 16});
  test.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 40.0);
  test.constant(1.0);
  test.material("grey", MaterialId::Diffuse, 0.5);
  test.ball("grey", {-0.4, 0.0, 0.0}, 0.7);
  test.ball("grey", {60.0, 0.0, -90.0}, 30.0);
  expectSame(test, interop::kBugRaySpheres);
}

/// The n-th triangle of a range is its n-th primitive: what is none has no area, but a number.
TEST(RayQueryRanges, NumberTrianglesAsTheTreeDoes) {
  PathScene test = room();
  test.mesh("walls", ring()).instances = places();
  test.ball("walls", {0.6, 0.2, 0.4}, 0.2);
  const gpu_scene::GpuScene scene(probeDevice(), test.scene, test.volumes, gpu_scene::GridLayout::Paths);
  const gpu_scene::PackedSurfaces& surfaces = scene.surfaces();
  const auto ranges = gpu_scene::primitiveRanges(surfaces);
  ASSERT_EQ(ranges.size(), 2u); // the world, and the mesh
  EXPECT_EQ(ranges[0].first, 0u);
  EXPECT_EQ(ranges[0].count, 12u + 1u + 3u); // the room, the ball, the instances
  EXPECT_EQ(ranges[1].first, ranges[0].count);
  EXPECT_EQ(ranges[1].count, 2u * 64u * 64u);
  EXPECT_EQ(ranges[1].root, surfaces.instances.front().root);
  for (const gpu_scene::PrimitiveRange& range : ranges) {
    const std::vector<glm::vec3> corners = gpu_scene::rangeCorners(surfaces, range);
    ASSERT_EQ(corners.size(), 3u * range.count);
    for (std::uint32_t i = 0; i < range.count; ++i) {
      const interop::BvhPrimitive& primitive = surfaces.bvh.primitives[range.first + i];
      const bool triangle = (primitive.id & interop::kPrimitiveKindMask) == interop::kPrimitiveTriangle;
      if (triangle) {
        EXPECT_EQ(corners[3 * i + 1], primitive.v1);
        EXPECT_EQ(corners[3 * i + 2], primitive.v2);
      } else {
        EXPECT_EQ(corners[3 * i], corners[3 * i + 1]);
        EXPECT_EQ(corners[3 * i], corners[3 * i + 2]);
      }
    }
  }
}

gpu_scene::GpuScene uploaded(const PathScene& test) {
  gpu_scene::VolumeSet set = test.volumes;
  set.uses.resize(test.scene.media.size());
  return {probeDevice(), test.scene, set, gpu_scene::GridLayout::Paths};
}

TEST(RayChoice, TakesTheTreeOnACpuWithoutTiming) {
  if (probeDevice().info().type != "cpu") {
    GTEST_SKIP() << probeDevice().info().name << " is no CPU";
  }
  const gpu_scene::GpuScene scene = uploaded(litRoom());
  const auto never = [](bool) -> double { throw std::logic_error("timed"); };
  EXPECT_FALSE(render::chooseRays(RayCaster::Auto, probeDevice(), scene, never).query);
  EXPECT_FALSE(render::chooseRays(RayCaster::Tree, probeDevice(), scene, never).query);
}

TEST(RayChoice, TakesWhatIsFaster) {
  EXPECT_TRUE(render::fasterRays([](bool query) { return query ? 1.0 : 2.0; }).query);
  const render::RayChoice tree = render::fasterRays([](bool query) { return query ? 3.0 : 2.0; });
  EXPECT_FALSE(tree.query);
  EXPECT_NE(tree.reason.find("1.50 times"), std::string::npos) << tree.reason;
  // A probe's first time, which compiles, does not count, nor do disturbed ones.
  int calls = 0;
  EXPECT_TRUE(render::fasterRays([&](bool query) { return query && calls++ != 3 ? 100.0 : query ? 1.0 : 2.0; }).query);
}

TEST(RayChoice, IsRefusedWhereTheDeviceCannot) {
  if (probeDevice().info().rayQuery) {
    GTEST_SKIP() << probeDevice().info().name << " has ray queries";
  }
  const gpu_scene::GpuScene scene = uploaded(litRoom());
  const auto never = [](bool) -> double { throw std::logic_error("timed"); };
  EXPECT_FALSE(render::chooseRays(RayCaster::Auto, probeDevice(), scene, never).query);
  EXPECT_THROW(render::chooseRays(RayCaster::Query, probeDevice(), scene, never), Error);
}

/// Without ray queries nothing is allocated for them.
TEST(RayChoice, TheTreeNeedsNoMore) {
  NEEDS_RAY_QUERY();
  const PathScene test = litRoom();
  const gpu_scene::GpuScene scene = uploaded(test);
  const auto bytesOf = [&](RayCaster rays) {
    const std::uint64_t before = probeDevice().allocatedBytes();
    const auto estimator = render::makeEstimator(probeDevice(), scene, test.volumes, with(rays).estimator);
    return probeDevice().allocatedBytes() - before;
  };
  const std::uint64_t tree = bytesOf(RayCaster::Tree);
  EXPECT_GT(bytesOf(RayCaster::Query), tree);
  EXPECT_EQ(bytesOf(RayCaster::Tree), tree); // all of it is given back
}

} // namespace
} // namespace tyndall::test

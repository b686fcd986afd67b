// SPDX-License-Identifier: Apache-2.0
// Points of surfaces that move: the device finds the places where they were in the previous frame.
#include "gpu_scene/surfaces.h"
#include "motion_probe_io.h"
#include "support/probe.h"

// Needs <cstdint> before it.
#include "kernels/motion_probe.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <random>

namespace tyndall::gpu_scene {
namespace {

using interop::kNoMotion;
using scene::Object;
using test::ProbeRunner;

glm::dmat4 shift(const glm::dvec3& by) { return glm::translate(glm::dmat4(1.0), by); }

glm::dvec3 apply(const glm::dmat4& map, const glm::dvec3& point) { return glm::dvec3(map * glm::dvec4(point, 1.0)); }

std::vector<glm::dvec3> onDevice(const std::vector<interop::Motion>& motions,
                                 const std::vector<interop::MovedPoint>& points) {
  const auto table = ProbeRunner::upload(motions);
  interop::Surfaces header{};
  header.motions = table.ptr();
  const auto surfaces = ProbeRunner::upload(std::vector{header});
  const auto input = ProbeRunner::upload(points);
  const auto output = ProbeRunner::results<interop::PreviousPoint>(points.size());
  const auto count = static_cast<std::uint32_t>(points.size());
  ProbeRunner(k_motion_probe_spirv)
      .run(interop::MotionProbeInputs{surfaces.ptr(), input.ptr(), output.ptr(), count}, count);
  std::vector<glm::dvec3> places;
  for (const interop::PreviousPoint& previous : ProbeRunner::download(output)) {
    places.emplace_back(previous.point);
  }
  return places;
}

/// A sheet of more triangles than are laid out in the world where it is repeated.
MeshSet sheet() {
  constexpr int kCells = 64;
  geometry::Mesh mesh;
  for (int i = 0; i < (kCells + 1) * (kCells + 1); ++i) {
    mesh.positions.emplace_back(float(i % (kCells + 1)) / kCells, float(i / (kCells + 1)) / kCells, 0.0f);
  }
  for (int i = 0; i < kCells * kCells; ++i) {
    const auto corner = static_cast<std::uint32_t>(i % kCells + i / kCells * (kCells + 1));
    mesh.triangles.emplace_back(corner, corner + 1, corner + kCells + 1);
    mesh.triangles.emplace_back(corner + 1, corner + kCells + 2, corner + kCells + 1);
  }
  MeshSet set;
  set.models.emplace_back();
  set.models.back().meshes.push_back(mesh);
  set.models.back().nodes.push_back({});
  set.uses = {0};
  return set;
}

/// One object in two frames.
struct Moving {
  Object now;
  Object before;
  glm::dvec3 centre{0.0};
  MeshSet meshes{.models = {}, .uses = {std::nullopt}, .notes = {}};
  MeshSet meshesBefore; ///< empty: the same

  PackedSurfaces packed() const {
    scene::Scene scene;
    scene.objects = {now};
    scene::Scene previous;
    previous.objects = {before};
    const Pose pose = poseOf(previous, meshesBefore.models.empty() ? meshes : meshesBefore);
    return packSurfaces(scene, meshes, {}, centre, &pose);
  }
};

/// A point of an object by its parameters, which stay its own as it moves. World space.
glm::dvec3 pointOf(const Object& object, std::size_t copy, const glm::dvec3& u) {
  glm::dvec3 own = u; // a mesh
  if (object.kind == Object::Kind::Quad) {
    own = object.origin + u.x * object.edgeU + u.y * object.edgeV;
  } else if (object.kind == Object::Kind::Box) {
    own = object.box.min + u * object.box.size();
  } else if (object.kind == Object::Kind::Sphere) {
    own = object.centre + object.radius * glm::normalize(u - 0.5);
  }
  return apply(placements(object.worldFromObject, object.instances)[copy], own);
}

/// The largest distance of a place found on the device from the true one, relative to `size`.
double error(const Moving& moving, std::size_t copy, std::uint32_t motion, double size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<interop::MovedPoint> points;
  std::vector<glm::dvec3> expected;
  for (int i = 0; i < 200; ++i) {
    const bool flat = moving.now.kind == Object::Kind::Quad || moving.now.kind == Object::Kind::Mesh;
    const glm::dvec3 u(uniform(random), uniform(random), flat ? 0.0 : uniform(random));
    points.push_back({glm::vec3(pointOf(moving.now, copy, u) - moving.centre), motion});
    expected.push_back(pointOf(moving.before, copy, u) - moving.centre);
  }
  const std::vector<glm::dvec3> found = onDevice(moving.packed().motions, points);
  double largest = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    largest = std::max(largest, glm::distance(found[i], expected[i]) / size);
  }
  return largest;
}

glm::dmat4 turned(double degrees) {
  return glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
}

constexpr double kBound = 1e-5; // a few roundings of floats

Moving sphere() {
  Moving moving;
  moving.now.kind = moving.before.kind = Object::Kind::Sphere;
  moving.now.centre = {1.0, 2.0, 3.0};
  moving.before.radius = 0.5;
  moving.before.worldFromObject = shift({0.0, 1.0, 0.0}) * turned(30.0);
  return moving;
}

Moving quad() {
  Moving moving;
  moving.now.kind = moving.before.kind = Object::Kind::Quad;
  moving.now.worldFromObject = turned(70.0);
  moving.before.origin = {2.0, 0.0, 1.0};
  moving.before.edgeU = {0.0, 3.0, 0.5};
  return moving;
}

TEST(Motion, IsThatOfTheMatrix) {
  glm::mat4x3 matrix(0.0f);
  matrix[0] = {0.0f, 2.0f, 0.0f};
  matrix[1] = {1.0f, 0.0f, 0.0f};
  matrix[2] = {0.0f, 0.0f, -1.0f};
  matrix[3] = {10.0f, 20.0f, 30.0f};
  const std::vector<glm::dvec3> places =
      onDevice({{glm::mat4x3(7.0f)}, {matrix}}, {{{1.0f, 2.0f, 3.0f}, 1}, {{1.0f, 2.0f, 3.0f}, kNoMotion}});
  EXPECT_EQ(places[0], glm::dvec3(12.0, 22.0, 27.0));
  EXPECT_EQ(places[1], glm::dvec3(1.0, 2.0, 3.0)) << "what stands still";
}

TEST(Motion, OfSpheresFollowsCentreRadiusAndTurn) {
  const Moving moving = sphere();
  EXPECT_LT(error(moving, 0, moving.packed().spheres.at(0).motion, 4.0), kBound);
}

TEST(Motion, OfQuadsFollowsTheirEdges) {
  const Moving moving = quad();
  const PackedSurfaces packed = moving.packed();
  ASSERT_EQ(packed.triangles.size(), 2u);
  EXPECT_EQ(packed.triangles[0].motion, packed.triangles[1].motion);
  EXPECT_LT(error(moving, 0, packed.triangles[0].motion, 4.0), kBound);
}

TEST(Motion, OfBoxesFollowsTheirCorners) {
  Moving moving;
  moving.now.kind = moving.before.kind = Object::Kind::Box;
  moving.now.box = {glm::dvec3(-1.0), glm::dvec3(1.0, 2.0, 3.0)};
  moving.before.box = {glm::dvec3(0.0), glm::dvec3(0.5)};
  EXPECT_LT(error(moving, 0, moving.packed().triangles.at(5).motion, 4.0), kBound);
}

TEST(Motion, OfInstancesIsEachOnesOwn) {
  Moving moving;
  moving.meshes = sheet();
  moving.now.instances = moving.before.instances = {shift({1.0, 0.0, 0.0}), shift({0.0, 0.0, 5.0})};
  moving.before.instances[0] = turned(-40.0) * shift({0.0, 2.0, 5.0});
  const PackedSurfaces packed = moving.packed();
  ASSERT_EQ(packed.instances.size(), 2u) << "copies are instanced";
  EXPECT_EQ(packed.instances[1].motion, kNoMotion);
  EXPECT_EQ(packed.triangles.at(0).motion, kNoMotion) << "they are those of both";
  EXPECT_LT(error(moving, 0, packed.instances[0].motion, 6.0), kBound);
}

TEST(Motion, OfNodesIsThatWithinTheirFile) {
  Moving moving;
  moving.now.worldFromObject = moving.before.worldFromObject = turned(15.0);
  moving.meshes = sheet();
  moving.meshes.models[0].nodes.push_back({0, shift({0.0, 0.0, 1.0})});
  moving.meshesBefore = moving.meshes;
  moving.meshesBefore.models[0].nodes[1].worldFromObject = shift({0.5, 0.0, 1.0});
  const PackedSurfaces packed = moving.packed();
  ASSERT_EQ(packed.instances.size(), 2u);
  EXPECT_EQ(packed.instances[0].motion, kNoMotion);
  const glm::dvec3 now = apply(turned(15.0), {0.25, 0.5, 1.0});
  const glm::dvec3 before = apply(turned(15.0), {0.75, 0.5, 1.0});
  const glm::dvec3 found = onDevice(packed.motions, {{glm::vec3(now), packed.instances[1].motion}})[0];
  EXPECT_LT(glm::distance(found, before), kBound);
}

TEST(Motion, FarFromTheOriginIsAsExact) {
  for (const Moving& original : {sphere(), quad()}) {
    Moving moving = original;
    moving.centre = {3e7, -2e7, 1e7};
    moving.now.worldFromObject = shift(moving.centre) * original.now.worldFromObject;
    moving.before.worldFromObject = shift(moving.centre) * original.before.worldFromObject;
    EXPECT_LT(error(moving, 0, 0, 4.0), kBound);
  }
}

TEST(Motion, ErrorsAreSeen) {
  const Moving moving = quad();
  Moving wrong = moving;
  wrong.before.edgeU.z += 1e-3; // planted
  const interop::MovedPoint corner{glm::vec3(pointOf(moving.now, 0, {1.0, 0.0, 0.0})), 0};
  const glm::dvec3 found = onDevice(wrong.packed().motions, {corner})[0];
  EXPECT_GT(glm::distance(found, pointOf(moving.before, 0, {1.0, 0.0, 0.0})) / 4.0, kBound);
}

TEST(Motion, WhatStandsStillHasNone) {
  Moving moving = quad();
  moving.before = moving.now;
  const PackedSurfaces packed = moving.packed();
  EXPECT_TRUE(packed.motions.empty());
  EXPECT_EQ(packed.triangles.at(0).motion, kNoMotion);
}

TEST(Motion, FramesOfOtherObjectsHaveNone) {
  scene::Scene scene;
  scene.objects = {quad().now, sphere().now};
  const auto motionsAfter = [&](const std::vector<Object>& before) {
    scene::Scene previous;
    previous.objects = before;
    const Pose pose{previous, std::vector<std::vector<geometry::Node>>(before.size())};
    return packSurfaces(scene, {.models = {}, .uses = {{}, {}}, .notes = {}}, {}, glm::dvec3(0.0), &pose)
        .motions.size();
  };
  Object copied = quad().before;
  copied.instances = {shift({1.0, 0.0, 0.0}), shift({2.0, 0.0, 0.0})};
  EXPECT_EQ(motionsAfter({quad().before, sphere().before}), 2u);
  EXPECT_EQ(motionsAfter({quad().before}), 0u) << "another number";
  EXPECT_EQ(motionsAfter({sphere().before, quad().before}), 0u) << "another kind";
  EXPECT_EQ(motionsAfter({copied, sphere().before}), 0u) << "another number of copies";
}

} // namespace
} // namespace tyndall::gpu_scene

// SPDX-License-Identifier: Apache-2.0
// What must not change a picture of surfaces and media (docs/theory.md A10).
#include "support/path_scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

const glm::dvec3 kFogLow(-1.2, -0.95, -1.0);
const glm::dvec3 kFogHigh(1.2, 0.9, 1.0);

/// A ball on a floor, a lamp above and a glowing ball in the wall of the fog that `fog` adds.
struct Room : PathScene {
  double size;
  glm::dvec3 centre;

  explicit Room(double scale = 1.0, const glm::dvec3& middle = glm::dvec3(0.0))
      : PathScene({16, 16}), size(scale), centre(middle) {
    perspective(at({0.4, 0.8, 3.6}), at({0.0, -0.1, 0.0}), 38.0);
    material("floor", MaterialId::Diffuse, 0.6);
    geometry::Material& metal = material("metal", MaterialId::MetalRough, 0.8);
    metal.metallic = 0.5;
    metal.roughness = 0.5;
    lamp("lamp", 6.0);
    quad("floor", at({-6.0, -1.0, 6.0}), size * glm::dvec3(12.0, 0.0, 0.0), size * glm::dvec3(0.0, 0.0, -12.0));
    ball("metal", at({-0.6, -0.4, -0.2}), 0.4 * size);
    ball("lamp", at({1.2, 0.2, 0.3}), 0.15 * size);
  }

  glm::dvec3 at(const glm::dvec3& point) const { return centre + size * point; }
  /// Faces downwards.
  void ceilingLamp() {
    quad("lamp", at({-0.5, 1.2, -0.4}), size * glm::dvec3(1.0, 0.0, 0.0), size * glm::dvec3(0.0, 0.0, 0.8));
  }
  scene::Medium& fog(const glm::dvec3& low, const glm::dvec3& high, double sigmaT) {
    scene::Medium& medium = box(at(low), at(high), sigmaT / size, 0.9);
    medium.phase = henyeyGreenstein(0.3);
    return medium;
  }
  void wholeFog() { fog(kFogLow, kFogHigh, 0.5); }
};

Moments rendered(const TestScene& test, std::uint32_t firstSeed = 1001) {
  return renderMoments(test.scene, test.volumes, byPaths({.replicates = 16, .samples = 32, .firstSeed = firstSeed}));
}

/// Fewer samples are enough to see what is wrong.
Moments planted(const TestScene& test, std::uint32_t bug = interop::kBugNone) {
  const MomentOptions options = byPaths({.replicates = 8, .samples = 32, .firstSeed = 1001});
  return renderMoments(test.scene, test.volumes, withBug(options, bug));
}

const Moments& plainRoom() {
  static const Moments moments = [] {
    Room room;
    room.ceilingLamp();
    room.wholeFog();
    return rendered(room, 1);
  }();
  return moments;
}

/// One standard error of the image is some 0.7 % in all of these.
TEST(PathInvariance, OfDensityTimesSizeFarFromTheOrigin) {
  Room room(37.0, {1e5, -1e5, 1e5});
  room.ceilingLamp();
  room.wholeFog();
  EXPECT_AGREES(tileTest(plainRoom(), rendered(room)));
  room.scene.media[0].sigmaT *= 1.3; // planted
  EXPECT_DIFFERS(tileTest(plainRoom(), planted(room)));
}

/// Cut where both lamps see it, one half laid over itself.
TEST(PathInvariance, OfFogCutInTwoAndLaidOverItself) {
  Room room;
  room.ceilingLamp();
  room.fog(kFogLow, {0.1, kFogHigh.y, kFogHigh.z}, 0.3);
  room.fog(kFogLow, {0.1, kFogHigh.y, kFogHigh.z}, 0.2);
  room.fog({0.1, kFogLow.y, kFogLow.z}, kFogHigh, 0.5);
  EXPECT_AGREES(tileTest(plainRoom(), rendered(room)));
}

/// Two triangles, cut along the other diagonal than a quad's.
geometry::Mesh ceilingMesh() {
  geometry::Mesh mesh;
  mesh.positions = {{-0.5f, 1.2f, -0.4f}, {0.5f, 1.2f, -0.4f}, {0.5f, 1.2f, 0.4f}, {-0.5f, 1.2f, 0.4f}};
  mesh.triangles = {{1, 2, 3}, {1, 3, 0}};
  return mesh;
}

/// Fog in a container of a null material, whose wall one lamp is set into; the other one as a mesh.
TEST(PathInvariance, OfAContainerAndOfALampAsAMesh) {
  Room room;
  room.mesh("lamp", ceilingMesh());
  room.material("container", MaterialId::Null);
  room.crate("container", kFogLow, kFogHigh);
  room.fill(0.5, 0.9).phase = henyeyGreenstein(0.3);
  EXPECT_AGREES(tileTest(plainRoom(), rendered(room)));
  EXPECT_DIFFERS(tileTest(plainRoom(), planted(room, interop::kBugLineRestart)));
}

/// The camera stands in a ball of fog; what glows is a ball of fog in it, of its own container too.
TEST(PathInvariance, OfRoundContainersAroundTheCamera) {
  const scene::Phase phase = henyeyGreenstein(0.5);
  Room shapes;
  shapes.sphere({0.0, 0.0, 2.6}, 3.1, 0.2, 0.8).phase = phase;
  shapes.sphere({0.2, 0.4, 0.2}, 0.4, 0.7, 0.5).emission = scene::Emission{};
  Room containers;
  containers.material("container", MaterialId::Null);
  containers.ball("container", {0.0, 0.0, 2.6}, 3.1);
  containers.fill(0.2, 0.8).phase = phase;
  containers.ball("container", {0.2, 0.4, 0.2}, 0.4);
  containers.fill(0.7, 0.5).emission = scene::Emission{};
  const Moments reference = rendered(shapes, 1);
  EXPECT_AGREES(tileTest(reference, rendered(containers)));
  containers.scene.objects.back().radius = 0.44; // planted
  EXPECT_DIFFERS(tileTest(reference, planted(containers)));
}

/// A bumpy sheet of 48 x 48 x 2 triangles, enough for copies of it to be instances.
geometry::Mesh sheet() {
  constexpr int kCells = 48;
  geometry::Mesh mesh;
  for (int j = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i) {
      const double x = 2.0 * i / kCells - 1.0;
      const double z = 2.0 * j / kCells - 1.0;
      mesh.positions.emplace_back(x, 0.15 * std::sin(7.0 * x) * std::cos(5.0 * z), z);
    }
  }
  for (unsigned j = 0; j < kCells; ++j) {
    for (unsigned i = 0; i < kCells; ++i) {
      const unsigned corner = j * (kCells + 1) + i;
      mesh.triangles.emplace_back(corner, corner + kCells + 1, corner + 1);
      mesh.triangles.emplace_back(corner + 1, corner + kCells + 1, corner + kCells + 2);
    }
  }
  return mesh;
}

TEST(PathInvariance, OfInstances) {
  const glm::dmat4 first = glm::translate(glm::dmat4(1.0), {0.3, -0.6, 0.2});
  const glm::dmat4 second = glm::scale(
      glm::rotate(glm::translate(glm::dmat4(1.0), {-0.5, 0.5, -0.4}), 0.8, glm::normalize(glm::dvec3(1.0, 0.3, 0.6))),
      {0.7, -0.5, 0.6}); // mirrored
  Room instanced;
  instanced.wholeFog();
  instanced.mesh("metal", sheet()).instances = {first, second};
  Room laidOut;
  laidOut.wholeFog();
  laidOut.mesh("metal", sheet()).worldFromObject = first;
  laidOut.mesh("metal", sheet()).worldFromObject = second;
  const Moments reference = rendered(laidOut, 1);
  EXPECT_AGREES(tileTest(reference, rendered(instanced)));
  instanced.scene.objects.back().instances[1][3].y += 0.4; // planted
  EXPECT_DIFFERS(tileTest(reference, planted(instanced)));
}

double reflectance(double a, double b) { return (a - b) * (a - b) / ((a + b) * (a + b)); }

/// Glass from z = 0 to 1 on liquid down to z = 3, which absorbs. The liquid's box reaches `overlap` into the glass; the
/// glass decides there, about what fills the place too.
PathScene layers(double overlap) {
  PathScene test({8, 8});
  test.orthographic({0.0, 0.0, -2.0}, {0.0, 0.0, 0.0}, 0.1);
  test.material("glass", MaterialId::Dielectric, 1.0).ior = 1.5;
  test.material("liquid", MaterialId::Dielectric, 1.0).ior = 1.2;
  test.lamp("lamp", 1.0);
  test.crate("glass", {-50.0, -50.0, 0.0}, {50.0, 50.0, 1.0}).priority = 2;
  test.crate("liquid", {-50.0, -50.0, 1.0 - overlap}, {50.0, 50.0, 3.0}).priority = 1;
  test.fill(0.4, 0.0);
  test.quad("lamp", {-60.0, -60.0, 5.0}, {0.0, 120.0, 0.0}, {120.0, 0.0, 0.0});
  return test;
}

/// Straight through three interfaces, all reflections between them added up: boundaries that overlap are one interface
/// between glass and liquid. One standard error is 0.3 %.
TEST(Priority, MakesOverlappingBoundariesOneInterface) {
  const double outer = reflectance(1.0, 1.5);
  const double between = reflectance(1.5, 1.2);
  const double inner = reflectance(1.2, 1.0);
  // Air, glass, liquid: what goes through, and what returns from below.
  const double through = (1.0 - outer) * (1.0 - between) / (1.0 - outer * between);
  const double returned = between + (1.0 - between) * (1.0 - between) * outer / (1.0 - outer * between);
  const double kept = std::exp(-0.4 * 2.0);
  const double reference = through * kept * (1.0 - inner) / (1.0 - returned * inner * kept * kept);
  for (const double overlap : {0.1, 0.6}) {
    const PathScene test = layers(overlap);
    const MomentOptions options = byPaths({.replicates = 24, .samples = 128});
    EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), reference, 0, 1e-5)) << overlap;
    if (overlap == 0.6) {
      const MomentOptions bad = withBug(options, interop::kBugNoPriority);
      EXPECT_DIFFERS(imageTest(renderMoments(test.scene, test.volumes, bad), reference, 0, 1e-5));
    }
  }
}

} // namespace
} // namespace tyndall::test

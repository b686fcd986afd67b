// SPDX-License-Identifier: Apache-2.0
// What must not change a picture (docs/theory.md A10), and agreement of the two trackers.
#include "support/render_fixture.h"
#include "support/render_scenes.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace tyndall::test {
namespace {

constexpr int kCount = 14;

double puff(const glm::dvec3& u) {
  const glm::dvec3 p = 2.0 * u / double(kCount - 1) - 1.0;
  return std::max(0.0, 1.0 - glm::dot(p, p)) * (1.5 + std::sin(5.0 * p.x) * std::cos(4.0 * p.y + p.z));
}

/// A puff without symmetry in [-1, 1]^3; index `first` is its first voxel.
volume::BrickGrid puffGrid(const glm::ivec3& first = glm::ivec3(0), volume::Storage storage = volume::Storage::Float) {
  const double voxel = 2.0 / (kCount - 1);
  const glm::dmat4 worldFromIndex = glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0) - voxel * glm::dvec3(first)), glm::dvec3(voxel));
  return gridOf(glm::ivec3(kCount), first, worldFromIndex, [first](const glm::ivec3& index) { return puff(glm::dvec3(index - first)); }, storage);
}

/// Camera and lights of all these scenes.
TestScene stage(double size = 1.0, const glm::dvec3& centre = glm::dvec3(0.0)) {
  TestScene test({16, 16});
  test.perspective(centre + size * glm::dvec3(1.0, 0.5, 4.0), centre, 35.0);
  test.point(centre + size * glm::dvec3(1.5, 1.0, 0.5), 4.0 * size * size);
  test.sun({0.4, -1.0, -0.3}, 1.0);
  return test;
}

TestScene puffScene(const volume::BrickGrid& grid, double density = 1.0) {
  TestScene test = stage();
  test.grid(grid, density, 0.9).phase = henyeyGreenstein(0.3);
  return test;
}

/// Independent seeds for the second of two configurations.
Moments render(const TestScene& test, std::uint32_t firstSeed, std::uint32_t replicates = 64) {
  return renderMoments(test.scene, test.volumes, {.replicates = replicates, .firstSeed = firstSeed});
}

Verdict compare(const TestScene& a, const TestScene& b, double tolerance = 2e-6) {
  return tileTest(render(a, 1), render(b, 100001), tolerance);
}

TEST(Invariance, OfDensityTimesSize) {
  constexpr double kFactor = 37.0;
  TestScene small = stage(1.0 / kFactor);
  volume::BrickGrid grid = puffGrid();
  grid.worldFromIndex = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / kFactor)) * grid.worldFromIndex;
  small.grid(grid, kFactor, 0.9).phase = henyeyGreenstein(0.3);
  EXPECT_AGREES(compare(puffScene(puffGrid()), small));
  small.scene.media[0].densityScale *= 1.05; // planted
  EXPECT_DIFFERS(compare(puffScene(puffGrid()), small));
}

TEST(Invariance, OfAHomogeneousBoxCutInTwo) {
  TestScene whole = stage();
  whole.box(glm::dvec3(-1.0), glm::dvec3(1.0), 0.8, 0.9);
  TestScene halves = stage();
  halves.box(glm::dvec3(-1.0), {0.25, 1.0, 1.0}, 0.8, 0.9);
  halves.box({0.25, -1.0, -1.0}, glm::dvec3(1.0), 0.8, 0.9);
  EXPECT_AGREES(compare(whole, halves));
  halves.scene.media[0].box.max.x = 0.3; // planted: they overlap
  EXPECT_DIFFERS(compare(whole, halves));
}

/// Two media of half the density in the same place: sums of Poisson processes.
TEST(Invariance, OfOverlappingHalves) {
  TestScene homogeneous = stage();
  homogeneous.box(glm::dvec3(-1.0), glm::dvec3(1.0), 0.8, 0.9);
  TestScene twoHomogeneous = stage();
  twoHomogeneous.box(glm::dvec3(-1.0), glm::dvec3(1.0), 0.5, 0.9);
  twoHomogeneous.box(glm::dvec3(-1.0), glm::dvec3(1.0), 0.3, 0.9);
  EXPECT_AGREES(compare(homogeneous, twoHomogeneous)) << "\ntwo homogeneous";

  const TestScene grid = puffScene(puffGrid());
  TestScene twoGrids = puffScene(puffGrid(), 0.5);
  twoGrids.grid(puffGrid(), 0.5, 0.9).phase = henyeyGreenstein(0.3);
  EXPECT_AGREES(compare(grid, twoGrids)) << "\ntwo grids";
  twoGrids.scene.media[1].phase = henyeyGreenstein(-0.3); // planted: the other medium's phase function
  EXPECT_DIFFERS(compare(grid, twoGrids));
}

/// Each of a grid and a homogeneous medium around it taken apart into two.
TEST(Invariance, OfAGridInAHomogeneousMedium) {
  const double voxel = 2.0 / (kCount - 1);
  const glm::dvec3 edge(1.0 + voxel);
  TestScene one = puffScene(puffGrid());
  one.box(-edge, edge, 0.4, 0.9).phase = henyeyGreenstein(0.3);
  TestScene three = puffScene(puffGrid(), 0.7);
  three.box(-edge, edge, 0.2, 0.9).phase = henyeyGreenstein(0.3);
  three.box(-edge, edge, 0.2, 0.9).phase = henyeyGreenstein(0.3);
  three.grid(puffGrid(), 0.3, 0.9).phase = henyeyGreenstein(0.3);
  EXPECT_AGREES(compare(one, three));
  three.scene.media[3].densityScale = 0.2; // planted
  EXPECT_DIFFERS(compare(one, three));
}

TEST(Invariance, OfTheOrderOfMedia) {
  TestScene a = stage();
  a.box(glm::dvec3(-1.0), {1.0, 0.0, 1.0}, 0.8, 0.9);
  a.grid(puffGrid(), 1.0, 0.6);
  a.sphere({0.3, 0.2, 0.1}, 0.5, 0.7, 0.3);
  TestScene b = stage();
  b.sphere({0.3, 0.2, 0.1}, 0.5, 0.7, 0.3);
  b.grid(puffGrid(), 1.0, 0.6);
  b.box(glm::dvec3(-1.0), {1.0, 0.0, 1.0}, 0.8, 0.9);
  EXPECT_AGREES(compare(a, b));
  b.scene.media[0].albedo = glm::dvec3(0.4); // planted
  EXPECT_DIFFERS(compare(a, b));
}

TEST(Invariance, OfAGridTurnedByNinetyDegrees) {
  // Index axes permuted and flipped, the transform turned the other way: the same field in the world.
  const volume::BrickGrid upright = puffGrid();
  glm::dmat4 turn(0.0); // upright index from turned index: x = j, y = n - i, z = k
  turn[1][0] = 1.0;
  turn[0][1] = -1.0;
  turn[2][2] = 1.0;
  turn[3] = glm::dvec4(0.0, kCount - 1.0, 0.0, 1.0);
  const volume::BrickGrid turned = gridOf(glm::ivec3(kCount), glm::ivec3(0), upright.worldFromIndex * turn,
                                          [](const glm::ivec3& index) { return puff(glm::dvec3(index.y, kCount - 1 - index.x, index.z)); });
  EXPECT_AGREES(compare(puffScene(upright), puffScene(turned)));
  volume::BrickGrid wrong = turned;
  wrong.worldFromIndex = upright.worldFromIndex; // planted: the field turned, its transform not
  EXPECT_DIFFERS(compare(puffScene(upright), puffScene(wrong)));
}

TEST(Invariance, OfIndexOffsets) {
  const TestScene reference = puffScene(puffGrid());
  for (const glm::ivec3& first : {glm::ivec3(-1, -9, -1000), glm::ivec3(5, 100000, 7)}) {
    EXPECT_AGREES(compare(reference, puffScene(puffGrid(first)))) << first.x;
  }
  volume::BrickGrid wrong = puffGrid({3, 3, 3});
  wrong.worldFromIndex = puffGrid().worldFromIndex; // planted: an offset that the transform does not know
  EXPECT_DIFFERS(compare(reference, puffScene(wrong)));
}

TEST(Invariance, OfStorageWithinItsStatedError) {
  const TestScene reference = puffScene(puffGrid());
  for (const auto storage : {volume::Storage::Unorm8, volume::Storage::Half}) {
    // Optical depths agree to 1 % (docs/scene-format.md): so do pictures of optical depth about 1.
    EXPECT_AGREES(compare(reference, puffScene(puffGrid(glm::ivec3(0), storage)), 0.01)) << volume::storageName(storage);
  }
}

TEST(Invariance, OfTheDistanceFromTheOrigin) {
  const glm::dvec3 far(1e5, -1e5, 1e5);
  TestScene moved = stage(1.0, far);
  volume::BrickGrid grid = puffGrid();
  grid.worldFromIndex = glm::translate(glm::dmat4(1.0), far) * grid.worldFromIndex;
  moved.grid(grid, 1.0, 0.9).phase = henyeyGreenstein(0.3);
  EXPECT_AGREES(compare(puffScene(puffGrid()), moved));
  moved.scene.camera.position.x += 0.05; // planted: what float would make of 1e5 + 1
  EXPECT_DIFFERS(compare(puffScene(puffGrid()), moved));
}

/// The medium's own transform and the grid's are one map.
TEST(Invariance, OfWhereTheTransformIs) {
  const glm::dmat4 map = affineMaps().back().worldFromIndex;
  volume::BrickGrid grid = puffGrid();
  TestScene a = stage();
  a.grid(grid, 1.0, 0.9).worldFromMedium = map;
  grid.worldFromIndex = map * grid.worldFromIndex;
  TestScene b = stage();
  b.grid(grid, 1.0, 0.9);
  EXPECT_AGREES(compare(a, b));
}

/// Weighted walk and delta tracking share no distance sampling.
TEST(Trackers, AgreeOnTheProjectsVolumes) {
  for (const char* name : {"volumes/cloud.vdb", "volumes/plume.vdb"}) {
    const volume::BrickGrid grid = volume::loadGrid(name, {});
    const Bounds3 bounds = grid.worldBounds();
    const double size = glm::length(bounds.size());
    TestScene test({32, 32});
    test.perspective(bounds.centre() + size * glm::dvec3(0.3, 0.2, 1.2), bounds.centre(), 45.0);
    test.sun({0.4, -1.0, -0.6}, 2.0, 0.5);
    test.constant(0.2);
    test.grid(grid, 8.0 / size, 0.95).phase = henyeyGreenstein(0.5);
    MomentOptions weighted{.replicates = 16};
    MomentOptions delta{.replicates = 32, .firstSeed = 100001};
    delta.estimator.deltaTracking = true;
    const Moments reference = renderMoments(test.scene, test.volumes, weighted);
    EXPECT_AGREES(tileTest(reference, renderMoments(test.scene, test.volumes, delta))) << name;
    TestScene dense = test;
    dense.scene.media[0].densityScale *= 1.1; // planted
    EXPECT_DIFFERS(tileTest(reference, renderMoments(dense.scene, dense.volumes, delta))) << name;
  }
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// What must not change a picture (docs/theory.md A10), and agreement of the methods on files.
#include "support/render_fixture.h"
#include "support/render_scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace tyndall::test {
namespace {

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

/// One scene by each method: what others are compared with.
class Pictures {
public:
  explicit Pictures(const TestScene& test) {
    for (const MomentOptions& options : eachMethod({.replicates = 64})) {
      moments_.push_back(renderMoments(test.scene, test.volumes, options));
    }
  }

  void expectSame(const TestScene& other, double tolerance = 2e-6) const { compare(other, true, tolerance); }
  void expectDifferent(const TestScene& other) const { compare(other, false, 2e-6); }

private:
  void compare(const TestScene& other, bool same, double tolerance) const {
    std::size_t method = 0;
    // Seeds of their own, so that the two are independent.
    for (const MomentOptions& options : eachMethod({.replicates = 64, .firstSeed = 100001})) {
      const Verdict verdict =
          tileTest(moments_[method++], renderMoments(other.scene, other.volumes, options), tolerance);
      EXPECT_EQ(verdict.agrees(), same) << nameOf(options) << ": " << verdict.text();
    }
  }

  std::vector<Moments> moments_; // by method
};

/// What most of these tests compare with, made once.
const Pictures& puffPictures() {
  static const Pictures pictures(puffScene(puffGrid()));
  return pictures;
}

TEST(Invariance, OfDensityTimesSize) {
  constexpr double kFactor = 37.0;
  TestScene small = stage(1.0 / kFactor);
  volume::BrickGrid grid = puffGrid();
  grid.worldFromIndex = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / kFactor)) * grid.worldFromIndex;
  small.grid(grid, kFactor, 0.9).phase = henyeyGreenstein(0.3);
  const Pictures& pictures = puffPictures();
  pictures.expectSame(small);
  small.scene.media[0].densityScale *= 1.05; // planted
  pictures.expectDifferent(small);
}

TEST(Invariance, OfAHomogeneousBoxCutInTwo) {
  TestScene whole = stage();
  whole.box(glm::dvec3(-1.0), glm::dvec3(1.0), 0.8, 0.9);
  TestScene halves = stage();
  halves.box(glm::dvec3(-1.0), {0.25, 1.0, 1.0}, 0.8, 0.9);
  halves.box({0.25, -1.0, -1.0}, glm::dvec3(1.0), 0.8, 0.9);
  const Pictures pictures(whole);
  pictures.expectSame(halves);
  halves.scene.media[0].box.max.x = 0.3; // planted: they overlap
  pictures.expectDifferent(halves);
}

/// Two media of half the density in the same place: sums of Poisson processes.
TEST(Invariance, OfOverlappingHalves) {
  TestScene homogeneous = stage();
  homogeneous.box(glm::dvec3(-1.0), glm::dvec3(1.0), 0.8, 0.9);
  TestScene twoHomogeneous = stage();
  twoHomogeneous.box(glm::dvec3(-1.0), glm::dvec3(1.0), 0.5, 0.9);
  twoHomogeneous.box(glm::dvec3(-1.0), glm::dvec3(1.0), 0.3, 0.9);
  Pictures(homogeneous).expectSame(twoHomogeneous);

  const Pictures& grid = puffPictures();
  TestScene twoGrids = puffScene(puffGrid(), 0.5);
  twoGrids.grid(puffGrid(), 0.5, 0.9).phase = henyeyGreenstein(0.3);
  grid.expectSame(twoGrids);
  twoGrids.scene.media[1].phase = henyeyGreenstein(-0.3); // planted: the other medium's phase function
  grid.expectDifferent(twoGrids);
}

/// Each of a grid and a homogeneous medium around it taken apart into two.
TEST(Invariance, OfAGridInAHomogeneousMedium) {
  const double voxel = 2.0 / (kPuffVoxels - 1);
  const glm::dvec3 edge(1.0 + voxel);
  TestScene one = puffScene(puffGrid());
  one.box(-edge, edge, 0.4, 0.9).phase = henyeyGreenstein(0.3);
  TestScene three = puffScene(puffGrid(), 0.7);
  three.box(-edge, edge, 0.2, 0.9).phase = henyeyGreenstein(0.3);
  three.box(-edge, edge, 0.2, 0.9).phase = henyeyGreenstein(0.3);
  three.grid(puffGrid(), 0.3, 0.9).phase = henyeyGreenstein(0.3);
  const Pictures pictures(one);
  pictures.expectSame(three);
  three.scene.media[3].densityScale = 0.2; // planted
  pictures.expectDifferent(three);
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
  const Pictures pictures(a);
  pictures.expectSame(b);
  b.scene.media[0].albedo = glm::dvec3(0.4); // planted
  pictures.expectDifferent(b);
}

TEST(Invariance, OfAGridTurnedByNinetyDegrees) {
  // Index axes permuted and flipped, the transform turned the other way: the same field in the world.
  const volume::BrickGrid upright = puffGrid();
  glm::dmat4 turn(0.0); // upright index from turned index: x = j, y = n - i, z = k
  turn[1][0] = 1.0;
  turn[0][1] = -1.0;
  turn[2][2] = 1.0;
  turn[3] = glm::dvec4(0.0, kPuffVoxels - 1.0, 0.0, 1.0);
  const volume::BrickGrid turned =
      gridOf(glm::ivec3(kPuffVoxels), glm::ivec3(0), upright.worldFromIndex * turn, [](const glm::ivec3& index) {
        return puffDensity(glm::dvec3(index.y, kPuffVoxels - 1 - index.x, index.z));
      });
  const Pictures& pictures = puffPictures();
  pictures.expectSame(puffScene(turned));
  volume::BrickGrid wrong = turned;
  wrong.worldFromIndex = upright.worldFromIndex; // planted: the field turned, its transform not
  pictures.expectDifferent(puffScene(wrong));
}

TEST(Invariance, OfIndexOffsets) {
  const Pictures& pictures = puffPictures();
  pictures.expectSame(puffScene(puffGrid({-9, 100000, -1000})));
  volume::BrickGrid wrong = puffGrid({3, 3, 3});
  wrong.worldFromIndex = puffGrid().worldFromIndex; // planted: an offset that the transform does not know
  pictures.expectDifferent(puffScene(wrong));
}

TEST(Invariance, OfStorageWithinItsStatedError) {
  const Pictures& pictures = puffPictures();
  for (const auto storage : {volume::Storage::Unorm8, volume::Storage::Half}) {
    // Optical depths agree to 1 % (docs/scene-format.md): so do pictures of optical depth about 1.
    SCOPED_TRACE(volume::storageName(storage));
    pictures.expectSame(puffScene(puffGrid(glm::ivec3(0), storage)), 0.01);
  }
}

TEST(Invariance, OfTheDistanceFromTheOrigin) {
  const glm::dvec3 far(1e5, -1e5, 1e5);
  TestScene moved = stage(1.0, far);
  volume::BrickGrid grid = puffGrid();
  grid.worldFromIndex = glm::translate(glm::dmat4(1.0), far) * grid.worldFromIndex;
  moved.grid(grid, 1.0, 0.9).phase = henyeyGreenstein(0.3);
  const Pictures& pictures = puffPictures();
  pictures.expectSame(moved);
  moved.scene.camera.position.x += 0.05; // planted: what float would make of 1e5 + 1
  pictures.expectDifferent(moved);
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
  Pictures(a).expectSame(b);
}

/// The puff's voxels dealt out to two grids of other sizes and bricks: each cell has one of its own or two.
TEST(Invariance, OfComplementaryGrids) {
  const auto share = [](bool first, const glm::ivec3& size, const glm::ivec3& from) {
    return gridOf(size, from, puffGrid().worldFromIndex, [first](const glm::ivec3& index) {
      return (index.x + 2 * index.y - index.z < 9) == first ? puffDensity(glm::dvec3(index)) : 0.0;
    });
  };
  TestScene both = puffScene(share(true, glm::ivec3(kPuffVoxels), glm::ivec3(0)));
  both.grid(share(false, {kPuffVoxels, kPuffVoxels - 2, kPuffVoxels}, {0, 2, 0}), 1.0, 0.9).phase =
      henyeyGreenstein(0.3);
  const Pictures& pictures = puffPictures();
  pictures.expectSame(both);
  both.volumes.grids[1] =
      share(false, {kPuffVoxels, kPuffVoxels - 4, kPuffVoxels}, {0, 4, 0}); // planted: some voxels are lost
  pictures.expectDifferent(both);
}

/// A file cut in two by clip boxes between two layers of voxels, each rounded outwards to its last own one.
TEST(Invariance, OfAVolumeCutInTwoByClipBoxes) {
  volume::LoadOptions load;
  load.storage = volume::Storage::Float;
  const volume::BrickGrid whole = volume::loadGrid("volumes/plume.vdb", load);
  const Bounds3 bounds = whole.worldBounds();
  const double size = glm::length(bounds.size());
  const int last = (whole.indexMin.y + whole.indexMax.y) / 2; // layer of the first part
  const auto layer = [&](double y) { return glm::dvec3(whole.worldFromIndex * glm::dvec4(0.0, y, 0.0, 1.0)).y; };
  const auto part = [&](double low, double high) {
    load.clip =
        Bounds3{{bounds.min.x - size, low, bounds.min.z - size}, {bounds.max.x + size, high, bounds.max.z + size}};
    return volume::loadGrid("volumes/plume.vdb", load);
  };
  TestScene stage({16, 16});
  stage.perspective(bounds.centre() + size * glm::dvec3(0.3, 0.2, 1.2), bounds.centre(), 45.0);
  stage.sun({0.4, -1.0, -0.6}, 2.0);
  TestScene one = stage;
  one.grid(whole, 8.0 / size, 0.95);
  TestScene two = stage;
  two.grid(part(bounds.min.y - size, layer(last - 0.3)), 8.0 / size, 0.95);
  two.grid(part(layer(last + 1.3), bounds.max.y + size), 8.0 / size, 0.95);
  const Pictures pictures(one);
  pictures.expectSame(two);
  two.volumes.grids[1] = part(layer(last + 8.3), bounds.max.y + size); // planted: some layers are lost
  pictures.expectDifferent(two);
}

/// Weighted walk, delta tracking and march share no distance sampling.
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
    const Moments reference = renderMoments(test.scene, test.volumes, {.replicates = 16});
    TestScene dense = test;
    dense.scene.media[0].densityScale *= 1.1; // planted
    MomentOptions delta{.replicates = 32, .firstSeed = 100001};
    delta.estimator.deltaTracking = true;
    for (const MomentOptions& options : {delta, eachMethod({.firstSeed = 100001}).back()}) {
      EXPECT_AGREES(tileTest(reference, renderMoments(test.scene, test.volumes, options))) << name << nameOf(options);
      EXPECT_DIFFERS(tileTest(reference, renderMoments(dense.scene, dense.volumes, options)))
          << name << nameOf(options);
    }
  }
}

} // namespace
} // namespace tyndall::test

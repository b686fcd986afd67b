// SPDX-License-Identifier: Apache-2.0
#include "support/fixtures.h"
#include "volume/depth.h"
#include "volume/load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tyndall::volume {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

BrickGrid randomGrid(const glm::dmat4& worldFromIndex) {
  std::mt19937 random(5);
  std::vector<float> values(13 * 9 * 17);
  for (float& value : values) {
    value = float(random() % 1000) / 250.0f;
  }
  return gridFromDense(values, {13, 9, 17}, {-5, 3, 100}, worldFromIndex);
}

/// Midpoint rule over value(): slow and independent.
double bruteForce(const BrickGrid& grid, const glm::dvec3& from, const glm::dvec3& to, int steps) {
  const glm::dmat4 indexFromWorld = glm::inverse(grid.worldFromIndex);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec3 world = glm::mix(from, to, (double(i) + 0.5) / double(steps));
    sum += grid.value(glm::dvec3(indexFromWorld * glm::dvec4(world, 1.0)));
  }
  return sum / double(steps) * glm::length(to - from);
}

glm::dvec3 worldOf(const BrickGrid& grid, const glm::dvec3& index) {
  return glm::dvec3(grid.worldFromIndex * glm::dvec4(index, 1.0));
}

double between(const BrickGrid& grid, const glm::dvec3& from, const glm::dvec3& to) {
  return exactOpticalDepth(grid, from, glm::normalize(to - from), 0.0, glm::length(to - from));
}

TEST(ExactOpticalDepth, AgreesWithFineQuadratureUnderAnyTransform) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  for (const test::NamedTransform& transform : test::affineTransforms()) {
    const BrickGrid grid = randomGrid(transform.worldFromIndex);
    const Bounds3 bounds = grid.indexBounds();
    for (int i = 0; i < 12; ++i) {
      const auto point = [&] {
        return worldOf(grid, bounds.centre() + bounds.size() * glm::dvec3(uniform(random), uniform(random), uniform(random)));
      };
      const glm::dvec3 from = point();
      const glm::dvec3 to = point();
      const double expected = bruteForce(grid, from, to, 100'000);
      EXPECT_NEAR(between(grid, from, to), expected, 1e-6 * (1.0 + expected)) << transform.name;
    }
  }
}

TEST(ExactOpticalDepth, AxisParallelRaysOnVoxelPlanesAndEdges) {
  const BrickGrid grid = randomGrid(glm::dmat4(1.0));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double shift : {0.0, 0.5, 1e-9, 2.0}) {
      glm::dvec3 from(-2.0 + shift, 5.0, 104.0 + shift);
      glm::dvec3 to = from;
      from[axis] -= 40.0;
      to[axis] += 40.0;
      const double expected = bruteForce(grid, from, to, 400'000);
      EXPECT_GT(expected, 1.0);
      EXPECT_NEAR(between(grid, from, to), expected, 1e-5 * expected);
      EXPECT_NEAR(between(grid, to, from), expected, 1e-5 * expected);
    }
  }
}

TEST(ExactOpticalDepth, AxisParallelSumsAreSumsOfVoxels) {
  const BrickGrid grid = randomGrid(glm::dmat4(1.0));
  double sum = 0.0;
  for (int x = -6; x < 10; ++x) {
    sum += double(grid.voxel({x, 7, 111}));
  }
  EXPECT_NEAR(exactOpticalDepth(grid, {0, 7, 111}, {1, 0, 0}, -kInfinity, kInfinity), sum, 1e-12 * sum);
  EXPECT_NEAR(exactOpticalDepth(grid, {0, 7, 111}, {-2, 0, 0}, -kInfinity, kInfinity), sum, 1e-12 * sum)
      << "the length of the direction must not matter over the whole line";
}

/// Validation A4: the ramp's optical depth in closed form, between points inside the voxel centres.
TEST(ExactOpticalDepth, LinearRampsAreExactUnderAnyTransform) {
  const test::TemporaryFolder folder;
  test::writeFixtures(folder.path());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> inside(0.0, test::kRampVoxels - 1.0);
  for (const test::NamedTransform& transform : test::affineTransforms()) {
    for (int axis = 0; axis < 3; ++axis) {
      LoadOptions options;
      options.storage = Storage::Float;
      const std::string file = std::string("ramp_") + "xyz"[axis] + "_" + transform.name + ".vdb";
      const BrickGrid grid = loadGrid(folder / file, options);
      const auto density = [&](const glm::dvec3& i) { return double(test::kRampBase) + double(test::kRampSlope) * i[axis]; };
      for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p0(inside(random), inside(random), inside(random));
        const glm::dvec3 p1(inside(random), inside(random), inside(random));
        // The transform of the test, not the one that was read: a wrong reading must show.
        const glm::dvec3 w0(transform.worldFromIndex * glm::dvec4(p0, 1.0));
        const glm::dvec3 w1(transform.worldFromIndex * glm::dvec4(p1, 1.0));
        const double expected = glm::length(w1 - w0) * 0.5 * (density(p0) + density(p1));
        ASSERT_NEAR(between(grid, w0, w1), expected, 1e-9 * expected) << file;
        const double halfVoxelShift = glm::length(w1 - w0) * 0.5 * (density(p0 + 0.5) + density(p1 + 0.5));
        ASSERT_GT(std::abs(halfVoxelShift - expected), 1e-4 * expected) << "the test must see a half-voxel shift";
      }
    }
  }
}

TEST(ExactOpticalDepth, NothingOutsideOrInEmptyGrids) {
  EXPECT_EQ(exactOpticalDepth(BrickGrid{}, {0, 0, 0}, {0, 0, 1}, -kInfinity, kInfinity), 0.0);
  const BrickGrid grid = randomGrid(glm::dmat4(1.0));
  EXPECT_EQ(exactOpticalDepth(grid, {100, 0, 0}, {0, 1, 0}, -kInfinity, kInfinity), 0.0);
  EXPECT_EQ(exactOpticalDepth(grid, {0, 7, 111}, {1, 0, 0}, 5.0, 5.0), 0.0);
}

TEST(MedianOpticalDepth, ScalesWithDensityAndWithTheWorld) {
  const BrickGrid unit = gridFromDense(std::vector<float>(24 * 24 * 24, 1.0f), glm::ivec3(24), glm::ivec3(0), glm::dmat4(1.0));
  const BrickGrid dense = gridFromDense(std::vector<float>(24 * 24 * 24, 3.0f), glm::ivec3(24), glm::ivec3(0), glm::dmat4(1.0));
  glm::dmat4 tenfold(10.0);
  tenfold[3] = glm::dvec4(5.0, 6.0, 7.0, 1.0);
  const BrickGrid large = gridFromDense(std::vector<float>(24 * 24 * 24, 1.0f), glm::ivec3(24), glm::ivec3(0), tenfold);
  const double median = medianOpticalDepth(unit, 700);
  EXPECT_GT(median, 12.0); // chords of a cube of edge 24: most are longer than half an edge,
  EXPECT_LT(median, 42.0); // none longer than its diagonal
  EXPECT_NEAR(medianOpticalDepth(dense, 700), 3.0 * median, 1e-9 * median);
  EXPECT_NEAR(medianOpticalDepth(large, 700), 10.0 * median, 1e-6 * median);
  EXPECT_EQ(medianOpticalDepth(unit, 700), median);
  EXPECT_EQ(medianOpticalDepth(BrickGrid{}, 700), 0.0);
}

} // namespace
} // namespace tyndall::volume

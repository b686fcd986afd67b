// SPDX-License-Identifier: Apache-2.0
#include "volume/brick_grid.h"
#include "volume/load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tyndall::volume {
namespace {

constexpr Storage kStorages[] = {Storage::Unorm8, Storage::Half, Storage::Float};

struct Dense {
  glm::ivec3 size;
  std::vector<float> values;
  float at(const glm::ivec3& i) const {
    const bool inside = glm::all(glm::greaterThanEqual(i, glm::ivec3(0))) && glm::all(glm::lessThan(i, size));
    return inside ? values[std::size_t(i.x + size.x * (i.y + size.y * i.z))] : 0.0f;
  }
};

Dense randomDense(const glm::ivec3& size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0f, 3.0f);
  Dense dense{size, std::vector<float>(std::size_t(size.x * size.y * size.z))};
  for (float& value : dense.values) {
    value = random() % 3 == 0 ? 0.0f : uniform(random);
  }
  return dense;
}

/// Single bright voxels on brick corners, faces and edges, where a support that forgets its neighbours is wrong.
Dense spikes() {
  Dense dense{{25, 25, 25}, std::vector<float>(25 * 25 * 25, 0.0f)};
  for (const glm::ivec3 at : {glm::ivec3(0), glm::ivec3(8), glm::ivec3(7), glm::ivec3(16, 8, 7), glm::ivec3(15, 16, 8),
                              glm::ivec3(24), glm::ivec3(24, 0, 8), glm::ivec3(8, 23, 16)}) {
    dense.values[std::size_t(at.x + 25 * (at.y + 25 * at.z))] = 1000.0f;
  }
  return dense;
}

std::vector<BrickGrid> adversarialGrids() {
  std::vector<BrickGrid> grids;
  for (const Storage storage : kStorages) {
    for (const int shift : {0, -1, -8, 5, 1000003}) {
      const Dense random = randomDense({20, 17, 9}, unsigned(shift + 100));
      grids.push_back(gridFromDense(random.values, random.size, glm::ivec3(shift), glm::dmat4(1.0), storage));
      const Dense sharp = spikes();
      grids.push_back(gridFromDense(sharp.values, sharp.size, glm::ivec3(shift), glm::dmat4(1.0), storage));
    }
    grids.push_back(gridFromDense({5.0f}, glm::ivec3(1), glm::ivec3(-1, 7, 8), glm::dmat4(1.0), storage));
  }
  return grids;
}

/// The device's arithmetic: float lerps of decoded voxels.
float floatLookup(const BrickGrid& grid, const glm::vec3& local) {
  const glm::vec3 corner = glm::floor(local);
  const glm::vec3 f = local - corner;
  const auto at = [&](int x, int y, int z) { return grid.voxel(grid.firstVoxel + glm::ivec3(corner) + glm::ivec3(x, y, z)); };
  const auto lerp = [](float a, float b, float s) { return a + s * (b - a); };
  const float z0 = lerp(lerp(at(0, 0, 0), at(1, 0, 0), f.x), lerp(at(0, 1, 0), at(1, 1, 0), f.x), f.y);
  const float z1 = lerp(lerp(at(0, 0, 1), at(1, 0, 1), f.x), lerp(at(0, 1, 1), at(1, 1, 1), f.x), f.y);
  return lerp(z0, z1, f.z);
}

/// Lookups of random points that exceed `slack` times the majorant of their brick, or fall below its minimum.
std::size_t countViolations(const BrickGrid& grid, std::size_t points, float slack) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::size_t violations = 0;
  for (std::size_t i = 0; i < points; ++i) {
    glm::vec3 local;
    for (int axis = 0; axis < 3; ++axis) {
      const float at = uniform(random) * float(kBrickEdge * grid.brickCount[axis]);
      local[axis] = random() % 4 == 0 ? std::round(at) : at; // voxel centres and brick faces matter most
    }
    const glm::ivec3 brick = glm::min(glm::ivec3(local) / kBrickEdge, grid.brickCount - 1);
    const Range& range = grid.ranges[std::size_t(brick.x + grid.brickCount.x * (brick.y + grid.brickCount.y * brick.z))];
    const float value = floatLookup(grid, local);
    violations += value > slack * range.max || value < range.min ? 1 : 0;
  }
  return violations;
}

TEST(BrickGrid, HoldsTheDenseValuesExactlyInFloat) {
  for (const glm::ivec3 first : {glm::ivec3(0), glm::ivec3(-1, -8, -9), glm::ivec3(5, 1000000, -1000001)}) {
    const Dense dense = randomDense({11, 9, 18}, 3);
    const BrickGrid grid = gridFromDense(dense.values, dense.size, first, glm::dmat4(1.0));
    EXPECT_EQ(grid.firstVoxel & 7, glm::ivec3(0));
    for (int z = -2; z < 21; ++z) {
      for (int y = -2; y < 12; ++y) {
        for (int x = -2; x < 14; ++x) {
          ASSERT_EQ(grid.voxel(first + glm::ivec3(x, y, z)), dense.at({x, y, z}));
        }
      }
    }
  }
}

TEST(BrickGrid, BricksCoverTheFieldsDomain) {
  for (const BrickGrid& grid : adversarialGrids()) {
    const Bounds3 domain = grid.indexBounds();
    EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::dvec3(grid.firstVoxel), domain.min)));
    const glm::ivec3 end = grid.firstVoxel + kBrickEdge * grid.brickCount;
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(glm::dvec3(end), domain.max)));
    EXPECT_EQ(grid.coarseCount, (grid.brickCount + 3) / 4);
    EXPECT_EQ(grid.ranges.size(), grid.bricks.size());
  }
}

TEST(BrickGrid, ValueIsTrilinearBetweenVoxelCentres) {
  const BrickGrid grid = gridFromDense({1, 2, 3, 5, 7, 11, 13, 17}, glm::ivec3(2), glm::ivec3(7), glm::dmat4(1.0));
  EXPECT_DOUBLE_EQ(grid.value({7, 7, 7}), 1.0);
  EXPECT_DOUBLE_EQ(grid.value({8, 8, 8}), 17.0);
  EXPECT_DOUBLE_EQ(grid.value({7.5, 7, 7}), 1.5);
  EXPECT_DOUBLE_EQ(grid.value({7.5, 7.5, 7.5}), 59.0 / 8.0);
  EXPECT_DOUBLE_EQ(grid.value({6.5, 7, 7}), 0.5); // falls to 0 over the voxel outside
  EXPECT_EQ(grid.value({6, 7, 7}), 0.0);
  EXPECT_EQ(grid.value({std::nan(""), 7, 7}), 0.0);
  EXPECT_EQ(grid.maximum(), 17.0f);
}

TEST(BrickGrid, MajorantsBoundEveryLookup) {
  const std::vector<BrickGrid> grids = adversarialGrids();
  for (const BrickGrid& grid : grids) {
    EXPECT_EQ(countViolations(grid, 1'000'000 / grids.size() + 1, 1.0f), 0u) << storageName(grid.storage);
  }
  EXPECT_GT(countViolations(grids[0], 20'000, 0.9f), 0u) << "the checker must see a majorant that is 10 % low";
}

TEST(BrickGrid, CoarseMaximaBoundTheirBricks) {
  const Dense dense = randomDense({70, 41, 33}, 9);
  const BrickGrid grid = gridFromDense(dense.values, dense.size, glm::ivec3(3), glm::dmat4(1.0));
  std::vector<float> expected(grid.coarseMax.size(), 0.0f);
  for (int z = 0; z < grid.brickCount.z; ++z) {
    for (int y = 0; y < grid.brickCount.y; ++y) {
      for (int x = 0; x < grid.brickCount.x; ++x) {
        float& coarse = expected[std::size_t(x / 4 + grid.coarseCount.x * (y / 4 + grid.coarseCount.y * (z / 4)))];
        coarse = std::max(coarse, grid.ranges[std::size_t(x + grid.brickCount.x * (y + grid.brickCount.y * z))].max);
      }
    }
  }
  EXPECT_EQ(grid.coarseMax, expected);
}

TEST(BrickGrid, RangeMeanIsTheMeanOfTheField) {
  const BrickGrid grid = gridFromDense(spikes().values, glm::ivec3(25), glm::ivec3(0), glm::dmat4(1.0));
  double total = 0.0;
  for (const Range& range : grid.ranges) {
    total += double(range.mean) * kBrickVoxels;
    EXPECT_LE(range.min, range.mean);
    EXPECT_LE(range.mean, range.max);
    EXPECT_EQ(range.mean > 0.0f, range.max > 0.0f);
  }
  EXPECT_NEAR(total, 8 * 1000.0, 1e-3); // each voxel's trilinear hat integrates to its value
}

TEST(BrickGrid, ConstantRegionsTakeNoVoxels) {
  const BrickGrid grid = gridFromDense(std::vector<float>(32 * 32 * 32, 0.5f), glm::ivec3(32), glm::ivec3(0), glm::dmat4(1.0));
  EXPECT_EQ(grid.slotCount(), 0u);
  EXPECT_EQ(grid.voxel({31, 0, 16}), 0.5f);
  EXPECT_EQ(grid.voxel({32, 0, 16}), 0.0f);
}

} // namespace
} // namespace tyndall::volume

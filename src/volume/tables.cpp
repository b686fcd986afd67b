// SPDX-License-Identifier: Apache-2.0
#include "volume/tables.h"

#include "volume/decode.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tyndall::volume {
namespace {

constexpr int kSupportEdge = kBrickEdge + 1;
using Support = std::array<float, kSupportEdge * kSupportEdge * kSupportEdge>;

const BrickRecord* recordAt(const BrickGrid& grid, const glm::ivec3& brick) {
  if (glm::any(glm::greaterThanEqual(brick, grid.brickCount))) {
    return nullptr; // only upper neighbours are asked for
  }
  return &grid.bricks[brick.x + std::size_t(grid.brickCount.x) * (brick.y + std::size_t(grid.brickCount.y) * brick.z)];
}

/// The constant that the brick and its upper neighbours share, if they do.
bool isConstantSupport(const BrickGrid& grid, const glm::ivec3& brick, float& value) {
  for (int i = 0; i < 8; ++i) {
    const BrickRecord* record = recordAt(grid, brick + glm::ivec3(i & 1, (i >> 1) & 1, i >> 2));
    if (record != nullptr && record->slot != kConstantBrick) {
      return false;
    }
    const float here = record == nullptr ? 0.0f : record->offset;
    if (i == 0) {
      value = here;
    } else if (here != value) {
      return false;
    }
  }
  return true;
}

void gatherSupport(const BrickGrid& grid, const glm::ivec3& brick, Support& support) {
  for (int i = 0; i < 8; ++i) {
    const glm::ivec3 step(i & 1, (i >> 1) & 1, i >> 2);
    const glm::ivec3 count = glm::ivec3(kBrickEdge) - step * (kBrickEdge - 1); // 8 own voxels, or the neighbour's first
    const BrickRecord* record = recordAt(grid, brick + step);
    for (int z = 0; z < count.z; ++z) {
      for (int y = 0; y < count.y; ++y) {
        for (int x = 0; x < count.x; ++x) {
          const glm::ivec3 to = glm::ivec3(x, y, z) + step * kBrickEdge;
          const std::size_t from = std::size_t(x + kBrickEdge * (y + kBrickEdge * z));
          support[std::size_t(to.x + kSupportEdge * (to.y + kSupportEdge * to.z))] =
              record == nullptr ? 0.0f : decodedVoxel(grid, *record, from);
        }
      }
    }
  }
}

/// Moved away from zero (outward) or towards -infinity/+infinity by the padding; 0 stays 0.
float padded(float value, double magnitude, double sign) {
  if (value == 0.0f && magnitude == 0.0) {
    return 0.0f;
  }
  const double moved = double(value) + sign * kRangePadding * magnitude;
  const float limit = float(sign) * std::numeric_limits<float>::max();
  const double clamped = std::clamp(moved, -double(std::numeric_limits<float>::max()),
                                    double(std::numeric_limits<float>::max()));
  return std::nextafter(float(clamped), limit);
}

Range makeRange(float low, float high, double mean) {
  const double magnitude = std::max(std::abs(double(low)), std::abs(double(high)));
  Range range{.min = low, .max = padded(high, magnitude, 1.0), .mean = float(mean)};
  if (low != 0.0f) {
    range.min = padded(low, magnitude, -1.0);
    range.min = low > 0.0f ? std::max(range.min, 0.0f) : range.min;
  }
  if (range.mean == 0.0f && low >= 0.0f && high > 0.0f) {
    range.mean = std::numeric_limits<float>::denorm_min(); // a positive mean must not underflow to "nothing there"
  }
  return range;
}

Range rangeOfSupport(const Support& support) {
  float low = support[0];
  float high = support[0];
  double sum = 0.0;
  // The mean of a trilinear field over the cube: the trapezoid rule, exact per cell.
  const auto weight = [](int i) { return i == 0 || i == kBrickEdge ? 0.5 : 1.0; };
  std::size_t at = 0;
  for (int z = 0; z < kSupportEdge; ++z) {
    for (int y = 0; y < kSupportEdge; ++y) {
      double row = 0.0;
      for (int x = 0; x < kSupportEdge; ++x, ++at) {
        low = std::min(low, support[at]);
        high = std::max(high, support[at]);
        row += weight(x) * double(support[at]);
      }
      sum += weight(z) * weight(y) * row;
    }
  }
  return makeRange(low, high, sum / kBrickVoxels);
}

void buildCoarse(BrickGrid& grid) {
  grid.coarseCount = (grid.brickCount + (kCoarseEdge - 1)) / kCoarseEdge;
  const std::size_t count = std::size_t(grid.coarseCount.x) * grid.coarseCount.y * grid.coarseCount.z;
  grid.coarseMax.assign(count, -std::numeric_limits<float>::infinity());
  std::size_t at = 0;
  for (int z = 0; z < grid.brickCount.z; ++z) {
    for (int y = 0; y < grid.brickCount.y; ++y) {
      for (int x = 0; x < grid.brickCount.x; ++x, ++at) {
        const glm::ivec3 cell = glm::ivec3(x, y, z) / kCoarseEdge;
        float& coarse = grid.coarseMax[cell.x + std::size_t(grid.coarseCount.x) *
                                                    (cell.y + std::size_t(grid.coarseCount.y) * cell.z)];
        coarse = std::max(coarse, grid.ranges[at].max);
      }
    }
  }
}

} // namespace

void buildTables(BrickGrid& grid) {
  grid.ranges.assign(grid.bricks.size(), Range{});
  const std::size_t rows = std::size_t(grid.brickCount.y) * grid.brickCount.z;
  tbb::parallel_for(std::size_t(0), rows, [&grid](std::size_t row) {
    glm::ivec3 brick(0, int(row % std::size_t(grid.brickCount.y)), int(row / std::size_t(grid.brickCount.y)));
    Support support;
    for (; brick.x < grid.brickCount.x; ++brick.x) {
      Range& range = grid.ranges[brick.x + std::size_t(grid.brickCount.x) * row];
      float value = 0.0f;
      if (isConstantSupport(grid, brick, value)) {
        range = makeRange(value, value, double(value));
      } else {
        gatherSupport(grid, brick, support);
        range = rangeOfSupport(support);
      }
    }
  });
  buildCoarse(grid);
}

} // namespace tyndall::volume

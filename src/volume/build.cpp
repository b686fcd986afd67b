// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "volume/quantise.h"
#include "volume/sparse.h"
#include "volume/tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace tyndall::volume {
namespace {

constexpr std::int64_t kMaxBricks = std::int64_t(1) << 26; ///< 1.6 GB of records and ranges
constexpr int kMaxIndex = 1 << 30;                         ///< so that index arithmetic cannot overflow
constexpr std::uint32_t kNoLeaf = 0xffffffffu;

using BrickValues = std::array<float, kBrickVoxels>;

/// Which voxels count: the active box dilated by one, and the clip box dilated by one voxel's extent in the world.
class Domain {
public:
  Domain(const BrickGrid& grid, const std::optional<Bounds3>& clip)
      : min_(grid.indexMin - 1), max_(grid.indexMax + 1), worldFromIndex_(grid.worldFromIndex), clip_(clip) {
    for (int axis = 0; axis < 3; ++axis) {
      reach_ += glm::abs(glm::dvec3(worldFromIndex_[axis]));
    }
  }

  bool contains(const glm::ivec3& index) const {
    if (glm::any(glm::lessThan(index, min_)) || glm::any(glm::greaterThan(index, max_))) {
      return false;
    }
    if (!clip_) {
      return true;
    }
    const glm::dvec3 world(worldFromIndex_ * glm::dvec4(glm::dvec3(index), 1.0));
    return glm::all(glm::greaterThan(world, clip_->min - reach_)) && glm::all(glm::lessThan(world, clip_->max + reach_));
  }

  /// Both sets are convex, so eight corners decide.
  bool containsBrick(const glm::ivec3& first) const {
    for (int i = 0; i < 8; ++i) {
      if (!contains(first + (kBrickEdge - 1) * glm::ivec3(i & 1, (i >> 1) & 1, i >> 2))) {
        return false;
      }
    }
    return true;
  }

private:
  glm::ivec3 min_;
  glm::ivec3 max_;
  glm::dmat4 worldFromIndex_;
  std::optional<Bounds3> clip_;
  glm::dvec3 reach_{0.0};
};

/// Places bricks over [indexMin - 1, indexMax + 1]. The last plane needs voxels of its own only if it is not 0.
void layOut(BrickGrid& grid, bool upperPlaneStored) {
  if (glm::any(glm::lessThan(grid.indexMin, glm::ivec3(-kMaxIndex))) ||
      glm::any(glm::greaterThan(grid.indexMax, glm::ivec3(kMaxIndex)))) {
    fail("the active voxels reach index {}, beyond what can be addressed (2^30); clip the grid (\"clip\": [[min], [max]] "
         "in the file's world space)",
         std::max(glm::abs(grid.indexMin.x), glm::abs(grid.indexMax.x)));
  }
  std::int64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    grid.firstVoxel[axis] = (grid.indexMin[axis] - 1) & ~(kBrickEdge - 1);
    const int last = upperPlaneStored ? grid.indexMax[axis] + 1 : grid.indexMax[axis];
    grid.brickCount[axis] = (last - grid.firstVoxel[axis]) / kBrickEdge + 1;
    count *= std::min<std::int64_t>(grid.brickCount[axis], kMaxBricks + 1);
    count = std::min(count, kMaxBricks + 1);
  }
  if (count > kMaxBricks) {
    fail("the active voxels span {} x {} x {} voxels, too large a box for a brick table; clip the grid (\"clip\": "
         "[[min], [max]] in the file's world space) or resample it with larger voxels",
         std::int64_t(grid.indexMax.x) - grid.indexMin.x + 1, std::int64_t(grid.indexMax.y) - grid.indexMin.y + 1,
         std::int64_t(grid.indexMax.z) - grid.indexMin.z + 1);
  }
  grid.bricks.assign(std::size_t(count), BrickRecord{});
}

std::size_t brickIndex(const BrickGrid& grid, const glm::ivec3& brick) {
  return brick.x + std::size_t(grid.brickCount.x) * (brick.y + std::size_t(grid.brickCount.y) * brick.z);
}

void fillTile(BrickGrid& grid, const Tile& tile) {
  // Clamp before subtracting: a root tile of an extreme file may reach the end of int.
  const glm::ivec3 low = glm::max(tile.min, grid.firstVoxel);
  const glm::ivec3 high = glm::min(tile.max, grid.firstVoxel + kBrickEdge * grid.brickCount - 1);
  if (glm::any(glm::lessThan(high, low))) {
    return;
  }
  const glm::ivec3 first = (low - grid.firstVoxel) / kBrickEdge;
  const glm::ivec3 last = (high - grid.firstVoxel) / kBrickEdge;
  for (int z = first.z; z <= last.z; ++z) {
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        grid.bricks[brickIndex(grid, {x, y, z})].offset = tile.value;
      }
    }
  }
}

/// For each brick the leaf that holds it, or kNoLeaf.
std::vector<std::uint32_t> leafOfBrick(const BrickGrid& grid, const SparseVoxels& source) {
  std::vector<std::uint32_t> leaves(grid.bricks.size(), kNoLeaf);
  for (std::size_t leaf = 0; leaf < source.leafOrigins.size(); ++leaf) {
    const glm::ivec3 origin = source.leafOrigins[leaf];
    if (glm::any(glm::lessThan(origin, grid.firstVoxel))) {
      continue;
    }
    const glm::ivec3 brick = (origin - grid.firstVoxel) / kBrickEdge;
    if (glm::all(glm::lessThan(brick, grid.brickCount))) {
      leaves[brickIndex(grid, brick)] = std::uint32_t(leaf);
    }
  }
  return leaves;
}

void maskOutside(const Domain& domain, const glm::ivec3& first, BrickValues& values) {
  std::size_t at = 0;
  for (int z = 0; z < kBrickEdge; ++z) {
    for (int y = 0; y < kBrickEdge; ++y) {
      for (int x = 0; x < kBrickEdge; ++x, ++at) {
        if (values[at] != 0.0f && !domain.contains(first + glm::ivec3(x, y, z))) {
          values[at] = 0.0f;
        }
      }
    }
  }
}

void storeBrick(BrickGrid& grid, BrickRecord& record, const BrickValues& values) {
  const bool constant = std::all_of(values.begin(), values.end(), [&](float v) { return v == values[0]; });
  if (constant) {
    record = BrickRecord{kConstantBrick, 0.0f, values[0]};
    return;
  }
  record = BrickRecord{std::uint32_t(grid.voxels.size() / sizeof(BrickValues)), 1.0f, 0.0f};
  const auto* bytes = reinterpret_cast<const std::byte*>(values.data());
  grid.voxels.insert(grid.voxels.end(), bytes, bytes + sizeof(BrickValues));
}

/// Bricks as float, in the order of the table.
void fillBricks(BrickGrid& grid, const SparseVoxels& source, const Domain& domain) {
  for (BrickRecord& record : grid.bricks) {
    record.offset = source.background;
  }
  for (const Tile& tile : source.tiles) {
    fillTile(grid, tile);
  }
  const std::vector<std::uint32_t> leaves = leafOfBrick(grid, source);
  grid.voxels.reserve(source.leafValues.size() * sizeof(float));
  BrickValues values;
  glm::ivec3 brick;
  for (brick.z = 0; brick.z < grid.brickCount.z; ++brick.z) {
    for (brick.y = 0; brick.y < grid.brickCount.y; ++brick.y) {
      for (brick.x = 0; brick.x < grid.brickCount.x; ++brick.x) {
        const std::size_t at = brickIndex(grid, brick);
        BrickRecord& record = grid.bricks[at];
        const glm::ivec3 first = grid.firstVoxel + kBrickEdge * brick;
        const bool whole = domain.containsBrick(first);
        if (leaves[at] != kNoLeaf) {
          std::copy_n(source.leafValues.data() + std::size_t(leaves[at]) * kBrickVoxels, kBrickVoxels, values.data());
        } else if (record.offset == 0.0f || whole) {
          continue; // stays a constant brick
        } else {
          values.fill(record.offset);
        }
        if (!whole) {
          maskOutside(domain, first, values);
        }
        storeBrick(grid, record, values);
      }
    }
  }
  grid.voxels.shrink_to_fit();
}

/// True if a voxel just above the active box can be other than 0.
bool upperPlaneStored(const SparseVoxels& source) {
  if (source.background != 0.0f) {
    return true;
  }
  for (std::size_t i = 0; i < source.leafValues.size(); ++i) {
    const int offset = int(i % kBrickVoxels);
    const glm::ivec3 index = source.leafOrigins[i / kBrickVoxels] + glm::ivec3(offset & 7, (offset >> 3) & 7, offset >> 6);
    if (source.leafValues[i] != 0.0f && glm::any(glm::greaterThan(index, source.indexMax))) {
      return true;
    }
  }
  return std::any_of(source.tiles.begin(), source.tiles.end(), [&](const Tile& tile) {
    return tile.value != 0.0f && glm::any(glm::greaterThan(tile.max, source.indexMax));
  });
}

} // namespace

IndexBox indexBoxOfClip(const Bounds3& clip, const glm::dmat4& worldFromIndex) {
  const Bounds3 index = transformed(glm::inverse(worldFromIndex), clip);
  IndexBox box;
  if (index.empty() || !glm::all(glm::lessThan(glm::abs(index.centre()), glm::dvec3(kMaxIndex)))) {
    return box;
  }
  box.min = glm::ivec3(glm::max(glm::floor(index.min), glm::dvec3(-kMaxIndex)));
  box.max = glm::ivec3(glm::min(glm::ceil(index.max), glm::dvec3(kMaxIndex)));
  return box;
}

BrickGrid buildBricks(const SparseVoxels& source, const glm::dmat4& worldFromIndex, const LoadOptions& options,
                      LoadReport report) {
  BrickGrid grid;
  grid.worldFromIndex = worldFromIndex;
  grid.indexMin = source.indexMin;
  grid.indexMax = source.indexMax;
  grid.activeVoxels = source.activeVoxels;
  grid.report = std::move(report);
  grid.report.negativeVoxels = source.negativeVoxels;
  grid.report.nonFiniteVoxels = source.nonFiniteVoxels;
  if (glm::any(glm::lessThan(source.indexMax, source.indexMin))) {
    grid.indexMin = glm::ivec3(0);
    grid.indexMax = glm::ivec3(-1);
    return grid;
  }
  layOut(grid, upperPlaneStored(source));
  fillBricks(grid, source, Domain(grid, options.clip));
  return quantised(std::move(grid), options);
}

BrickGrid gridFromDense(const std::vector<float>& values, const glm::ivec3& size, const glm::ivec3& indexMin,
                        const glm::dmat4& worldFromIndex, Storage storage) {
  TYNDALL_CHECK(values.size() == std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
  SparseVoxels source;
  source.indexMin = indexMin;
  source.indexMax = indexMin + size - 1;
  source.activeVoxels = values.size();
  const glm::ivec3 first = indexMin & ~(kBrickEdge - 1);
  glm::ivec3 origin;
  for (origin.z = first.z; origin.z <= source.indexMax.z; origin.z += kBrickEdge) {
    for (origin.y = first.y; origin.y <= source.indexMax.y; origin.y += kBrickEdge) {
      for (origin.x = first.x; origin.x <= source.indexMax.x; origin.x += kBrickEdge) {
        source.leafOrigins.push_back(origin);
        for (int i = 0; i < kBrickVoxels; ++i) {
          const glm::ivec3 at = origin + glm::ivec3(i & 7, (i >> 3) & 7, i >> 6) - indexMin;
          const bool inside =
              glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) && glm::all(glm::lessThan(at, size));
          source.leafValues.push_back(
              inside ? values[at.x + std::size_t(size.x) * (at.y + std::size_t(size.y) * at.z)] : 0.0f);
        }
      }
    }
  }
  LoadOptions options;
  options.storage = storage;
  return buildBricks(source, worldFromIndex, options, {});
}

} // namespace tyndall::volume

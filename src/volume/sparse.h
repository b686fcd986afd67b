// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/brick_grid.h"
#include "volume/load.h"

#include <vector>

namespace tyndall::volume {

/// A box of equal voxels that VDB stores as one value; bounds inclusive, in index coordinates.
struct Tile {
  glm::ivec3 min;
  glm::ivec3 max;
  float value;
};

/// A scalar VDB tree without its library: what extraction gives and building takes. Values are finite.
struct SparseVoxels {
  glm::ivec3 indexMin{0};               ///< active bounds, inclusive
  glm::ivec3 indexMax{-1};
  std::vector<glm::ivec3> leafOrigins;  ///< multiples of kBrickEdge
  std::vector<float> leafValues;        ///< kBrickVoxels per leaf, x fastest
  std::vector<Tile> tiles;              ///< corners on multiples of kBrickEdge
  float background = 0.0f;              ///< everywhere else
  std::uint64_t activeVoxels = 0;
  std::uint64_t negativeVoxels = 0;     ///< set to 0 while extracting
  std::uint64_t nonFiniteVoxels = 0;    ///< set to 0 while extracting
};

/// Bricks, quantised and with tables. Index space outside [indexMin - 1, indexMax + 1] becomes 0, so does what lies
/// more than a voxel outside options.clip (given in the grid's world space).
/// `report` is carried over and completed. @throws Error if the bounds need more bricks than any device would take.
BrickGrid buildBricks(const SparseVoxels& source, const glm::dmat4& worldFromIndex, const LoadOptions& options,
                      LoadReport report);

/// The box of voxels that can influence the field inside `clip`, or an empty box (max < min).
struct IndexBox {
  glm::ivec3 min{0};
  glm::ivec3 max{-1};
  bool empty() const { return glm::any(glm::lessThan(max, min)); }
};
IndexBox indexBoxOfClip(const Bounds3& clip, const glm::dmat4& worldFromIndex);

} // namespace tyndall::volume

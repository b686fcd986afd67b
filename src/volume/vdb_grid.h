// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/sparse.h"

#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>
#include <string>

/// What loading and inspecting share about OpenVDB grids. Only files that name OpenVDB types include this.
namespace tyndall::volume {

/// Calls `work` with the grid as its own type if its values are single numbers. False: it is another kind of grid.
template <class Work> bool withScalarGrid(const openvdb::GridBase& grid, const Work& work) {
  return grid.apply<openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid,
                                      openvdb::BoolGrid, openvdb::MaskGrid>>(work);
}

inline glm::ivec3 toGlm(const openvdb::Coord& c) { return {c.x(), c.y(), c.z()}; }

/// Density that stands in the file, or 0 where it cannot be one.
struct Sanitiser {
  bool signedValues = false;
  std::uint64_t negative = 0;
  std::uint64_t nonFinite = 0;

  float operator()(double value, std::uint64_t voxels) {
    // Written so that NaN fails the test.
    if (!(std::abs(value) <= double(std::numeric_limits<float>::max()))) {
      nonFinite += voxels;
      return 0.0f;
    }
    if (value < 0.0 && !signedValues) {
      negative += voxels;
      return 0.0f;
    }
    return float(value) + 0.0f; // -0 becomes 0
  }
};

/// The voxels of a scalar grid. `signedValues` keeps negative ones. @throws Error if the grid is not scalar.
SparseVoxels extractVoxels(const openvdb::GridBase& grid, bool signedValues);

/// A level set of float or double as a fog volume: 0 at the surface, 1 from half the narrow band inwards.
/// Null if it is of another type. The caller's grid is not changed.
openvdb::GridBase::Ptr fogOfLevelSet(const openvdb::GridBase& grid);

/// Where a grid with a frustum transform is sampled to.
struct ResamplePlan {
  glm::dmat4 worldFromIndex{1.0};
  glm::ivec3 indexMin{0};
  glm::ivec3 indexMax{-1};
};
/// Cubic voxels as small as the frustum's in the middle of its active voxels, at most 512 along an axis.
ResamplePlan planResampling(const openvdb::GridBase& grid);

/// The grid sampled trilinearly at the plan's voxels.
SparseVoxels resampled(const openvdb::GridBase& grid, const ResamplePlan& plan, bool signedValues);

} // namespace tyndall::volume

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/brick_grid.h"
#include "volume/load.h"

#include <vector>

namespace tyndall::volume {

/// How far decoded voxels are from the exact ones.
struct QuantisationError {
  double voxel = 0.0;         ///< worst |decoded - exact| relative to the largest |exact|
  double opticalDepth = 0.0;  ///< worst relative error of the sums along lines of voxels parallel to an index axis,
                              ///< over lines with at least kLineThreshold of that axis' largest sum
};

/// Lines thinner than this share of the thickest one are judged by the voxel error alone: their relative error says
/// nothing about the picture.
inline constexpr double kLineThreshold = 0.01;

/// `exact` (storage Float) in another storage; no tables. @throws Error if a value is beyond what half can hold.
BrickGrid encoded(const BrickGrid& exact, Storage storage);

/// Largest |voxel|.
double largestMagnitude(const BrickGrid& grid);

/// Measures other storages of a grid against it; what depends on the exact grid alone is computed once.
class ErrorReference {
public:
  /// `exact` must outlive this.
  explicit ErrorReference(const BrickGrid& exact);
  double largest() const { return largest_; }
  /// `other` has the layout of the exact grid.
  QuantisationError errorOf(const BrickGrid& other) const;

private:
  const BrickGrid& exact_;
  std::vector<float> values_;      ///< decoded voxels by slot
  double largest_ = 0.0;
  glm::dvec3 thickest_{0.0};       ///< largest sum of magnitudes along a line, per axis
};

/// The grid (storage Float, without tables) in the storage that `options` asks for, or in the narrowest one within
/// its tolerances; with tables, and with the errors in the report.
BrickGrid quantised(BrickGrid exact, const LoadOptions& options);

} // namespace tyndall::volume

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/brick_grid.h"

namespace tyndall::volume {

/// Relative head room of Range::max (and foot room of Range::min): a float trilinear lookup of decoded voxels rounds
/// at most about eight times, half an ulp (6e-8) each.
inline constexpr double kRangePadding = 1e-6;

/// Fills `ranges`, `coarseCount` and `coarseMax` from the decoded voxels.
/// Brick b's range bounds the field over index space [8b, 8b + 8] relative to firstVoxel: its own voxels and the
/// first layer of its upper neighbours. Range::mean is the mean of the trilinear field over that cube, and positive
/// wherever a non-negative field is.
void buildTables(BrickGrid& grid);

} // namespace tyndall::volume

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/brick_grid.h"

#include <filesystem>

namespace tyndall::volume {

/// Writes the decoded voxels that are not 0 as the OpenVDB float grid "density" with this affine transform.
/// @throws Error if the file cannot be written.
void writeGrid(const std::filesystem::path& path, const BrickGrid& grid, const glm::dmat4& worldFromIndex);

/// Writes the decoded voxels of the active box, x fastest, as 32-bit floats in this machine's byte order.
/// @throws Error if the file cannot be written.
void writeDense(const std::filesystem::path& path, const BrickGrid& grid);

} // namespace tyndall::volume

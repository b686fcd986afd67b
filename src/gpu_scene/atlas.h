// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "gpu/image.h"
#include "gpu/kernel.h"
#include "interop/grid.h"
#include "volume/brick_grid.h"

#include <array>
#include <vector>

namespace tyndall::gpu_scene {

/// The voxels of all grids in one 3D image per texel format, bricks side by side.
class Atlas {
public:
  Atlas() = default;
  /// @throws Error if the bricks do not fit into the device's largest 3D image.
  Atlas(const gpu::Device& device, const std::vector<volume::BrickGrid>& grids);

  /// Records of one grid with atlas positions, to be uploaded.
  const std::vector<interop::Brick>& records(std::size_t grid) const { return records_[grid]; }
  gpu::AtlasImages images() const;
  /// Bit per kFormat* in use.
  std::uint32_t formatMask() const;

private:
  std::array<gpu::Image3D, 3> images_;
  std::vector<std::vector<interop::Brick>> records_;
};

/// kFormat* of a storage.
std::uint32_t formatOf(volume::Storage storage);

} // namespace tyndall::gpu_scene

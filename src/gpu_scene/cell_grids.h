// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "gpu_scene/media.h"
#include "interop/cells.h"

#include <span>
#include <vector>

namespace tyndall::gpu_scene {

/// One brick grid as blocks of 9^3 floats: each brick's own voxels and the first ones of its far neighbours, decoded.
struct CellBlocks {
  std::vector<std::uint32_t> blockOfBrick; ///< number of the brick's block; kEmptyBrick where none was wanted
  std::vector<float> voxels;               ///< interop::kBlockVoxels per block, x fastest
};

/// Blocks of the bricks with `wanted` set. Bricks whose whole support is one constant share a block.
CellBlocks makeCellBlocks(const volume::BrickGrid& grid, const std::vector<bool>& wanted);

/// Device bytes that CellGrids will take, from above: constant bricks are counted as if none shared a block.
double plannedCellBytes(const PackedMedia& media, const VolumeSet& volumes);

/// Of those, the array of one grid's voxels that is the largest.
double largestCellArray(const PackedMedia& media, const VolumeSet& volumes);

/// The placed grids of a scene for walks from cell to cell: interop::CellGrid i belongs to placement i.
class CellGrids {
public:
  CellGrids() = default;
  /// @throws Error if device memory does not suffice.
  CellGrids(const gpu::Device& device, const PackedMedia& media, const VolumeSet& volumes);

  interop::Ptr<interop::CellGrid> ptr() const { return headers_.ptr(); }
  double bytes() const;

private:
  std::vector<gpu::Buffer<float>> floats_;
  std::vector<gpu::Buffer<std::uint32_t>> blocks_;
  gpu::Buffer<interop::CellGrid> headers_;
};

} // namespace tyndall::gpu_scene

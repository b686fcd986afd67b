// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/cell_grids.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace tyndall::gpu_scene {
namespace {

using interop::kBlockEdge;
using interop::kBlockVoxels;
using interop::kEmptyBrick;
using volume::BrickGrid;

glm::ivec3 brickPlace(const BrickGrid& grid, std::size_t brick) {
  const auto index = static_cast<int>(brick);
  return {index % grid.brickCount.x, index / grid.brickCount.x % grid.brickCount.y,
          index / (grid.brickCount.x * grid.brickCount.y)};
}

void fillBlock(const BrickGrid& grid, std::size_t brick, float* block) {
  const glm::ivec3 first = grid.firstVoxel + brickPlace(grid, brick) * volume::kBrickEdge;
  for (int z = 0; z < kBlockEdge; ++z) {
    for (int y = 0; y < kBlockEdge; ++y) {
      for (int x = 0; x < kBlockEdge; ++x) {
        *block++ = grid.voxel(first + glm::ivec3(x, y, z));
      }
    }
  }
}

/// Bricks that any placement of grid `index` walks through.
std::vector<bool> wantedBricks(const PackedMedia& media, std::size_t index, std::size_t bricks) {
  std::vector<bool> wanted(bricks, false);
  for (const PackedMedia::Placement& placement : media.placements) {
    for (std::size_t b = 0; placement.grid == index && b < bricks; ++b) {
      wanted[b] = wanted[b] || media.source(placement).maxima[b] > 0.0f;
    }
  }
  return wanted;
}

double voxelBytes(const PackedMedia& media, const VolumeSet& volumes, std::size_t grid) {
  const std::vector<bool> wanted = wantedBricks(media, grid, volumes.grids[grid].bricks.size());
  return double(std::count(wanted.begin(), wanted.end(), true)) * kBlockVoxels * sizeof(float);
}

} // namespace

CellBlocks makeCellBlocks(const BrickGrid& grid, const std::vector<bool>& wanted) {
  CellBlocks out;
  out.blockOfBrick.assign(grid.bricks.size(), kEmptyBrick);
  std::map<float, std::uint32_t> constants;
  std::vector<std::size_t> brickOfBlock;
  for (std::size_t b = 0; b < grid.bricks.size(); ++b) {
    if (!wanted[b]) {
      continue;
    }
    auto block = static_cast<std::uint32_t>(brickOfBlock.size());
    if (grid.ranges[b].min == grid.ranges[b].max) {
      block = constants.try_emplace(grid.ranges[b].min, block).first->second;
    }
    out.blockOfBrick[b] = block;
    if (block == brickOfBlock.size()) {
      brickOfBlock.push_back(b);
    }
  }
  out.voxels.resize(brickOfBlock.size() * std::size_t(kBlockVoxels));
  tbb::parallel_for(std::size_t{0}, brickOfBlock.size(), [&](std::size_t block) {
    fillBlock(grid, brickOfBlock[block], out.voxels.data() + block * std::size_t(kBlockVoxels));
  });
  return out;
}

double largestCellArray(const PackedMedia& media, const VolumeSet& volumes) {
  double largest = 0.0;
  for (std::size_t g = 0; g < volumes.grids.size(); ++g) {
    largest = std::max(largest, voxelBytes(media, volumes, g));
  }
  return largest;
}

double plannedCellBytes(const PackedMedia& media, const VolumeSet& volumes) {
  double bytes = 0.0;
  for (std::size_t g = 0; g < volumes.grids.size(); ++g) {
    bytes += voxelBytes(media, volumes, g);
  }
  for (const PackedMedia::Placement& placement : media.placements) {
    bytes +=
        double(media.source(placement).maxima.size() + media.source(placement).coarseMaxima.size()) * sizeof(float);
  }
  return bytes;
}

CellGrids::CellGrids(const gpu::Device& device, const PackedMedia& media, const VolumeSet& volumes) {
  std::map<std::size_t, std::pair<CellBlocks, interop::Ptr<float>>> byGrid;
  for (std::size_t g = 0; g < volumes.grids.size(); ++g) {
    const std::vector<bool> wanted = wantedBricks(media, g, volumes.grids[g].bricks.size());
    CellBlocks blocks = makeCellBlocks(volumes.grids[g], wanted);
    floats_.emplace_back(device, std::span<const float>(blocks.voxels));
    blocks.voxels = {};
    byGrid[g] = {std::move(blocks), floats_.back().ptr()};
  }
  std::vector<interop::CellGrid> headers;
  for (const PackedMedia::Placement& placement : media.placements) {
    const auto& [cells, voxels] = byGrid[placement.grid];
    std::vector<std::uint32_t> table = cells.blockOfBrick;
    for (std::size_t b = 0; b < table.size(); ++b) {
      table[b] = media.source(placement).maxima[b] > 0.0f ? table[b] : kEmptyBrick;
    }
    blocks_.emplace_back(device, std::span<const std::uint32_t>(table));
    floats_.emplace_back(device, std::span<const float>(media.source(placement).coarseMaxima));
    interop::CellGrid header{};
    header.voxelFromWorld = placement.header.voxelFromWorld;
    header.boundsMin = placement.header.boundsMin;
    header.boundsMax = placement.header.boundsMax;
    header.brickCount = placement.header.brickCount;
    header.coarseCount = placement.header.coarseCount;
    header.blocks = blocks_.back().ptr();
    header.voxels = voxels;
    header.coarseMaxima = floats_.back().ptr();
    headers.push_back(header);
  }
  headers_ = gpu::Buffer<interop::CellGrid>(device, std::span<const interop::CellGrid>(headers));
}

double CellGrids::bytes() const {
  const auto add = [](double sum, const auto& buffer) { return sum + double(buffer.bytes()); };
  return std::accumulate(floats_.begin(), floats_.end(), 0.0, add) +
         std::accumulate(blocks_.begin(), blocks_.end(), 0.0, add);
}

} // namespace tyndall::gpu_scene

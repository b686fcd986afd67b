// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/atlas.h"

#include "base/error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace tyndall::gpu_scene {
namespace {

using volume::BrickGrid;
using volume::kBrickEdge;
using volume::kBrickVoxels;

static_assert(volume::kBrickEdge == interop::kBrickEdge && volume::kCoarseEdge == interop::kCoarseEdge);

constexpr std::uint32_t kMaxBricksPerAxis = 1024; // 10 bits each in Brick::texelBrick

/// Bricks per axis of an atlas that holds `count` bricks.
glm::uvec3 atlasShape(std::size_t count, std::uint32_t maxTexels) {
  const std::uint32_t limit = std::min(kMaxBricksPerAxis, maxTexels / kBrickEdge);
  const auto edge = static_cast<std::uint32_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  const std::uint32_t side = std::clamp(edge, 1u, limit);
  const std::size_t layers = (count + std::size_t(side) * side - 1) / (std::size_t(side) * side);
  if (layers > limit) {
    fail(
        "{} bricks of 8^3 voxels do not fit into the device's largest 3D image ({} texels an edge); use a \"clip\" box",
        count, maxTexels);
  }
  return {side, side, static_cast<std::uint32_t>(layers)};
}

glm::uvec3 placeOf(std::size_t brick, const glm::uvec3& shape) {
  const auto index = static_cast<std::uint32_t>(brick);
  return {index % shape.x, index / shape.x % shape.y, index / (shape.x * shape.y)};
}

void copyBrick(const BrickGrid& grid, std::uint32_t slot, const glm::uvec3& place, const glm::uvec3& shape,
               std::vector<std::byte>& texels) {
  const std::size_t row = kBrickEdge * volume::bytesPerVoxel(grid.storage);
  const std::byte* source = grid.voxels.data() + std::size_t(slot) * kBrickEdge * kBrickEdge * row;
  for (std::size_t z = 0; z < kBrickEdge; ++z) {
    for (std::size_t y = 0; y < kBrickEdge; ++y) {
      const std::size_t line = (place.z * kBrickEdge + z) * shape.y * kBrickEdge + place.y * kBrickEdge + y;
      std::copy_n(source + (z * kBrickEdge + y) * row, row, texels.data() + (line * shape.x + place.x) * row);
    }
  }
}

} // namespace

std::uint32_t formatOf(volume::Storage storage) {
  switch (storage) {
  case volume::Storage::Unorm8:
    return interop::kFormatUint8;
  case volume::Storage::Half:
    return interop::kFormatHalf;
  case volume::Storage::Float:
    return interop::kFormatFloat;
  }
  TYNDALL_CHECK(false);
  return 0;
}

Atlas::Atlas(const gpu::Device& device, const std::vector<BrickGrid>& grids) {
  records_.resize(grids.size());
  constexpr std::array kFormats{gpu::TexelFormat::Uint8, gpu::TexelFormat::Half, gpu::TexelFormat::Float};
  for (std::uint32_t format = 0; format < images_.size(); ++format) {
    std::size_t total = 0;
    for (const BrickGrid& grid : grids) {
      total += formatOf(grid.storage) == format ? grid.slotCount() : 0;
    }
    const glm::uvec3 shape = atlasShape(std::max<std::size_t>(total, 1), device.info().maxImage3D);
    std::vector<std::byte> texels;
    std::size_t first = 0;
    for (std::size_t g = 0; g < grids.size(); ++g) {
      const BrickGrid& grid = grids[g];
      if (formatOf(grid.storage) != format) {
        continue;
      }
      texels.resize(std::size_t(shape.x) * shape.y * shape.z * kBrickVoxels * volume::bytesPerVoxel(grid.storage));
      records_[g].resize(grid.bricks.size());
      tbb::parallel_for(std::size_t{0}, grid.bricks.size(), [&](std::size_t b) {
        const volume::BrickRecord& brick = grid.bricks[b];
        records_[g][b] = {interop::kConstantBrick, brick.scale, brick.offset};
        if (brick.slot != volume::kConstantBrick) {
          const glm::uvec3 place = placeOf(first + brick.slot, shape);
          records_[g][b].texelBrick = place.x | place.y << 10 | place.z << 20;
          copyBrick(grid, brick.slot, place, shape, texels);
        }
      });
      first += grid.slotCount();
    }
    if (total > 0) {
      images_[format] = gpu::Image3D(device, shape * std::uint32_t(kBrickEdge), kFormats[format], texels);
    }
  }
}

gpu::AtlasImages Atlas::images() const { return {&images_[0], &images_[1], &images_[2]}; }

std::uint32_t Atlas::formatMask() const {
  std::uint32_t mask = 0;
  for (std::uint32_t format = 0; format < images_.size(); ++format) {
    mask |= images_[format].empty() ? 0u : 1u << format;
  }
  return mask;
}

} // namespace tyndall::gpu_scene

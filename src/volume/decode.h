// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/brick_grid.h"

#include <glm/gtc/packing.hpp>

#include <cstdint>
#include <cstring>

namespace tyndall::volume {

/// Voxel `i` (x fastest, [0, kBrickVoxels)) of a brick as the device decodes it: offset + scale * stored, in float.
inline float decodedVoxel(const BrickGrid& grid, const BrickRecord& record, std::size_t i) {
  if (record.slot == kConstantBrick) {
    return record.offset;
  }
  const std::size_t at = std::size_t(record.slot) * kBrickVoxels + i;
  switch (grid.storage) {
  case Storage::Unorm8: return record.offset + record.scale * float(std::to_integer<unsigned>(grid.voxels[at]));
  case Storage::Half: {
    std::uint16_t bits = 0;
    std::memcpy(&bits, grid.voxels.data() + 2 * at, sizeof bits);
    return glm::unpackHalf1x16(bits);
  }
  case Storage::Float: break;
  }
  float value = 0.0f;
  std::memcpy(&value, grid.voxels.data() + 4 * at, sizeof value);
  return value;
}

} // namespace tyndall::volume

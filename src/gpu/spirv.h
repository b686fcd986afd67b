// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tyndall::gpu {

/// What the host reads from a SPIR-V module instead of repeating it.
struct SpirvInfo {
  std::uint32_t workgroupSize = 1; ///< x of LocalSize or LocalSizeId
  bool usesImages = false;         ///< reads the atlas images
  /// Struct name -> member name -> byte offset. A struct that appears with several layouts keeps the first one.
  std::map<std::string, std::map<std::string, std::uint32_t>> offsets;
};

/// @throws Error if the words are not SPIR-V.
SpirvInfo readSpirv(std::span<const std::uint32_t> words);

} // namespace tyndall::gpu

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tyndall::render {

/// A run of consecutive samples of one batch, the same for every pixel of a call.
struct SampleRange {
  std::uint32_t first = 0; ///< index within the pixel
  std::uint32_t count = 0; ///< 1 .. kBatchSamples, not beyond the batch's end
};

} // namespace tyndall::render

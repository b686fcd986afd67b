// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "guide/store.h"
#include "interop/guide.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tyndall::guide {

/// What the pass `guide_apply` goes by.
struct LogOrder {
  std::vector<std::uint32_t> places; ///< in the log, window after window
  std::vector<std::uint32_t> first;  ///< of each window's in `places`, and the end
};

/// How cells lie in windows.
struct WindowLayout {
  StoreSize size;
  std::uint32_t window = 1; ///< cells
};

/// The order of updates: by window, in it by kind, in that by place in the log. Threads have no say in it, as pixel i
/// has its own `perPixel` places from i * perPixel on, of which the first counts[i] are filled.
LogOrder logOrder(std::span<const interop::GuideUpdate> log, std::span<const std::uint32_t> counts,
                  std::uint32_t perPixel, const WindowLayout& layout);

} // namespace tyndall::guide

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"

#include <cstdint>
#include <vector>

namespace tyndall::render {

/// Pixels of a window in the order in which they are dispatched: 8x8 tiles, so that a workgroup of 64 sees neighbours;
/// tiles scattered, because a CPU device gives each thread one contiguous run of workgroups and heavy parts of a
/// picture would leave the others idle. @return x | y << 16, absolute in the image, each pixel once.
std::vector<std::uint32_t> dispatchOrder(const film::Window& window);

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_order.h"

#include <algorithm>
#include <numeric>

namespace tyndall::render {
namespace {

constexpr std::uint32_t kTile = 8;

/// A stride coprime to `count` near its golden section: visits every tile once, neighbours far apart.
std::uint64_t scatterStride(std::uint64_t count) {
  auto stride = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(0.6180339887 * static_cast<double>(count)));
  while (std::gcd(stride, count) != 1) {
    ++stride;
  }
  return stride;
}

} // namespace

std::vector<std::uint32_t> dispatchOrder(const film::Window& window) {
  std::vector<std::uint32_t> order;
  order.reserve(window.pixelCount());
  if (window.pixelCount() == 0) {
    return order;
  }
  const glm::uvec2 tiles = (window.extent() + kTile - 1u) / kTile;
  const std::uint64_t count = std::uint64_t(tiles.x) * tiles.y;
  const std::uint64_t stride = scatterStride(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t tile = i * stride % count;
    const glm::uvec2 first = window.min + kTile * glm::uvec2(tile % tiles.x, tile / tiles.x);
    const glm::uvec2 last = glm::min(first + kTile, window.max);
    for (std::uint32_t y = first.y; y < last.y; ++y) {
      for (std::uint32_t x = first.x; x < last.x; ++x) {
        order.push_back(x | y << 16);
      }
    }
  }
  return order;
}

} // namespace tyndall::render

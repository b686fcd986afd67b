// SPDX-License-Identifier: Apache-2.0
#include "render/light_caches.h"

#include "passes/light_cache/light_cache_pass.h"

#include <algorithm>
#include <chrono>
#include <numeric>

namespace tyndall::render {
namespace {

/// Nodes of one dispatch, each with a few cells to walk: milliseconds on a graphics card, so that no watchdog bites.
constexpr std::uint32_t kNodesPerDispatch = 1u << 25;

void build(const passes::LightCachePass& pass, interop::LightCacheInputs inputs, const interop::LightCache& header) {
  const auto columns = static_cast<std::uint32_t>(header.count.x * header.count.y);
  const std::uint32_t share = std::max(kNodesPerDispatch / static_cast<std::uint32_t>(header.count.z), 64u);
  for (inputs.firstColumn = 0; inputs.firstColumn < columns; inputs.firstColumn += share) {
    inputs.columnCount = std::min(share, columns - inputs.firstColumn);
    pass.run(inputs);
  }
}

} // namespace

LightCaches::LightCaches(const gpu::Device& device, const gpu_scene::CellGrids& grids,
                         const std::vector<LightCachePlan>& plans) {
  if (plans.empty()) {
    return;
  }
  std::vector<interop::LightCache> headers;
  for (const LightCachePlan& plan : plans) {
    depths_.emplace_back(device, plan.nodes(), gpu::Memory::Device);
    headers.push_back(plan.header);
    headers.back().depths = depths_.back().ptr();
  }
  headers_ = gpu::Buffer<interop::LightCache>(device, std::span<const interop::LightCache>(headers));
  const passes::LightCachePass pass(device);
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < headers.size(); ++i) {
    interop::LightCacheInputs inputs{};
    inputs.grids = grids.ptr();
    inputs.caches = headers_.ptr();
    inputs.cache = static_cast<std::uint32_t>(i);
    build(pass, inputs, headers[i]);
  }
  buildSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double LightCaches::bytes() const {
  return std::accumulate(depths_.begin(), depths_.end(), 0.0,
                         [](double sum, const gpu::Buffer<float>& depths) { return sum + double(depths.bytes()); });
}

} // namespace tyndall::render

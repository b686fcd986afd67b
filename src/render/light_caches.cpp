// SPDX-License-Identifier: Apache-2.0
#include "render/light_caches.h"

#include <algorithm>
#include <chrono>

namespace tyndall::render {
namespace {

/// Nodes of one dispatch, each with a few cells to walk: milliseconds on a graphics card, so that no watchdog bites.
constexpr std::uint32_t kNodesPerDispatch = 1u << 25;

void fill(const passes::LightCachePass& pass, interop::LightCacheInputs inputs, const interop::LightCache& header) {
  const auto columns = static_cast<std::uint32_t>(header.count.x * header.count.y);
  const std::uint32_t share = std::max(kNodesPerDispatch / static_cast<std::uint32_t>(header.count.z), 64u);
  for (inputs.firstColumn = 0; inputs.firstColumn < columns; inputs.firstColumn += share) {
    inputs.columnCount = std::min(share, columns - inputs.firstColumn);
    pass.run(inputs);
  }
}

} // namespace

LightCaches::LightCaches(const gpu::Device& device, const gpu_scene::CellGrids& grids,
                         const std::vector<LightCachePlan>& plans)
    : device_(&device), grids_(&grids) {
  build(plans);
}

void LightCaches::upload(const std::vector<LightCachePlan>& plans) {
  std::size_t nodes = 0;
  for (const LightCachePlan& plan : plans) {
    nodes += plan.nodes();
  }
  if (nodes > depths_.size()) {
    depths_ = {}; // not both at a time
    depths_ = gpu::Buffer<float>(*device_, nodes, gpu::Memory::Device);
  }
  std::vector<interop::LightCache> headers;
  std::size_t first = 0;
  for (const LightCachePlan& plan : plans) {
    headers.push_back(plan.header);
    headers.back().depths = depths_.ptr(first);
    first += plan.nodes();
  }
  if (headers.size() != headers_.size()) {
    headers_ = gpu::Buffer<interop::LightCache>(*device_, headers.size(), gpu::Memory::Device);
  }
  headers_.write(headers);
  size_ = headers.size();
}

void LightCaches::build(const std::vector<LightCachePlan>& plans) {
  size_ = 0;
  if (plans.empty()) {
    return;
  }
  if (!pass_) {
    pass_ = std::make_unique<passes::LightCachePass>(*device_);
  }
  upload(plans);
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < plans.size(); ++i) {
    interop::LightCacheInputs inputs{};
    inputs.grids = grids_->ptr();
    inputs.caches = headers_.ptr();
    inputs.cache = static_cast<std::uint32_t>(i);
    fill(*pass_, inputs, plans[i].header);
  }
  buildSeconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "gpu_scene/cell_grids.h"
#include "passes/light_cache/light_cache_pass.h"
#include "render/light_cache_plan.h"

#include <memory>
#include <vector>

namespace tyndall::render {

/// Tables of optical depth towards lights on the device. Cache i belongs to plan i. Borrows the device and the grids.
class LightCaches {
public:
  /// Without plans nothing is allocated. @throws Error if device memory does not suffice.
  LightCaches(const gpu::Device& device, const gpu_scene::CellGrids& grids,
              const std::vector<LightCachePlan>& plans = {});

  /// Builds other caches in place of those that are there; memory is kept where it suffices.
  void build(const std::vector<LightCachePlan>& plans);

  interop::Ptr<interop::LightCache> ptr() const { return headers_.ptr(); }
  std::size_t size() const { return size_; }
  double bytes() const { return double(depths_.bytes()); }
  /// Wall time of filling all tables so far, memory and pipeline excluded.
  double buildSeconds() const { return buildSeconds_; }

private:
  void upload(const std::vector<LightCachePlan>& plans);

  const gpu::Device* device_;
  const gpu_scene::CellGrids* grids_;
  std::unique_ptr<passes::LightCachePass> pass_;
  gpu::Buffer<float> depths_;
  gpu::Buffer<interop::LightCache> headers_;
  std::size_t size_ = 0;
  double buildSeconds_ = 0.0;
};

} // namespace tyndall::render

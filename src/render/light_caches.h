// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "gpu_scene/cell_grids.h"
#include "render/light_cache_plan.h"

#include <vector>

namespace tyndall::render {

/// Tables of optical depth towards lights on the device, built when made. Cache i belongs to plan i.
class LightCaches {
public:
  LightCaches() = default;
  /// @throws Error if device memory does not suffice.
  LightCaches(const gpu::Device& device, const gpu_scene::CellGrids& grids, const std::vector<LightCachePlan>& plans);

  interop::Ptr<interop::LightCache> ptr() const { return headers_.ptr(); }
  std::size_t size() const { return headers_.size(); }
  double bytes() const;
  /// Wall time of filling the tables, memory and pipeline excluded.
  double buildSeconds() const { return buildSeconds_; }

private:
  std::vector<gpu::Buffer<float>> depths_;
  gpu::Buffer<interop::LightCache> headers_;
  double buildSeconds_ = 0.0;
};

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"
#include "interop/march.h"
#include "render/estimator.h"
#include "render/light_caches.h"

namespace tyndall::render {

/// The lights that every ray takes, and the caches that they want.
struct MarchPlan {
  interop::MarchScene header{};          ///< all but addresses, centre and radius
  std::uint32_t groups = 0;              ///< of caches: one per light, one per cached direction of environments
  std::vector<LightCacheRequest> wanted; ///< most important first
  std::vector<std::uint32_t> place;      ///< of each request in MarchScene::cacheOf
};
MarchPlan planMarch(const gpu_scene::GpuScene& scene);

/// Beams that a ray can have.
std::uint32_t mostBeams(const gpu_scene::GpuScene& scene);

/// Bound on the pieces that any ray of the scene can have.
std::uint32_t mostPieces(const gpu_scene::PackedMedia& media);

/// What the march needs beside the scene, on the device: grids as cells, light caches.
class MarchScene {
public:
  /// @throws Error if device memory does not suffice.
  MarchScene(const gpu::Device& device, const gpu_scene::GpuScene& scene, const gpu_scene::VolumeSet& volumes,
             double cacheBytes);

  interop::Ptr<interop::MarchScene> ptr() const { return header_.ptr(); }
  const CacheReport& caches() const { return report_; }

private:
  LightCaches caches_;
  gpu::Buffer<std::uint32_t> cacheOf_;
  gpu::Buffer<interop::MarchScene> header_;
  CacheReport report_;
};

} // namespace tyndall::render

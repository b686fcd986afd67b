// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"
#include "interop/march.h"
#include "render/estimator.h"
#include "render/light_caches.h"

#include <optional>
#include <utility>

namespace tyndall::render {

/// The lights that every ray takes, and the caches that they want.
struct MarchPlan {
  interop::MarchScene header{};          ///< all but addresses, centre and radius
  std::uint32_t beams = 0;               ///< that a ray can have
  std::uint32_t groups = 0;              ///< of caches: one per light, one per sky direction
  bool sky = false;                      ///< an environment is there
  std::vector<LightCacheRequest> wanted; ///< of suns and point lights, most important first
  std::vector<std::uint32_t> place;      ///< of each request in MarchScene::cacheOf
};
MarchPlan planMarch(const gpu_scene::GpuScene& scene);

/// Bound on the pieces that any ray of the scene can have.
std::uint32_t mostPieces(const gpu_scene::PackedMedia& media);

/// Loop iterations of an invocation in one dispatch: below what old Mesa cuts (65535), and what a watchdog allows.
inline constexpr std::uint32_t kMostIterations = 50000;
/// Bounds on the loop iterations of a pixel's preparation, and of one sample: its pieces and the cells of its
/// corrections.
std::uint32_t mostPreparation(const gpu_scene::PackedMedia& media);
std::uint32_t mostIterations(const gpu_scene::PackedMedia& media, std::uint32_t corrections);

/// What the march needs beside the scene, on the device: grids as cells, light caches. Borrows scene and volumes.
class MarchScene {
public:
  /// @throws Error if device memory does not suffice.
  MarchScene(const gpu::Device& device, const gpu_scene::GpuScene& scene, const gpu_scene::VolumeSet& volumes,
             double cacheBytes);

  /// Makes the sky directions of a batch, and their caches; nothing without environments.
  void begin(std::uint32_t seed, std::uint32_t batch);

  interop::Ptr<interop::MarchScene> ptr() const { return header_.ptr(); }
  const MarchPlan& plan() const { return plan_; }
  CacheReport caches() const;

private:
  void upload();

  const gpu_scene::GpuScene& scene_;
  const gpu_scene::VolumeSet& volumes_;
  MarchPlan plan_;
  double skyBytes_ = 0.0; ///< that the caches of sky directions may take
  LightCaches caches_;
  LightCaches skyCaches_;
  std::size_t wanted_ = 0; ///< caches that would be there with memory for all
  std::vector<std::uint32_t> places_;
  std::optional<std::pair<std::uint32_t, std::uint32_t>> batch_; ///< seed and batch of the sky directions
  gpu::Buffer<std::uint32_t> cacheOf_;
  gpu::Buffer<glm::vec3> sky_;
  gpu::Buffer<interop::MarchScene> header_;
};

} // namespace tyndall::render

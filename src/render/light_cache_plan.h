// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/media.h"
#include "gpu_scene/volumes.h"
#include "interop/light_cache.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tyndall::render {

/// A light whose optical depths through a grid are wanted as a table.
struct LightCacheRequest {
  std::uint32_t grid = 0; ///< placement of the density grid (gpu_scene::PackedMedia)
  double sigmaT = 0.0;    ///< extinction per unit of density [1/unit]
  bool distant = false;   ///< at infinity
  glm::dvec3 light{0.0};  ///< distant: unit direction towards it; else its position; centred world space
  double spacing = 0.0;   ///< voxels between nodes; 0: chosen by the medium's density
};

/// What will be built for a request: a value, made without a device.
struct LightCachePlan {
  std::size_t request = 0;      ///< index of its request
  double spacing = 1.0;         ///< voxels between nodes; for point lights at the grid's mean distance
  interop::LightCache header{}; ///< all but the address of the depths

  std::size_t nodes() const {
    return std::size_t(header.count.x) * std::size_t(header.count.y) * std::size_t(header.count.z);
  }
  double bytes() const { return double(nodes()) * sizeof(float); }
};

/// Plans the caches that fit into `budgetBytes` together. Requests come most important first. Where memory does not
/// suffice spacings double, one request after the other from the last to the first and round again; when all are as
/// coarse as is of use, those that do not fit behind the ones before them are dropped. Plans keep the order of
/// requests.
std::vector<LightCachePlan> planLightCaches(std::span<const LightCacheRequest> requests,
                                            const gpu_scene::PackedMedia& media, const gpu_scene::VolumeSet& volumes,
                                            double budgetBytes);

} // namespace tyndall::render

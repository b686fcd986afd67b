// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/cell_grids.h"
#include "light_cache_probe_io.h"
#include "render/light_caches.h"
#include "support/render_scenes.h"

#include <optional>
#include <string>
#include <vector>

namespace tyndall::test {

/// A light in the voxel space of the grid below.
struct CacheLight {
  std::string name;
  glm::dvec3 place{0.0}; ///< distant: towards it, of any length; else its position
  bool distant = false;
};

/// A grid on the device with its light caches and their references in double.
class CacheScene {
public:
  CacheScene(const volume::BrickGrid& grid, double sigmaT);

  /// The field's bounds in voxel space.
  Bounds3 bounds() const;
  /// Extinction times the longest edge of a voxel times the highest density: what a voxel's depth cannot exceed much.
  double voxelDepth() const;
  render::LightCachePlan plan(const CacheLight& light, double spacing) const;
  std::vector<render::LightCachePlan> plans(const std::vector<render::LightCacheRequest>& requests, double bytes) const;
  render::LightCacheRequest request(const CacheLight& light, double spacing) const;
  render::LightCaches build(const render::LightCachePlan& plan) const;

  /// What the device holds at every node.
  std::vector<float> nodes(const render::LightCaches& caches, const render::LightCachePlan& plan) const;
  /// lightCacheDepth at points in voxel space.
  std::vector<float> inside(const render::LightCaches& caches, const std::vector<glm::dvec3>& voxelPoints) const;
  /// lightDepthFrom at points given in voxel space, anywhere.
  std::vector<float> from(const render::LightCaches& caches, const CacheLight& light,
                          const std::vector<glm::dvec3>& voxelPoints) const;
  /// volume::exactOpticalDepth between a point in voxel space and the light.
  double exact(const CacheLight& light, const glm::dvec3& voxelPoint) const;

private:
  std::vector<float> probe(interop::LightCacheProbeInputs inputs, const std::vector<glm::vec3>& points) const;
  glm::dvec3 world(const glm::dvec3& voxelPoint) const;

  TestScene test_;
  double sigmaT_;
  glm::dvec3 centre_;
  gpu_scene::PackedMedia media_;
  gpu_scene::CellGrids cells_;
};

/// Position of node (a, b, j) in voxel space, in double from the plan's own numbers.
glm::dvec3 nodePlace(const interop::LightCache& cache, const glm::ivec3& node);
/// Node `index` of the depths: a fastest, then b, then j.
glm::ivec3 nodeOf(const interop::LightCache& cache, std::size_t index);

} // namespace tyndall::test

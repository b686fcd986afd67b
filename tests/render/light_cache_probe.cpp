// SPDX-License-Identifier: Apache-2.0
#include "render/light_cache_probe.h"

#include "render/light_cache_lattice.h"
#include "support/probe.h"
#include "volume/depth.h"

// Needs <cstdint> before it.
#include "kernels/light_cache_probe.h"

#include <algorithm>
#include <limits>

namespace tyndall::test {

CacheScene::CacheScene(const volume::BrickGrid& grid, double sigmaT)
    : sigmaT_(sigmaT), centre_(glm::round(grid.worldBounds().centre())) {
  test_.grid(grid, sigmaT);
  media_ = gpu_scene::packMedia(test_.scene, test_.volumes, centre_);
  cells_ = gpu_scene::CellGrids(probeDevice(), media_, test_.volumes);
}

Bounds3 CacheScene::bounds() const {
  const volume::BrickGrid& grid = test_.volumes.grids.front();
  const Bounds3 index = grid.indexBounds();
  return {index.min - glm::dvec3(grid.firstVoxel), index.max - glm::dvec3(grid.firstVoxel)};
}

double CacheScene::voxelDepth() const {
  const volume::BrickGrid& grid = test_.volumes.grids.front();
  double edge = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    edge = std::max(edge, glm::length(grid.worldFromIndex[axis]));
  }
  return sigmaT_ * edge * double(grid.maximum());
}

glm::dvec3 CacheScene::world(const glm::dvec3& voxelPoint) const {
  const volume::BrickGrid& grid = test_.volumes.grids.front();
  return glm::dvec3(grid.worldFromIndex * glm::dvec4(voxelPoint + glm::dvec3(grid.firstVoxel), 1.0));
}

render::LightCacheRequest CacheScene::request(const CacheLight& light, double spacing) const {
  const glm::dvec3 direction = world(light.place) - world(glm::dvec3(0.0));
  return {0, sigmaT_, light.distant, light.distant ? glm::normalize(direction) : world(light.place) - centre_, spacing};
}

std::vector<render::LightCachePlan> CacheScene::plans(const std::vector<render::LightCacheRequest>& requests,
                                                      double bytes) const {
  return render::planLightCaches(requests, media_, test_.volumes, bytes);
}

render::LightCachePlan CacheScene::plan(const CacheLight& light, double spacing) const {
  return plans({request(light, spacing)}, 1e12).front();
}

render::LightCaches CacheScene::build(const render::LightCachePlan& plan) const {
  return render::LightCaches(probeDevice(), cells_, {plan});
}

std::vector<float> CacheScene::probe(interop::LightCacheProbeInputs inputs,
                                     const std::vector<glm::vec3>& points) const {
  static const ProbeRunner runner(k_light_cache_probe_spirv);
  const auto input = ProbeRunner::upload(points.empty() ? std::vector<glm::vec3>(1) : points);
  const auto output = ProbeRunner::results<float>(inputs.count);
  inputs.grids = cells_.ptr();
  inputs.points = input.ptr();
  inputs.depths = output.ptr();
  runner.run(inputs, inputs.count);
  return ProbeRunner::download(output);
}

std::vector<float> CacheScene::nodes(const render::LightCaches& caches, const render::LightCachePlan& plan) const {
  interop::LightCacheProbeInputs inputs{};
  inputs.caches = caches.ptr();
  inputs.mode = interop::kProbeNodes;
  inputs.count = static_cast<std::uint32_t>(plan.nodes());
  return probe(inputs, {});
}

std::vector<float> CacheScene::inside(const render::LightCaches& caches,
                                      const std::vector<glm::dvec3>& voxelPoints) const {
  interop::LightCacheProbeInputs inputs{};
  inputs.caches = caches.ptr();
  inputs.mode = interop::kProbeInside;
  inputs.count = static_cast<std::uint32_t>(voxelPoints.size());
  return probe(inputs, {voxelPoints.begin(), voxelPoints.end()});
}

std::vector<float> CacheScene::from(const render::LightCaches& caches, const CacheLight& light,
                                    const std::vector<glm::dvec3>& voxelPoints) const {
  std::vector<glm::vec3> points;
  for (const glm::dvec3& point : voxelPoints) {
    points.emplace_back(world(point) - centre_);
  }
  interop::LightCacheProbeInputs inputs{};
  inputs.caches = caches.ptr();
  inputs.light = request(light, 1.0).light;
  inputs.distant = light.distant ? 1 : 0;
  inputs.mode = interop::kProbeFrom;
  inputs.count = static_cast<std::uint32_t>(points.size());
  return probe(inputs, points);
}

double CacheScene::exact(const CacheLight& light, const glm::dvec3& voxelPoint) const {
  const glm::dvec3 point = world(voxelPoint);
  const glm::dvec3 way = light.distant ? request(light, 1.0).light : world(light.place) - point;
  const double end = light.distant ? std::numeric_limits<double>::infinity() : 1.0;
  return sigmaT_ * volume::exactOpticalDepth(test_.volumes.grids.front(), point, way, 0.0, end);
}

glm::dvec3 nodePlace(const interop::LightCache& cache, const glm::ivec3& node) {
  const glm::dvec3 n(node);
  if (cache.kind == interop::kCacheOctahedral) {
    const glm::dvec2 square = 2.0 * glm::dvec2(n) / glm::dvec2(cache.count - 1) - 1.0;
    const double radius = double(cache.firstRadius) + n.z * double(cache.radiusStep);
    return glm::dvec3(cache.origin0) + radius * render::octahedralDirection(square);
  }
  const glm::dvec3 origin =
      glm::dvec3(cache.origin0) + n.x * glm::dvec3(cache.originA) + n.y * glm::dvec3(cache.originB);
  const glm::dvec3 step = glm::dvec3(cache.step0) + n.x * glm::dvec3(cache.stepA) + n.y * glm::dvec3(cache.stepB);
  return origin + n.z * step;
}

glm::ivec3 nodeOf(const interop::LightCache& cache, std::size_t index) {
  const auto i = static_cast<int>(index);
  return {i % cache.count.x, i / cache.count.x % cache.count.y, i / (cache.count.x * cache.count.y)};
}

} // namespace tyndall::test

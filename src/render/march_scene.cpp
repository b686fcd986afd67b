// SPDX-License-Identifier: Apache-2.0
#include "render/march_scene.h"

#include "render/sky_set.h"

#include <algorithm>

namespace tyndall::render {
namespace {

using interop::kNoCache;

constexpr double kSkySpacing = 4.0; // voxels, of the caches of sky directions
/// Of the memory for caches, what those of sky directions may take.
constexpr double kSkyShare = 0.5;
/// Point lights that every ray takes where there are too many to take them all.
constexpr std::uint32_t kStrongestPoints = 3;
/// Pieces of homogeneous media, and of cells that are dense, on one ray.
constexpr std::uint32_t kOtherPieces = 4096;

bool isEnvironment(const interop::DistantLight& light) {
  return light.kind == interop::kDistantConstant || light.kind == interop::kDistantMap;
}

/// One per sun, one for all environments.
std::size_t distantBeams(const std::vector<interop::DistantLight>& distant) {
  const auto environments = static_cast<std::size_t>(std::count_if(distant.begin(), distant.end(), isEnvironment));
  return distant.size() - environments + std::min<std::size_t>(environments, 1);
}

std::uint32_t pointBeams(std::size_t points, std::size_t others) {
  const auto room = static_cast<std::uint32_t>(interop::kMaxBeams - others);
  return points <= room ? static_cast<std::uint32_t>(points) : std::min(kStrongestPoints, room - 1);
}

/// Cells that a straight line can cross, all grids together.
std::uint32_t cellsAcross(const gpu_scene::PackedMedia& media) {
  std::uint32_t cells = 0;
  for (const gpu_scene::PackedMedia::Placement& placement : media.placements) {
    const glm::ivec3 count = placement.header.brickCount * volume::kBrickEdge;
    cells += static_cast<std::uint32_t>(count.x + count.y + count.z);
  }
  return cells;
}

/// A cache of one light for each density grid, to be placed in the table of caches.
void want(const gpu_scene::PackedMedia& media, std::uint32_t group, LightCacheRequest request,
          std::vector<LightCacheRequest>& wanted, std::vector<std::uint32_t>& place) {
  for (const interop::Medium& medium : media.media) {
    if (medium.densityGrid != interop::kNoGrid && medium.sigmaT > 0.0f) {
      request.grid = medium.densityGrid;
      request.sigmaT = double(medium.sigmaT);
      wanted.push_back(request);
      place.push_back(group * static_cast<std::uint32_t>(media.placements.size()) + medium.densityGrid);
    }
  }
}

/// Enters plans into the table; requests without a plan have no cache.
void enter(const std::vector<LightCachePlan>& plans, const std::vector<std::uint32_t>& place,
           std::vector<std::uint32_t>& table) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    table[place[plans[i].request]] = static_cast<std::uint32_t>(i);
  }
}

} // namespace

std::uint32_t mostPieces(const gpu_scene::PackedMedia& media) { return 2 * cellsAcross(media) + kOtherPieces; }

std::uint32_t mostPreparation(const gpu_scene::PackedMedia& media) { return 2 * mostPieces(media); }

std::uint32_t mostIterations(const gpu_scene::PackedMedia& media, std::uint32_t corrections) {
  return mostPieces(media) + corrections * cellsAcross(media);
}

MarchPlan planMarch(const gpu_scene::GpuScene& scene) {
  const std::vector<interop::DistantLight>& distant = scene.distantLights();
  MarchPlan plan;
  plan.sky = std::any_of(distant.begin(), distant.end(), isEnvironment);
  interop::MarchScene& header = plan.header;
  const std::size_t points = scene.pointLights().size();
  header.pointBeams = pointBeams(points, distantBeams(distant));
  header.distantGroup = header.pointBeams;
  header.skyGroup = header.pointBeams + static_cast<std::uint32_t>(distant.size());
  header.maxSteps = mostPieces(scene.media());
  const SkyShares shares = skyShares(scene);
  header.skyLightShare = shares.light;
  header.skyPhaseShare = shares.phase;
  plan.beams =
      header.pointBeams + static_cast<std::uint32_t>(distantBeams(distant)) + (points > header.pointBeams ? 1 : 0);
  plan.groups = header.skyGroup + (plan.sky ? interop::kSkyDirections : 0);
  for (std::uint32_t i = 0; i < distant.size(); ++i) {
    if (!isEnvironment(distant[i])) {
      want(scene.media(), header.distantGroup + i, {0, 0.0, true, glm::dvec3(distant[i].toLight), 0.0}, plan.wanted,
           plan.place);
    }
  }
  for (std::uint32_t i = 0; i < header.pointBeams; ++i) {
    want(scene.media(), i, {0, 0.0, false, glm::dvec3(scene.pointLights()[i].position), 0.0}, plan.wanted, plan.place);
  }
  return plan;
}

MarchScene::MarchScene(const gpu::Device& device, const gpu_scene::GpuScene& scene, const gpu_scene::VolumeSet& volumes,
                       double cacheBytes)
    : scene_(scene), volumes_(volumes), plan_(planMarch(scene)),
      skyBytes_(plan_.sky ? (plan_.wanted.empty() ? 1.0 : kSkyShare) * cacheBytes : 0.0),
      caches_(device, scene.cells()), skyCaches_(device, scene.cells()), wanted_(plan_.wanted.size()),
      places_(std::size_t(plan_.groups) * scene.media().placements.size(), kNoCache),
      cacheOf_(device, std::max<std::size_t>(places_.size(), 1), gpu::Memory::Device),
      sky_(device, interop::kSkyDirections, gpu::Memory::Device), header_(device, 1, gpu::Memory::Device) {
  const std::vector<LightCachePlan> plans =
      planLightCaches(plan_.wanted, scene.media(), volumes, cacheBytes - skyBytes_);
  caches_.build(plans);
  enter(plans, plan_.place, places_);
  interop::MarchScene& header = plan_.header;
  header.grids = scene.cells().ptr();
  header.caches = caches_.ptr();
  header.cacheOf = cacheOf_.ptr();
  header.sky = sky_.ptr();
  header.centre = glm::vec3(scene.bounds().centre() - scene.centre());
  header.radius = static_cast<float>(0.5 * glm::length(scene.bounds().size()));
  upload();
}

void MarchScene::upload() {
  if (!places_.empty()) {
    cacheOf_.write(places_);
  }
  header_.write(std::span<const interop::MarchScene>(&plan_.header, 1));
}

void MarchScene::begin(std::uint32_t seed, std::uint32_t batch) {
  if (!plan_.sky || batch_ == std::pair(seed, batch)) {
    return;
  }
  batch_ = {seed, batch};
  const std::vector<glm::vec3> directions = skyDirections(seed, batch);
  sky_.write(directions);
  std::vector<LightCacheRequest> wanted;
  std::vector<std::uint32_t> place;
  for (std::uint32_t k = 0; k < interop::kSkyDirections; ++k) {
    want(scene_.media(), plan_.header.skyGroup + k, {0, 0.0, true, glm::dvec3(directions[k]), kSkySpacing}, wanted,
         place);
  }
  const std::vector<LightCachePlan> plans = planLightCaches(wanted, scene_.media(), volumes_, skyBytes_);
  skyCaches_.build(plans);
  wanted_ = plan_.wanted.size() + wanted.size();
  const std::size_t first = std::size_t(plan_.header.skyGroup) * scene_.media().placements.size();
  std::fill(places_.begin() + std::ptrdiff_t(first), places_.end(), kNoCache);
  enter(plans, place, places_);
  plan_.header.skyCaches = skyCaches_.ptr();
  upload();
}

CacheReport MarchScene::caches() const {
  const std::size_t count = caches_.size() + skyCaches_.size();
  return {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(wanted_ - count),
          caches_.bytes() + skyCaches_.bytes(), caches_.buildSeconds() + skyCaches_.buildSeconds()};
}

} // namespace tyndall::render

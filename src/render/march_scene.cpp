// SPDX-License-Identifier: Apache-2.0
#include "render/march_scene.h"

#include <algorithm>
#include <numeric>

namespace tyndall::render {
namespace {

using interop::kNoCache;

/// Cached directions of environments: the cells of a square of this edge on the octahedral map.
constexpr std::uint32_t kSectorEdge = 4;
constexpr double kSectorSpacing = 2.0; // voxels: the direction is off by more than the lattice
/// A disc wider than this may be narrower seen by the phase function than by its own sampler: 1 - cos(2 degrees).
constexpr float kWideDisc = 6e-4f;
/// Point lights that every ray takes where there are too many to take them all.
constexpr std::uint32_t kStrongestPoints = 3;
/// Pieces of homogeneous media, and of cells that are dense, on one ray.
constexpr std::uint32_t kOtherPieces = 4096;

bool isEnvironment(const interop::DistantLight& light) {
  return light.kind == interop::kDistantConstant || light.kind == interop::kDistantMap;
}

bool wantsPhaseBeam(const interop::DistantLight& light) {
  return isEnvironment(light) || (light.kind == interop::kDistantDisc && light.oneMinusCos > kWideDisc);
}

/// The direction in the middle of cell (x, y) of the octahedral square; shaders/core/octahedral.glsl.
glm::dvec3 sectorDirection(std::uint32_t x, std::uint32_t y) {
  const glm::dvec2 place = 2.0 * (glm::dvec2(x, y) + 0.5) / double(kSectorEdge) - 1.0;
  const double z = 1.0 - std::abs(place.x) - std::abs(place.y);
  const glm::dvec2 folded(std::copysign(1.0 - std::abs(place.y), place.x), std::copysign(1.0 - std::abs(place.x), place.y));
  return glm::normalize(glm::dvec3(z >= 0.0 ? place : folded, z));
}

std::uint32_t pointBeams(std::size_t points, std::size_t others) {
  const auto room = static_cast<std::uint32_t>(interop::kMaxBeams - others);
  return points <= room ? static_cast<std::uint32_t>(points) : std::min(kStrongestPoints, room - 1);
}

class Planner {
public:
  explicit Planner(const gpu_scene::GpuScene& scene) : scene_(scene) {}

  MarchPlan run() {
    const std::vector<interop::DistantLight>& distant = scene_.distantLights();
    const bool phaseBeam = std::any_of(distant.begin(), distant.end(), wantsPhaseBeam);
    interop::MarchScene& header = plan_.header;
    header.phaseBeam = phaseBeam ? 1 : 0;
    header.pointBeams = pointBeams(scene_.pointLights().size(), distant.size() + header.phaseBeam);
    header.distantGroup = header.pointBeams;
    header.sectorGroup = header.pointBeams + static_cast<std::uint32_t>(distant.size());
    const bool environment = std::any_of(distant.begin(), distant.end(), isEnvironment);
    header.sectorEdge = environment ? kSectorEdge : 0;
    header.maxSteps = mostPieces(scene_.media());
    plan_.groups = header.sectorGroup + header.sectorEdge * header.sectorEdge;
    for (std::uint32_t i = 0; i < distant.size(); ++i) {
      if (!isEnvironment(distant[i])) {
        want(header.distantGroup + i, {0, 0.0, true, glm::dvec3(distant[i].toLight), 0.0});
      }
    }
    for (std::uint32_t i = 0; i < header.pointBeams; ++i) {
      want(i, {0, 0.0, false, glm::dvec3(scene_.pointLights()[i].position), 0.0});
    }
    for (std::uint32_t i = 0; i < header.sectorEdge * header.sectorEdge; ++i) {
      want(header.sectorGroup + i, {0, 0.0, true, sectorDirection(i % kSectorEdge, i / kSectorEdge), kSectorSpacing});
    }
    return std::move(plan_);
  }

private:
  /// A cache of one light for each density grid.
  void want(std::uint32_t group, LightCacheRequest request) {
    const gpu_scene::PackedMedia& media = scene_.media();
    for (const interop::Medium& medium : media.media) {
      if (medium.densityGrid != interop::kNoGrid) {
        request.grid = medium.densityGrid;
        request.sigmaT = double(medium.sigmaT);
        plan_.wanted.push_back(request);
        plan_.place.push_back(group * static_cast<std::uint32_t>(media.placements.size()) + medium.densityGrid);
      }
    }
  }

  const gpu_scene::GpuScene& scene_;
  MarchPlan plan_;
};

} // namespace

std::uint32_t mostPieces(const gpu_scene::PackedMedia& media) {
  std::uint32_t cells = 0;
  for (const gpu_scene::PackedMedia::Placement& placement : media.placements) {
    const glm::ivec3 count = placement.header.brickCount * volume::kBrickEdge;
    cells += static_cast<std::uint32_t>(count.x + count.y + count.z);
  }
  return 2 * cells + kOtherPieces;
}

std::uint32_t mostBeams(const gpu_scene::GpuScene& scene) {
  const interop::MarchScene header = planMarch(scene).header;
  const std::size_t drawn = scene.pointLights().size() > header.pointBeams ? 1 : 0;
  return header.pointBeams + header.phaseBeam + static_cast<std::uint32_t>(scene.distantLights().size() + drawn);
}

MarchPlan planMarch(const gpu_scene::GpuScene& scene) { return Planner(scene).run(); }

MarchScene::MarchScene(const gpu::Device& device, const gpu_scene::GpuScene& scene,
                       const gpu_scene::VolumeSet& volumes, double cacheBytes) {
  MarchPlan plan = planMarch(scene);
  const std::vector<LightCachePlan> caches = planLightCaches(plan.wanted, scene.media(), volumes, cacheBytes);
  caches_ = LightCaches(device, scene.cells(), caches);
  std::vector<std::uint32_t> cacheOf(std::size_t(plan.groups) * scene.media().placements.size(), kNoCache);
  for (std::size_t i = 0; i < caches.size(); ++i) {
    cacheOf[plan.place[caches[i].request]] = static_cast<std::uint32_t>(i);
  }
  cacheOf_ = gpu::Buffer<std::uint32_t>(device, std::span<const std::uint32_t>(cacheOf));
  plan.header.grids = scene.cells().ptr();
  plan.header.caches = caches_.ptr();
  plan.header.cacheOf = cacheOf_.ptr();
  plan.header.centre = glm::vec3(scene.bounds().centre() - scene.centre());
  plan.header.radius = static_cast<float>(0.5 * glm::length(scene.bounds().size()));
  header_ = gpu::Buffer<interop::MarchScene>(device, std::span<const interop::MarchScene>(&plan.header, 1));
  report_ = {static_cast<std::uint32_t>(caches.size()), static_cast<std::uint32_t>(plan.wanted.size() - caches.size()),
             caches_.bytes(), caches_.buildSeconds()};
}

} // namespace tyndall::render

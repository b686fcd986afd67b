// SPDX-License-Identifier: Apache-2.0
#include "render/choose.h"

#include "base/error.h"
#include "gpu_scene/lights.h"
#include "interop/march.h"
#include "render/march_scene.h"
#include "render/sky_set.h"

#include <algorithm>

namespace tyndall::render {
namespace {

/// 2 GiB: byte offsets that 32 bits hold, and indices that are signed on the device.
constexpr double kMostArrayBytes = 2147483648.0;
/// Light caches beyond this share of the memory would rather be coarser.
constexpr double kCacheShare = 0.5;

/// Why the march does not serve, or empty.
std::string obstacle(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                     const gpu_scene::PackedMedia& media, double memoryBytes) {
  const auto distant = std::count_if(scene.lights.begin(), scene.lights.end(), [](const scene::NamedLight& named) {
    return !std::holds_alternative<scene::PointLight>(named.light);
  });
  if (media.placements.size() > interop::kMaxSlots) {
    return fmt::format("{} grids are placed, it walks at most {} side by side", media.placements.size(),
                       interop::kMaxSlots);
  }
  if (media.homogeneousCount > interop::kMaxHomogeneous) {
    return fmt::format("there are {} homogeneous media, it takes at most {}", media.homogeneousCount,
                       interop::kMaxHomogeneous);
  }
  if (distant + 2 > std::ptrdiff_t(interop::kMaxBeams)) {
    return fmt::format("there are {} lights at infinity, it takes at most {}", distant, interop::kMaxBeams - 2);
  }
  if (mostPreparation(media) + mostIterations(media, EstimatorOptions{}.corrections) > kMostIterations) {
    return "a ray may cross too many voxels for one dispatch";
  }
  const double largest = gpu_scene::largestCellArray(media, volumes);
  if (largest > kMostArrayBytes) {
    return fmt::format("one grid needs {:.1f} MB as cells, one array holds {:.1f} MB", largest * 1e-6,
                       kMostArrayBytes * 1e-6);
  }
  const double cellBytes = gpu_scene::plannedCellBytes(media, volumes);
  if (cellBytes > memoryBytes) {
    return fmt::format("its grids need {:.1f} MB of device memory, {:.1f} MB are allowed", cellBytes * 1e-6,
                       memoryBytes * 1e-6);
  }
  return "";
}

/// What only paths can follow, or empty.
std::string needForPaths(const scene::Scene& scene, const gpu_scene::PackedMedia& media) {
  const bool spots = std::any_of(scene.lights.begin(), scene.lights.end(), [](const scene::NamedLight& named) {
    return std::holds_alternative<scene::SpotLight>(named.light);
  });
  return !scene.objects.empty()                               ? "there are surfaces"
         : scene.render.integrator != scene::Integrator::Path ? "directions are guided"
         : !scene.render.lightSampling                        ? "lights are found by directions alone"
         : scene.depth() != 1                                 ? "light scatters more than once"
         : media.chromatic                                    ? "extinction differs by channel"
         : spots                                              ? "there are spot lights"
         : scene.camera.lensRadius > 0.0 && scene.camera.kind == scene::Camera::Kind::Perspective
             ? "the camera has a lens"
             : "";
}

/// The set of sky directions is too coarse for a narrow peak, and nothing else would gain from the march.
bool trackingIsBetter(const scene::Scene& scene, const gpu_scene::PackedMedia& media) {
  const bool sky =
      !scene.lights.empty() && std::none_of(scene.lights.begin(), scene.lights.end(), [](const auto& named) {
        return std::holds_alternative<scene::PointLight>(named.light) ||
               std::holds_alternative<scene::SunLight>(named.light);
      });
  return sky && std::any_of(media.media.begin(), media.media.end(),
                            [](const interop::Medium& medium) { return peaked(medium.phase); });
}

} // namespace

MethodChoice chooseMethod(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, std::optional<Method> wanted,
                          double memoryBytes) {
  const gpu_scene::PackedMedia media = gpu_scene::packMedia(scene, volumes, sceneBounds(scene, volumes).centre());
  const std::string need = needForPaths(scene, media);
  if (!need.empty() && wanted && *wanted != Method::Path) {
    fail("--estimator {}: it follows one event in media, but {}; use --estimator path or auto", methodName(*wanted),
         need);
  }
  if (!need.empty() || wanted == Method::Path) {
    return {Method::Path, 0.0, need.empty() ? "as asked for" : need};
  }
  if (wanted == Method::Tracking) {
    return {Method::Tracking, 0.0, "as asked for"};
  }
  const double cellBytes = gpu_scene::plannedCellBytes(media, volumes);
  const std::string why = obstacle(scene, volumes, media, memoryBytes);
  if (!why.empty() && wanted) {
    fail("--estimator march: {}; use --estimator tracking or auto", why);
  }
  if (!why.empty()) {
    return {Method::Tracking, 0.0, "the march does not serve: " + why};
  }
  if (!wanted && trackingIsBetter(scene, media)) {
    return {Method::Tracking, 0.0, "less variance where environments alone light a peaked phase function"};
  }
  return {Method::March, std::min(kCacheShare * memoryBytes, memoryBytes - cellBytes),
          wanted ? "as asked for" : "least variance for its time"};
}

} // namespace tyndall::render

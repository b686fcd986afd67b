// SPDX-License-Identifier: Apache-2.0
#include "render/distance_frames.h"

#include "gpu_scene/media.h"

#include <cmath>
#include <optional>

namespace tyndall::render {
namespace {

/// A ray through a place of the picture, x and y in [0, 1].
struct Ray {
  glm::dvec3 origin;
  glm::dvec3 direction; ///< unit
};

Ray rayThrough(const interop::Camera& camera, bool orthographic, const glm::dvec2& raster) {
  const glm::dvec3 offset = raster.x * glm::dvec3(camera.rasterX) + raster.y * glm::dvec3(camera.rasterY);
  const glm::dvec3 corner(camera.corner);
  return orthographic ? Ray{glm::dvec3(camera.origin) + offset, glm::normalize(corner)}
                      : Ray{glm::dvec3(camera.origin), glm::normalize(corner + offset)};
}

/// Where a camera sees a point; nullopt: behind it.
std::optional<glm::dvec2> rasterOf(const interop::Camera& camera, bool orthographic, const glm::dvec3& point) {
  const glm::dmat3 axes(camera.rasterX, camera.rasterY, camera.corner);
  const glm::dvec3 place = glm::inverse(axes) * (point - glm::dvec3(camera.origin));
  if (!(place.z > 0.0)) {
    return std::nullopt;
  }
  return glm::dvec2(place) / (orthographic ? 1.0 : place.z);
}

bool isOrthographic(const scene::Camera& camera) { return camera.kind == scene::Camera::Kind::Orthographic; }

} // namespace

std::vector<interop::DistanceState> movedDistances(std::span<const interop::DistanceState> states,
                                                   const guide::StoreSize& size, double width, const CameraMove& move) {
  const glm::dvec3 centre = move.now.position; // floats are told apart best there
  const interop::Camera before = gpu_scene::packCamera(move.before, move.size, centre);
  const interop::Camera now = gpu_scene::packCamera(move.now, move.size, centre);
  const glm::dvec2 picture(move.size);
  std::vector<interop::DistanceState> moved(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::size_t vertex = i / size.distanceStates;
    const glm::dvec2 place(double(vertex % size.distanceColumns), double(vertex / size.distanceColumns));
    const Ray from = rayThrough(before, isOrthographic(move.before), place * width / picture);
    const glm::dvec3 point = from.origin + double(states[i].mean) * from.direction;
    const auto raster = rasterOf(now, isOrthographic(move.now), point);
    if (!(states[i].weight > 0.0f) || !raster) {
      continue;
    }
    const glm::dvec2 target = glm::round(*raster * picture / width);
    const glm::dvec2 last(size.distanceColumns - 1, size.distanceRows - 1);
    if (!glm::all(glm::lessThanEqual(glm::abs(target - 0.5 * last), 0.5 * last))) {
      continue;
    }
    const std::size_t there = std::size_t(target.y) * size.distanceColumns + std::size_t(target.x);
    interop::DistanceState& slot = moved[there * size.distanceStates + i % size.distanceStates];
    if (states[i].weight > slot.weight) { // vertices that fall together keep the brighter one
      slot = states[i];
      const Ray to = rayThrough(now, isOrthographic(move.now), *raster);
      slot.mean = float(glm::dot(point - to.origin, to.direction));
    }
  }
  return moved;
}

void moveDistances(guide::Store& store, const scene::GuideSettings& settings, const CameraMove& move) {
  const interop::Camera before = gpu_scene::packCamera(move.before, move.size, move.now.position);
  const interop::Camera now = gpu_scene::packCamera(move.now, move.size, move.now.position);
  const bool still = before.origin == now.origin && before.corner == now.corner && before.rasterX == now.rasterX &&
                     before.rasterY == now.rasterY;
  if (store.size().distanceVertices() > 0 && !still) {
    store.setDistances(movedDistances(store.distances(), store.size(), settings.distanceWidth, move));
  }
}

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#include "render/coverage.h"

#include "scene/camera_frame.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall::render {
namespace {

using volume::BrickGrid;
using volume::kBrickEdge;
using volume::kCoarseEdge;

/// Finer than this many bricks, and the coarse cells do: the mask must not cost more than it saves.
constexpr std::size_t kMaxBricks = 400000;
/// Float rays stray from the exact ones by less than this many pixels.
constexpr double kMargin = 0.01;

/// The camera in double: world point -> raster position and depth.
class Projection {
public:
  Projection(const scene::Camera& camera, const glm::uvec2& size)
      : position_(camera.position), frame_(scene::cameraFrame(camera)), size_(size) {
    perspective_ = camera.kind == scene::Camera::Kind::Perspective;
    halfHeight_ = perspective_ ? std::tan(glm::radians(0.5 * camera.verticalFov)) : 0.5 * camera.height;
  }

  /// Raster x, y in pixels and depth along the view direction.
  glm::dvec3 project(const glm::dvec3& world) const {
    const glm::dvec3 offset = world - position_;
    const double depth = glm::dot(offset, frame_.forward);
    const double scale = 0.5 * size_.y / (halfHeight_ * (perspective_ ? depth : 1.0));
    return {0.5 * size_.x + scale * glm::dot(offset, frame_.right), 0.5 * size_.y - scale * glm::dot(offset, frame_.up),
            depth};
  }
  bool perspective() const { return perspective_; }

private:
  glm::dvec3 position_;
  scene::CameraFrame frame_;
  glm::dvec2 size_;
  double halfHeight_ = 1.0;
  bool perspective_ = true;
};

class Mask {
public:
  Mask(const scene::Camera& camera, const glm::uvec2& size)
      : projection_(camera, size), size_(size), flags_(std::size_t(size.x) * size.y, false) {}

  void markAll() { std::fill(flags_.begin(), flags_.end(), true); }

  /// Marks what the image of a box may touch: the rectangle around its corners, or everything if it reaches behind
  /// the camera.
  void markBox(const glm::dmat4& worldFromLocal, const Bounds3& box) {
    glm::dvec2 low(INFINITY);
    glm::dvec2 high(-INFINITY);
    double nearest = INFINITY;
    double farthest = -INFINITY;
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 raster = projection_.project(glm::dvec3(worldFromLocal * glm::dvec4(box.corner(i), 1.0)));
      low = glm::min(low, glm::dvec2(raster));
      high = glm::max(high, glm::dvec2(raster));
      nearest = std::min(nearest, raster.z);
      farthest = std::max(farthest, raster.z);
    }
    if (farthest < 0.0) {
      return;
    }
    if (projection_.perspective() && nearest <= 1e-6 * farthest) {
      markAll();
      return;
    }
    markRectangle(low - kMargin, high + kMargin);
  }

  std::vector<bool> take() { return std::move(flags_); }

private:
  void markRectangle(const glm::dvec2& low, const glm::dvec2& high) {
    const glm::dvec2 first = glm::clamp(glm::floor(low), glm::dvec2(0.0), glm::dvec2(size_));
    const glm::dvec2 last = glm::clamp(glm::floor(high) + 1.0, glm::dvec2(0.0), glm::dvec2(size_));
    for (auto y = static_cast<std::size_t>(first.y); y < static_cast<std::size_t>(last.y); ++y) {
      const auto row = flags_.begin() + static_cast<std::ptrdiff_t>(y * size_.x);
      std::fill(row + static_cast<std::ptrdiff_t>(first.x),
                row + std::max(static_cast<std::ptrdiff_t>(last.x), static_cast<std::ptrdiff_t>(first.x)), true);
    }
  }

  Projection projection_;
  glm::uvec2 size_;
  std::vector<bool> flags_;
};

void markCells(Mask& mask, const glm::dmat4& worldFromIndex, const BrickGrid& grid, const glm::ivec3& count, int edge,
               const auto& occupied) {
  std::size_t index = 0;
  const Bounds3 support = grid.indexBounds();
  for (int z = 0; z < count.z; ++z) {
    for (int y = 0; y < count.y; ++y) {
      for (int x = 0; x < count.x; ++x, ++index) {
        if (!occupied(index)) {
          continue;
        }
        const glm::dvec3 first = glm::dvec3(grid.firstVoxel) + double(edge) * glm::dvec3(x, y, z);
        mask.markBox(worldFromIndex, {glm::max(first, support.min), glm::min(first + double(edge), support.max)});
      }
    }
  }
}

void markGrid(Mask& mask, const glm::dmat4& worldFromMedium, const BrickGrid& grid, double outsideValue) {
  const glm::dmat4 worldFromIndex = worldFromMedium * grid.worldFromIndex;
  if (outsideValue != 0.0) { // emission glows where the grid itself is 0
    mask.markBox(worldFromIndex, grid.indexBounds());
  } else if (grid.bricks.size() <= kMaxBricks) {
    markCells(mask, worldFromIndex, grid, grid.brickCount, kBrickEdge,
              [&](std::size_t i) { return grid.ranges[i].max > 0.0f; });
  } else {
    markCells(mask, worldFromIndex, grid, grid.coarseCount, kBrickEdge * kCoarseEdge,
              [&](std::size_t i) { return grid.coarseMax[i] > 0.0f; });
  }
}

void markHomogeneous(Mask& mask, const scene::Medium& medium, const glm::dmat4& worldFromMedium) {
  switch (medium.shape) {
  case scene::MediumShape::Unbounded:
    mask.markAll();
    return;
  case scene::MediumShape::Box:
    mask.markBox(worldFromMedium, medium.box);
    return;
  case scene::MediumShape::Sphere:
    mask.markBox(worldFromMedium, {medium.centre - medium.radius, medium.centre + medium.radius});
    return;
  case scene::MediumShape::Objects:
    return; // its objects are marked
  }
}

void markMedium(Mask& mask, const scene::Medium& medium, const gpu_scene::VolumeSet& volumes,
                const gpu_scene::VolumeSet::Use& use) {
  for (const glm::dmat4& place : gpu_scene::placements(medium.worldFromMedium, medium.instances)) {
    if (medium.homogeneous()) {
      markHomogeneous(mask, medium, place);
    }
    if (use.density && !volumes.grids[*use.density].empty()) {
      markGrid(mask, place, volumes.grids[*use.density], 0.0);
    }
    if (medium.emission && use.emission && !volumes.grids[*use.emission].empty()) {
      markGrid(mask, place, volumes.grids[*use.emission], medium.emission->temperatureOffset);
    }
  }
}

} // namespace

std::vector<bool> sceneCoverage(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes) {
  Mask mask(scene.camera, scene.film.size);
  if (scene.camera.lensRadius > 0.0) {
    mask.markAll(); // out of focus everything is wider than it stands
    return mask.take();
  }
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    markMedium(mask, scene.media[i], volumes, volumes.uses[i]);
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Bounds3 local = gpu_scene::localBounds(scene.objects[i], volumes.meshes, i);
    for (const glm::dmat4& place :
         gpu_scene::placements(scene.objects[i].worldFromObject, scene.objects[i].instances)) {
      mask.markBox(place, local);
    }
  }
  return mask.take();
}

} // namespace tyndall::render

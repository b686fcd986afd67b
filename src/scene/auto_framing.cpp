// SPDX-License-Identifier: Apache-2.0
#include "scene/auto_framing.h"

#include "light/blackbody.h"
#include "math/colour.h"
#include "volume/depth.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace tyndall::scene {
namespace {

constexpr double kFov = 30.0;             // degrees across the shorter side: little perspective distortion
constexpr int kMapEdge = 40;              // rays a side
constexpr int kRounds = 4;
constexpr double kOpaque = 30.0;          // optical depth behind which nothing shows
constexpr double kVisibleDepth = 0.0513;  // -ln(1 - 0.05)
constexpr double kVisibleGlow = 0.05;     // of the strongest
constexpr int kGlowSteps = 256;
constexpr double kOccupied = 0.02;        // of the grid's maximum: where the first guess looks

struct Basis {
  glm::dvec3 forward, right, up;
  explicit Basis(const glm::dvec3& toCamera) : forward(-toCamera) {
    right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    up = glm::cross(right, forward);
  }
};

/// Box around the bricks that hold more than a trace.
void extendByBricks(Bounds3& bounds, const volume::BrickGrid* grid, const glm::dmat4& worldFromMedium) {
  if (grid == nullptr || grid->empty()) {
    return;
  }
  const double threshold = kOccupied * double(grid->maximum());
  const glm::dmat4 worldFromIndex = worldFromMedium * grid->worldFromIndex;
  const Bounds3 support = grid->indexBounds();
  std::size_t brick = 0;
  for (int z = 0; z < grid->brickCount.z; ++z) {
    for (int y = 0; y < grid->brickCount.y; ++y) {
      for (int x = 0; x < grid->brickCount.x; ++x, ++brick) {
        if (double(grid->ranges[brick].max) > threshold) {
          const glm::dvec3 first = glm::dvec3(grid->firstVoxel + volume::kBrickEdge * glm::ivec3(x, y, z));
          bounds.extend(transformed(worldFromIndex, {glm::max(first, support.min),
                                                     glm::min(first + double(volume::kBrickEdge), support.max)}));
        }
      }
    }
  }
}

/// Opacity and glow over a square of camera rays, strongest of all frames.
class VisibilityMap {
public:
  /// @param halfEdge of the square, as the tangent of the angle from its middle.
  VisibilityMap(const FramingInput& input, const glm::dvec3& position, double halfEdge) : halfEdge_(halfEdge) {
    const Basis basis(input.toCamera);
    tbb::parallel_for(0, kMapEdge, [&](int y) {
      for (int x = 0; x < kMapEdge; ++x) {
        const glm::dvec2 place = halfEdge * ((glm::dvec2(x, y) + 0.5) * (2.0 / kMapEdge) - 1.0);
        const glm::dvec3 direction = glm::normalize(basis.forward + place.x * basis.right + place.y * basis.up);
        measure(input, position, direction, static_cast<std::size_t>(x + kMapEdge * y));
      }
    });
  }

  /// Extent of what can be seen, in tangents from the middle; min > max: nothing.
  void extent(glm::dvec2& low, glm::dvec2& high) const {
    const double faintest = kVisibleGlow * *std::max_element(glow_.begin(), glow_.end());
    low = glm::dvec2(INFINITY);
    high = glm::dvec2(-INFINITY);
    for (int y = 0; y < kMapEdge; ++y) {
      for (int x = 0; x < kMapEdge; ++x) {
        const auto i = static_cast<std::size_t>(x + kMapEdge * y);
        if (depth_[i] > kVisibleDepth || (glow_[i] > 0.0 && glow_[i] >= faintest)) {
          low = glm::min(low, halfEdge_ * (glm::dvec2(x, y) * (2.0 / kMapEdge) - 1.0));
          high = glm::max(high, halfEdge_ * (glm::dvec2(x + 1, y + 1) * (2.0 / kMapEdge) - 1.0));
        }
      }
    }
  }

private:
  void measure(const FramingInput& input, const glm::dvec3& position, const glm::dvec3& direction, std::size_t place) {
    for (const VisibleVolume& volume : input.frames) {
      if (volume.density != nullptr && !volume.density->empty()) {
        const glm::dmat4 mediumFromWorld = glm::affineInverse(volume.worldFromMedium);
        const double depth = volume.densityScale * volume::exactOpticalDepth(
            *volume.density, glm::dvec3(mediumFromWorld * glm::dvec4(position, 1.0)),
            glm::dvec3(mediumFromWorld * glm::dvec4(direction, 0.0)), 0.0, INFINITY);
        depth_[place] = std::max(depth_[place], depth);
      }
      glow_[place] = std::max(glow_[place], glowAlong(volume, position, direction));
    }
  }

  double halfEdge_;
  std::vector<double> depth_ = std::vector<double>(kMapEdge * kMapEdge);
  std::vector<double> glow_ = std::vector<double>(kMapEdge * kMapEdge);
};

} // namespace

std::vector<double> glowTable(double kelvinScale, double maximum) {
  std::vector<double> table(kGlowSteps + 1);
  for (int i = 0; i <= kGlowSteps; ++i) {
    table[static_cast<std::size_t>(i)] = luminance(light::blackbodyRadiance(kelvinScale * maximum * i / kGlowSteps));
  }
  return table;
}

double glowAlong(const VisibleVolume& volume, const glm::dvec3& origin, const glm::dvec3& direction) {
  if (volume.temperature == nullptr || volume.temperature->empty()) {
    return 0.0;
  }
  const volume::BrickGrid& grid = *volume.temperature;
  const glm::dmat4 indexFromWorld = glm::affineInverse(volume.worldFromMedium * grid.worldFromIndex);
  const glm::dvec3 start(indexFromWorld * glm::dvec4(origin, 1.0));
  const glm::dvec3 step(indexFromWorld * glm::dvec4(direction, 0.0));
  const Bounds3 box = grid.indexBounds();
  const glm::dvec3 a = (box.min - start) / step;
  const glm::dvec3 b = (box.max - start) / step;
  const glm::dvec3 nearest = glm::min(a, b);
  const glm::dvec3 farthest = glm::max(a, b);
  const double tMin = std::max({nearest.x, nearest.y, nearest.z, 0.0});
  const double tMax = std::min({farthest.x, farthest.y, farthest.z});
  const auto maximum = double(grid.maximum());
  const bool dimmed = volume.density != nullptr && !volume.density->empty();
  const glm::dmat4 densityFromWorld =
      dimmed ? glm::affineInverse(volume.worldFromMedium * volume.density->worldFromIndex) : glm::dmat4(1.0);
  double depth = 0.0;
  const double stride = 1.0 / glm::length(step);
  double sum = 0.0;
  for (double t = tMin + 0.5 * stride; t < tMax; t += stride) {
    const double place = std::clamp(grid.value(start + t * step) / maximum, 0.0, 1.0) * kGlowSteps;
    const double emitted = stride * volume.glow[static_cast<std::size_t>(std::lround(place))];
    double stepDepth = 0.0;
    if (dimmed) {
      const glm::dvec3 index(densityFromWorld * glm::dvec4(origin + t * direction, 1.0));
      stepDepth = stride * volume.densityScale * volume.density->value(index);
    }
    // What leaves a homogeneous step towards the viewer.
    sum += emitted * std::exp(-depth) * (stepDepth > 1e-6 ? -std::expm1(-stepDepth) / stepDepth : 1.0);
    depth += stepDepth;
    if (depth > kOpaque) {
      break;
    }
  }
  return sum;
}

std::optional<Camera> frameSubject(const FramingInput& input) {
  Bounds3 bounds;
  for (const VisibleVolume& volume : input.frames) {
    extendByBricks(bounds, volume.density, volume.worldFromMedium);
    extendByBricks(bounds, volume.temperature, volume.worldFromMedium);
  }
  if (bounds.empty()) {
    return std::nullopt;
  }
  const Basis basis(input.toCamera);
  const double halfShort = std::tan(glm::radians(0.5 * kFov));
  const double aspect = double(input.size.x) / input.size.y;
  glm::dvec3 target = bounds.centre();
  const double radius = 0.5 * glm::length(bounds.size());
  double distance = radius / std::sin(glm::radians(0.5 * kFov));
  double halfEdge = 1.05 * halfShort;
  for (int round = 0; round < kRounds; ++round) {
    glm::dvec2 low(0.0);
    glm::dvec2 high(0.0);
    VisibilityMap(input, target + distance * input.toCamera, halfEdge).extent(low, high);
    if (low.x > high.x) {
      return std::nullopt;
    }
    const glm::dvec2 middle = 0.5 * (low + high);
    const double extent = std::max(high.x - low.x, high.y - low.y);
    target += distance * (middle.x * basis.right + middle.y * basis.up);
    distance *= extent / (2.0 * halfShort * kFramedShare);
    halfEdge = halfShort; // the subject now takes most of it
  }
  Camera camera;
  camera.target = target;
  camera.position = target + distance * input.toCamera;
  camera.verticalFov = glm::degrees(2.0 * std::atan(halfShort * std::max(1.0, 1.0 / aspect)));
  return camera;
}

} // namespace tyndall::scene

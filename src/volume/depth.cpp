// SPDX-License-Identifier: Apache-2.0
#include "volume/depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tyndall::volume {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A ray in index space; positions are origin + t * direction with the t of the world ray.
struct IndexRay {
  glm::dvec3 origin;
  glm::dvec3 direction;
  glm::dvec3 at(double t) const { return origin + t * direction; }
};

/// Narrows [tMin, tMax] to the part inside `box`; empty (tMin >= tMax) if there is none.
void clipToBox(const IndexRay& ray, const Bounds3& box, double& tMin, double& tMax) {
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis];
    const double d = ray.direction[axis];
    if (d == 0.0) {
      if (o < box.min[axis] || o > box.max[axis]) {
        tMax = tMin;
      }
      continue;
    }
    const double t0 = (box.min[axis] - o) / d;
    const double t1 = (box.max[axis] - o) / d;
    tMin = std::max(tMin, std::min(t0, t1));
    tMax = std::min(tMax, std::max(t0, t1));
  }
}

/// The t at which a ray crosses the integer planes of one axis, in ascending order.
class PlaneCrossings {
public:
  PlaneCrossings(double origin, double direction, double tStart) : origin_(origin), direction_(direction) {
    if (direction_ != 0.0) {
      const double start = origin_ + tStart * direction_;
      plane_ = direction_ > 0.0 ? std::floor(start) + 1.0 : std::ceil(start) - 1.0;
    }
  }
  /// From the plane's number every time: nothing accumulates.
  double next() const { return direction_ == 0.0 ? kInfinity : (plane_ - origin_) / direction_; }
  void advance() { plane_ += direction_ > 0.0 ? 1.0 : -1.0; }

private:
  double origin_;
  double direction_;
  double plane_ = 0.0;
};

/// Trilinear interpolation inside one cell, from its eight voxels. Independent of BrickGrid::value on purpose.
class Cell {
public:
  Cell(const BrickGrid& grid, const glm::ivec3& corner) : corner_(corner) {
    for (int i = 0; i < 8; ++i) {
      values_[std::size_t(i)] = double(grid.voxel(corner + glm::ivec3(i & 1, (i >> 1) & 1, i >> 2)));
    }
  }
  bool zero() const {
    return std::all_of(values_.begin(), values_.end(), [](double v) { return v == 0.0; });
  }
  double at(const glm::dvec3& index) const {
    const glm::dvec3 f = glm::clamp(index - glm::dvec3(corner_), 0.0, 1.0);
    const auto lerp = [](double a, double b, double s) { return a + s * (b - a); };
    const double y0z0 = lerp(values_[0], values_[1], f.x);
    const double y1z0 = lerp(values_[2], values_[3], f.x);
    const double y0z1 = lerp(values_[4], values_[5], f.x);
    const double y1z1 = lerp(values_[6], values_[7], f.x);
    return lerp(lerp(y0z0, y1z0, f.y), lerp(y0z1, y1z1, f.y), f.z);
  }

private:
  glm::ivec3 corner_;
  std::array<double, 8> values_{};
};

double integralOverCell(const BrickGrid& grid, const IndexRay& ray, double t0, double t1) {
  // The middle tells the cell without doubt; on a shared face either neighbour gives the same values.
  const double middle = 0.5 * (t0 + t1);
  const Cell cell(grid, glm::ivec3(glm::floor(ray.at(middle))));
  if (cell.zero()) {
    return 0.0;
  }
  const double half = 0.5 * (t1 - t0);
  const double node = half / std::sqrt(3.0); // Gauss-Legendre, two points
  return half * (cell.at(ray.at(middle - node)) + cell.at(ray.at(middle + node)));
}

/// Point `i` of the R2 sequence in [0, 1)^2 (Roberts 2018): low discrepancy and the same for ever.
glm::dvec2 r2Point(unsigned i) {
  return glm::fract(glm::dvec2(0.5) + double(i + 1) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
}

} // namespace

double exactOpticalDepth(const BrickGrid& grid, const glm::dvec3& worldOrigin, const glm::dvec3& worldDirection,
                         double tMin, double tMax) {
  if (grid.empty()) {
    return 0.0;
  }
  const glm::dmat4 indexFromWorld = glm::inverse(grid.worldFromIndex);
  const IndexRay ray{glm::dvec3(indexFromWorld * glm::dvec4(worldOrigin, 1.0)),
                     glm::dvec3(indexFromWorld * glm::dvec4(worldDirection, 0.0))};
  clipToBox(ray, grid.indexBounds(), tMin, tMax);
  if (!(tMin < tMax) || !std::isfinite(tMin) || !std::isfinite(tMax)) {
    return 0.0;
  }
  std::array<PlaneCrossings, 3> planes{PlaneCrossings(ray.origin.x, ray.direction.x, tMin),
                                       PlaneCrossings(ray.origin.y, ray.direction.y, tMin),
                                       PlaneCrossings(ray.origin.z, ray.direction.z, tMin)};
  double sum = 0.0;
  double t = tMin;
  while (t < tMax) {
    PlaneCrossings* nearest = &planes[0];
    for (PlaneCrossings& candidate : planes) {
      nearest = candidate.next() < nearest->next() ? &candidate : nearest;
    }
    const double end = std::min(nearest->next(), tMax);
    if (end > t) {
      sum += integralOverCell(grid, ray, t, end);
      t = end;
    }
    nearest->advance();
  }
  return sum * glm::length(worldDirection);
}

double medianOpticalDepth(const BrickGrid& grid, unsigned lines) {
  static constexpr std::array kDirections{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),  glm::dvec3(0, 0, 1),
                                          glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, 1), glm::dvec3(1, -1, 1),
                                          glm::dvec3(1, 1, -1)};
  const Bounds3 bounds = grid.worldBounds();
  if (bounds.empty()) {
    return 0.0;
  }
  const double radius = 0.5 * glm::length(bounds.size());
  std::vector<double> depths;
  for (unsigned i = 0; i < lines; ++i) {
    const glm::dvec3 direction = glm::normalize(kDirections[i % kDirections.size()]);
    const glm::dvec3 helper = std::abs(direction.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(direction, helper));
    const glm::dvec2 offset = radius * (2.0 * r2Point(i / unsigned(kDirections.size())) - 1.0);
    const glm::dvec3 origin = bounds.centre() + offset.x * across + offset.y * glm::cross(direction, across);
    const double depth = exactOpticalDepth(grid, origin, direction, -2.0 * radius, 2.0 * radius);
    if (depth > 0.0) {
      depths.push_back(depth);
    }
  }
  if (depths.empty()) {
    return 0.0;
  }
  const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

} // namespace tyndall::volume

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verify/oracle_radiance.h"
#include "volume/brick_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

/// Exact walks through grids in double, fast enough for millions of rays.
namespace tyndall::test {

using namespace verify;

inline glm::dvec3 pointAt(const OracleRay& ray, double t) { return ray.origin + t * ray.direction; }

/// The part of [0, tMax] inside a box, x >= y if there is none.
inline glm::dvec2 spanInBox(const OracleRay& ray, const Bounds3& box, double tMax) {
  glm::dvec2 span(0.0, tMax);
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis];
    const double d = ray.direction[axis];
    if (d != 0.0) {
      const auto [low, high] = std::minmax({(box.min[axis] - o) / d, (box.max[axis] - o) / d});
      span = {std::max(span.x, low), std::min(span.y, high)};
    } else if (o < box.min[axis] || o > box.max[axis]) {
      return glm::dvec2(0.0);
    }
  }
  return span;
}

/// Calls visit(cell, t0, t1) for the cells of `edge` voxels in [low, high) that a line crosses for t in `span`, in
/// order, until it returns false. A crossing's t comes from the number of its plane, so that nothing accumulates;
/// each step moves to the next plane of some axis, so that the walk ends even where a step's length rounds to 0.
template <class Visit>
void walkCells(const OracleRay& line, const glm::ivec3& low, const glm::ivec3& high, int edge, const glm::dvec2& span,
               const Visit& visit) {
  const glm::ivec3 ahead(glm::greaterThan(line.direction, glm::dvec3(0.0)));
  const glm::dvec3 inverse = 1.0 / line.direction;
  glm::ivec3 cell;
  glm::dvec3 next(std::numeric_limits<double>::infinity());
  const auto crossing = [&](int axis) {
    return (edge * (cell[axis] + ahead[axis]) - line.origin[axis]) * inverse[axis];
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double d = line.direction[axis];
    const double place = (line.origin[axis] + span.x * d) / edge;
    // A start on a plane belongs to the cell that the line goes into. Rounding may put it just outside the box.
    const double first = d < 0.0 ? std::ceil(place) - 1.0 : std::floor(place);
    cell[axis] = int(std::clamp(first, double(low[axis]), double(high[axis] - 1)));
    if (d != 0.0) {
      next[axis] = crossing(axis);
    }
  }
  double t = span.x;
  while (t < span.y) {
    const int axis = next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
    const double end = std::min(next[axis], span.y);
    if (end > t) {
      if (!visit(cell, t, end)) {
        return;
      }
      t = end;
    }
    cell[axis] += 2 * ahead[axis] - 1;
    if (cell[axis] < low[axis] || cell[axis] >= high[axis]) {
      return;
    }
    next[axis] = crossing(axis);
  }
}

/// A grid decoded once for many walks; docs/conventions.md has the field. Reads the voxels alone: wrong ranges of the
/// grid cannot spoil it.
class DecodedGrid {
public:
  explicit DecodedGrid(const volume::BrickGrid& grid);

  /// In index coordinates, whole numbers; empty for an empty grid.
  const Bounds3& bounds() const { return bounds_; }
  /// Integral of the density over t in [0, tMax] along a ray in index coordinates, its direction of any length but 0.
  /// Exact up to rounding. Stops early once the sum passes `enough`.
  double depth(const OracleRay& index, double tMax, double enough = std::numeric_limits<double>::infinity()) const;
  /// The eight voxels around the cell [cell, cell + 1] for `densityIn`; null where the brick is zero all over.
  const float* corners(const glm::ivec3& cell) const;
  /// Trilinear value at a fraction of the cell, in [0, 1] up to rounding.
  static double densityIn(const float* corners, const glm::dvec3& f) {
    const auto along = [&](const float* v) { return double(v[0]) + f.x * (double(v[1]) - double(v[0])); };
    const auto face = [&](const float* v) { return along(v) + f.y * (along(v + kEdge) - along(v)); };
    return face(corners) + f.z * (face(corners + kEdge * kEdge) - face(corners));
  }
  static constexpr int kEdge = volume::kBrickEdge + 1; ///< of a brick's support

private:
  const float* support(const glm::ivec3& brick) const;

  Bounds3 bounds_;
  glm::ivec3 firstBrick_{0};
  glm::ivec3 brickCount_{0};
  std::vector<int> supports_; ///< per brick, x fastest: which 9^3 values; -1: zero all over
  std::vector<float> values_; ///< voxels 8b to 8b + 8 of each brick, x fastest
};

/// Optical depth of each ray over t in [0, tMax[i]] (all of it without `tMax`) at a density scale of 1 per unit of t.
/// @param rayFromIndex from the grid's index coordinates to the space of the rays: `grid.worldFromIndex` for rays in
/// the volume's world, a translation by -firstVoxel for those in the device's voxel space.
/// @throws Error if `tMax` has another size than `rays`.
std::vector<double> opticalDepths(const volume::BrickGrid& grid, const glm::dmat4& rayFromIndex,
                                  std::span<const OracleRay> rays, std::span<const double> tMax = {});

/// The same ray in another space, its t unchanged.
OracleRay through(const glm::dmat4& map, const OracleRay& ray);

/// Integral over t in [t0, t1] inside one cell; `inCell` is the ray in index coordinates relative to the cell.
double cellDepth(const float* corners, const OracleRay& inCell, double t0, double t1);

} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
#include "render/light_cache_lattice.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tyndall::render {
namespace {

constexpr int kMostAcrossOctahedron = 512;

using Target = LightCacheTarget;

double depthAlong(const Target& target, int axis, double sign, const glm::dvec3& point) {
  return sign * (point[axis] - target.light[axis]);
}

/// Columns across the planes of one axis: node (0, 0, 0), how columns lean, how far apart they are.
struct Columns {
  int axis = 0;
  double sign = 1.0;      ///< the way the light travels along `axis`
  glm::dvec3 first{0.0};  ///< node (0, 0, 0)
  glm::dvec2 slope{0.0};  ///< of column (0, 0): across per unit along the axis
  double slopeStep = 0.0; ///< from column to column; 0 for a sun
  double gap = 1.0;       ///< voxels between the columns at j = 0
  glm::dvec2 extent{0.0}; ///< voxels to cover across the first plane
};

int acrossA(int axis) { return (axis + 1) % 3; }
int acrossB(int axis) { return (axis + 2) % 3; }
glm::dvec3 axisVector(int axis) {
  glm::dvec3 vector(0.0);
  vector[axis] = 1.0;
  return vector;
}

/// Nodes that cover `extent`; at least 2. What rounding adds to the extent asks for no further node.
int nodesFor(double extent, double gap) { return std::max(static_cast<int>(std::ceil(extent / gap - 1e-6)) + 1, 2); }

/// The way the light travels is the z of the columns, `axis` its largest part.
Columns sunColumns(const Target& target, double spacing) {
  Columns columns;
  const glm::dvec3 way = -target.light;
  const glm::dvec3 size = glm::abs(way);
  columns.axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  columns.sign = way[columns.axis] < 0.0 ? -1.0 : 1.0;
  columns.gap = spacing;
  const double length = target.bounds.size()[columns.axis];
  columns.first[columns.axis] = columns.sign > 0.0 ? target.bounds.min[columns.axis] : target.bounds.max[columns.axis];
  for (int i = 0; i < 2; ++i) {
    const int axis = i == 0 ? acrossA(columns.axis) : acrossB(columns.axis);
    columns.slope[i] = way[axis] / size[columns.axis];
    // Columns start at integers of the first plane: along an axis they then pass through the voxels.
    const double lean = columns.slope[i] * length;
    columns.first[axis] = std::floor(target.bounds.min[axis] - std::max(lean, 0.0));
    columns.extent[i] = target.bounds.max[axis] + std::max(-lean, 0.0) - columns.first[axis];
  }
  return columns;
}

/// A pencil from a light beyond a face of the bounds across `axis`; none if it is not.
std::optional<Columns> pencilColumns(const Target& target, int axis, double spacing) {
  Columns columns;
  columns.axis = axis;
  columns.sign = target.light[axis] < target.bounds.min[axis] ? 1.0 : -1.0;
  const double nearFace = columns.sign > 0.0 ? target.bounds.min[axis] : target.bounds.max[axis];
  glm::dvec3 onFace(0.0);
  onFace[axis] = nearFace;
  const double nearDepth = depthAlong(target, axis, columns.sign, onFace);
  const double meanDepth = depthAlong(target, axis, columns.sign, target.bounds.centre());
  if (nearDepth < 1.0) {
    return std::nullopt;
  }
  columns.slopeStep = spacing / meanDepth;
  columns.gap = columns.slopeStep * nearDepth;
  columns.first[axis] = nearFace;
  for (int i = 0; i < 2; ++i) {
    const int across = i == 0 ? acrossA(axis) : acrossB(axis);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 point = target.bounds.corner(corner);
      const double slope = (point[across] - target.light[across]) / depthAlong(target, axis, columns.sign, point);
      low = std::min(low, slope);
      high = std::max(high, slope);
    }
    columns.slope[i] = low;
    columns.first[across] = target.light[across] + low * nearDepth;
    columns.extent[i] = (high - low) * nearDepth;
  }
  return columns;
}

interop::LightCache projectiveHeader(const Target& target, const Columns& columns, double spacing) {
  const glm::dvec3 along = columns.sign * axisVector(columns.axis);
  const std::array across{axisVector(acrossA(columns.axis)), axisVector(acrossB(columns.axis))};
  interop::LightCache header{};
  header.kind = interop::kCacheProjective;
  header.count = {nodesFor(columns.extent[0], columns.gap), nodesFor(columns.extent[1], columns.gap),
                  nodesFor(target.bounds.size()[columns.axis], spacing)};
  header.origin0 = columns.first;
  header.originA = columns.gap * across[0];
  header.originB = columns.gap * across[1];
  header.step0 = spacing * (along + columns.slope[0] * across[0] + columns.slope[1] * across[1]);
  header.stepA = spacing * columns.slopeStep * across[0];
  header.stepB = spacing * columns.slopeStep * across[1];
  // At the depth h below the first plane columns are gap + slopeStep h apart; in units of the spacing that is w, of
  // the order of 1. Each row is an affine function of the point, so its constant term is its value at 0.
  const glm::dvec3 toFirst = -columns.first;
  glm::dmat4 rows(0.0);
  for (int i = 0; i < 2; ++i) {
    const glm::dvec3 gradient = (across[i] - columns.slope[i] * along) / spacing;
    rows[i] = glm::dvec4(gradient, glm::dot(gradient, toFirst));
  }
  rows[2] = glm::dvec4(along / spacing, glm::dot(along, toFirst) / spacing);
  const glm::dvec3 widening = columns.slopeStep * along / spacing;
  rows[3] = glm::dvec4(widening, columns.gap / spacing + glm::dot(widening, toFirst));
  header.latticeFromVoxel = glm::mat4(glm::transpose(rows));
  return header;
}

/// Mean over the bounds of the distance to the light: midpoints of 4^3 parts.
double meanDistance(const Target& target) {
  double sum = 0.0;
  for (int i = 0; i < 64; ++i) {
    const glm::dvec3 part = (glm::dvec3(i % 4, i / 4 % 4, i / 16) + 0.5) / 4.0;
    sum += glm::length(target.bounds.min + part * target.bounds.size() - target.light);
  }
  return sum / 64.0;
}

/// As many nodes across the octahedron as squares of one spacing on the sphere at the grid's mean distance.
double nodesAcrossOctahedron(const Target& target, double spacing) {
  return std::sqrt(4.0 * glm::pi<double>()) * meanDistance(target) / spacing;
}

interop::LightCache octahedralHeader(const Target& target, double spacing) {
  const glm::dvec3 nearest = glm::clamp(target.light, target.bounds.min, target.bounds.max);
  double farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    farthest = std::max(farthest, glm::length(target.bounds.corner(corner) - target.light));
  }
  interop::LightCache header{};
  header.kind = interop::kCacheOctahedral;
  header.origin0 = target.light;
  header.firstRadius = static_cast<float>(glm::length(nearest - target.light));
  header.radiusStep = static_cast<float>(spacing);
  // Odd, so that the folds pass through nodes.
  const double across = std::clamp(nodesAcrossOctahedron(target, spacing), 8.0, double(kMostAcrossOctahedron - 2));
  const int half = static_cast<int>(std::ceil(across / 2.0));
  header.count = {2 * half + 1, 2 * half + 1, nodesFor(farthest - double(header.firstRadius), spacing)};
  return header;
}

double nodesOf(const interop::LightCache& header) {
  return double(header.count.x) * double(header.count.y) * double(header.count.z);
}

} // namespace

interop::LightCache lightCacheLattice(const LightCacheTarget& target, double spacing) {
  if (target.distant) {
    return projectiveHeader(target, sunColumns(target, spacing), spacing);
  }
  interop::LightCache best = octahedralHeader(target, spacing);
  // What it would take without the limit across: a pencil is not to lose to a coarser table.
  const double across = std::max(nodesAcrossOctahedron(target, spacing), double(best.count.x));
  double leastNodes = across * across * double(best.count.z);
  for (int axis = 0; axis < 3; ++axis) {
    const bool outside = target.light[axis] < target.bounds.min[axis] || target.light[axis] > target.bounds.max[axis];
    const std::optional<Columns> columns = outside ? pencilColumns(target, axis, spacing) : std::nullopt;
    if (columns) {
      const interop::LightCache pencil = projectiveHeader(target, *columns, spacing);
      best = nodesOf(pencil) < leastNodes ? pencil : best;
      leastNodes = std::min(leastNodes, nodesOf(pencil));
    }
  }
  return best;
}

glm::dvec3 octahedralDirection(const glm::dvec2& place) {
  const double z = 1.0 - std::abs(place.x) - std::abs(place.y);
  const glm::dvec2 sign(place.x >= 0.0 ? 1.0 : -1.0, place.y >= 0.0 ? 1.0 : -1.0);
  const glm::dvec2 xy = z >= 0.0 ? place : (1.0 - glm::abs(glm::dvec2(place.y, place.x))) * sign;
  return glm::normalize(glm::dvec3(xy, z));
}

} // namespace tyndall::render

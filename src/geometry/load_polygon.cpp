// SPDX-License-Identifier: Apache-2.0
#include "geometry/load_parts.h"

#include <cmath>
#include <numeric>

namespace tyndall::geometry {
namespace {

constexpr std::size_t kMostCorners = 4096;
constexpr std::uint64_t kMostTests = 2'000'000'000; // over a file: seconds

/// Twice the signed area of the triangle a b c.
double doubledArea(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Newell's vector area: twice the area, along the normal, also where the corners lie in no plane.
glm::dvec3 doubledVectorArea(std::span<const glm::dvec3> corners) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sum += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  return sum;
}

/// Projects along the largest component of `normal`; counter-clockwise where the polygon is simple.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int first = (axis + 1) % 3;
  const int second = (axis + 2) % 3;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 p = corner - corners[0];
    flat.emplace_back(normal[axis] > 0.0 ? glm::dvec2(p[first], p[second]) : glm::dvec2(p[second], p[first]));
  }
  return flat;
}

void fan(std::size_t count, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    triangles.push_back({0, i, i + 1});
  }
}

/// All corners on one side of each edge, and one turn in all (the fan's triangles do not overlap).
bool fanFits(const std::vector<glm::dvec2>& flat) {
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const glm::dvec2& b = flat[(i + 1) % flat.size()];
    if (doubledArea(flat[i], b, flat[(i + 2) % flat.size()]) <= 0.0) {
      return false;
    }
    if (i + 2 < flat.size() && doubledArea(flat[0], b, flat[i + 2]) < 0.0) {
      return false;
    }
  }
  return true;
}

/// Neither corner of the ear, nor at its place, yet in it or on its border.
bool spoils(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  if (p == a || p == b || p == c) {
    return false;
  }
  return doubledArea(a, b, p) >= 0.0 && doubledArea(b, c, p) >= 0.0 && doubledArea(c, a, p) >= 0.0;
}

/// Whether the ear at place `i` of the ring can be cut off. Flat ears only where `flatToo`.
bool isEar(const std::vector<glm::dvec2>& flat, const std::vector<std::uint32_t>& ring, std::size_t i, bool flatToo) {
  const std::size_t n = ring.size();
  const glm::dvec2& a = flat[ring[(i + n - 1) % n]];
  const glm::dvec2& b = flat[ring[i]];
  const glm::dvec2& c = flat[ring[(i + 1) % n]];
  const double area = doubledArea(a, b, c);
  if (area <= 0.0) {
    return flatToo && area == 0.0;
  }
  for (const std::uint32_t corner : ring) {
    if (spoils(flat[corner], a, b, c)) {
      return false;
    }
  }
  return true;
}

} // namespace

bool PolygonCutter::cut(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  triangles.clear();
  if (corners.size() == 3) {
    triangles.push_back({0, 1, 2});
    return true;
  }
  const glm::dvec3 normal = doubledVectorArea(corners);
  const std::vector<glm::dvec2> flat = flattened(corners, normal);
  if (fanFits(flat)) {
    fan(corners.size(), triangles);
    return true;
  }
  std::vector<std::uint32_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0U);
  std::size_t start = 0;
  bool simple = corners.size() <= kMostCorners && glm::dot(normal, normal) > 0.0;
  while (simple && ring.size() > 3) {
    std::size_t ear = ring.size();
    for (std::size_t step = 0; step < 2 * ring.size() && ear == ring.size(); ++step) {
      const std::size_t i = (start + step) % ring.size();
      tests_ += ring.size();
      ear = isEar(flat, ring, i, step >= ring.size()) ? i : ear;
    }
    simple = ear < ring.size() && tests_ < kMostTests;
    if (simple) {
      const std::size_t n = ring.size();
      triangles.push_back({ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
      start = ear % ring.size(); // the next corner, not the same fan again: rounder triangles
    }
  }
  if (!simple) {
    triangles.clear();
    fan(corners.size(), triangles);
    return false;
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return true;
}

} // namespace tyndall::geometry

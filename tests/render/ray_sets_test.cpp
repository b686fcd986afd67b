// SPDX-License-Identifier: Apache-2.0
// Rays are what their kind says.
#include "base/error.h"
#include "support/ray_reference_grid.h"
#include "support/ray_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kSeed = 7;

int wholeCoordinates(const glm::vec3& p, float step = 1.0f) {
  const glm::vec3 scaled = p / step;
  return int(scaled.x == std::floor(scaled.x)) + int(scaled.y == std::floor(scaled.y)) +
         int(scaled.z == std::floor(scaled.z));
}

/// Components are 0 or exactly 1, 2 or 4 times the least of them, and they are that of a corner to the next.
bool stepsThroughCorners(const glm::vec3& direction) {
  float least = 1.0f;
  for (int axis = 0; axis < 3; ++axis) {
    least = direction[axis] == 0.0f ? least : std::min(least, std::abs(direction[axis]));
  }
  const glm::vec3 n = direction / least;
  return wholeCoordinates(n) == 3 && n * least == direction &&
         glm::all(glm::lessThanEqual(glm::abs(n), glm::vec3(4.0f)));
}

bool grazes(const glm::vec3& origin, const glm::vec3& direction, bool fromPlane) {
  for (int axis = 0; axis < 3; ++axis) {
    const float slope = std::abs(direction[axis]);
    if (slope > 0.99e-7f && slope < 1.01e-3f && (!fromPlane || origin[axis] == std::floor(origin[axis]))) {
      return true;
    }
  }
  return false;
}

/// What a kind of ray promises, of the floats themselves.
bool keepsItsPromise(RayKind kind, const glm::vec3& origin, const glm::vec3& direction, const Bounds3& box) {
  const glm::vec3 size = glm::abs(direction);
  const bool axial = size.x + size.y + size.z == 1.0f;
  const glm::vec3 across = glm::mix(origin, glm::vec3(0.5f), size); // an axial ray's other two coordinates
  const glm::dvec3 p(origin);
  const glm::dvec2 span = spanInBox({p, glm::dvec3(direction)}, box, std::numeric_limits<double>::infinity());
  const bool inside = glm::clamp(p, box.min, box.max) == p;
  const bool onFace = glm::any(glm::equal(p, box.min)) || glm::any(glm::equal(p, box.max));
  const float most = std::max({size.x, size.y, size.z});
  switch (kind) {
  case RayKind::Random:
    return span.x < span.y;
  case RayKind::AxisInsideCells:
    return axial && wholeCoordinates(across) == 0;
  case RayKind::AxisOnCellPlane:
    return axial && wholeCoordinates(across) >= 1;
  case RayKind::AxisOnBrickPlane:
    return axial && wholeCoordinates(across, 8.0f) >= 1;
  case RayKind::AxisOnEdge:
    return axial && wholeCoordinates(across) == 2;
  case RayKind::GrazingFromPlane:
    return grazes(origin, direction, true);
  case RayKind::GrazingInside:
    return grazes(origin, direction, false) && glm::clamp(p, box.min - 0.01, box.max + 0.01) == p;
  case RayKind::ThroughCorners:
    return wholeCoordinates(origin) == 3 && stepsThroughCorners(direction);
  case RayKind::ThroughEdges:
    return wholeCoordinates(origin) == 2 && stepsThroughCorners(direction);
  case RayKind::FromCellPlane:
    return inside && wholeCoordinates(origin) >= 1;
  case RayKind::FromBrickFace:
    return inside && wholeCoordinates(origin, 8.0f) >= 1;
  case RayKind::FromBounds:
    return inside && onFace;
  case RayKind::FromInside:
    return inside;
  case RayKind::Missing:
    return !(span.x < span.y);
  case RayKind::Diagonal:
    return wholeCoordinates(direction / most) == 3 && !axial;
  case RayKind::Far:
    return span.x < span.y && glm::distance(p, box.centre()) > 300.0 - glm::length(box.size());
  }
  return false;
}

TEST(RaySets, KeepTheirPromises) {
  const Bounds3 box{glm::dvec3(-6.0, 2.0, -18.0), {25.0, 24.0, 9.0}};
  for (const RayKind kind : kRayKinds) {
    SCOPED_TRACE(rayKindName(kind));
    const RaySet set = rays(kind, 1000, kSeed, box);
    const RaySet other =
        rays(kind == RayKind::Random ? RayKind::Missing : RayKind::Random, 1000, kSeed, box); // planted
    std::size_t kept = 0;
    std::size_t keptByOthers = 0;
    double error = 0.0;
    for (std::size_t i = 0; i < 1000; ++i) {
      kept += keepsItsPromise(kind, set.origins[i], set.directions[i], box) ? 1 : 0;
      keptByOthers += keepsItsPromise(kind, other.origins[i], other.directions[i], box) ? 1 : 0;
      error = std::max({error, std::abs(glm::length(glm::dvec3(set.directions[i])) - 1.0),
                        glm::distance(set.exact[i].origin, glm::dvec3(set.origins[i])),
                        glm::distance(set.exact[i].direction, glm::dvec3(set.directions[i]))});
    }
    EXPECT_EQ(kept, 1000u);
    EXPECT_LT(keptByOthers, 300u);
    EXPECT_LT(error, 1.2e-7);
    EXPECT_EQ(set.origins, rays(kind, 1000, kSeed, box).origins);
    EXPECT_NE(set.origins, rays(kind, 1000, kSeed + 1, box).origins);
  }
  EXPECT_THROW(rays(RayKind::Random, 1, kSeed, {glm::dvec3(0.5), glm::dvec3(9.0)}), Error);
}

} // namespace
} // namespace tyndall::test

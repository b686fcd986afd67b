// SPDX-License-Identifier: Apache-2.0
#include "support/ray_sets.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::test {
namespace {

struct Line {
  glm::dvec3 origin;
  glm::dvec3 direction; ///< of any length
};

/// Draws the ingredients of rays at one box.
class Sampler {
public:
  Sampler(std::uint32_t seed, RayKind kind, const Bounds3& box)
      : box_(box), reach_(glm::length(box.size())), random_(seed * 64u + std::uint32_t(kind)) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  /// Whole number in [low, high].
  int whole(double low, double high) { return std::uniform_int_distribution<int>(int(low), int(high))(random_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  int axis() { return whole(0, 2); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

  glm::dvec3 inside() {
    return {uniform(box_.min.x, box_.max.x), uniform(box_.min.y, box_.max.y), uniform(box_.min.z, box_.max.z)};
  }
  glm::dvec3 direction() {
    const double z = uniform(-1.0, 1.0);
    const double phi = uniform(0.0, 2.0 * std::numbers::pi);
    return {std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z};
  }
  /// On a plane of the box or in it; a multiple of `step` where there is one.
  double plane(int axis, int step = 1) {
    const int low = int(std::ceil(box_.min[axis] / step));
    const int high = int(std::floor(box_.max[axis] / step));
    return low <= high ? step * whole(low, high) : whole(box_.min[axis], box_.max[axis]);
  }
  glm::dvec3 corner() { return {plane(0), plane(1), plane(2)}; }
  double face(int axis) { return chance(0.5) ? box_.min[axis] : box_.max[axis]; }
  double centre(int axis) const { return box_.centre()[axis]; }
  /// 1e-3 to 1e-7, either sign.
  double slope() {
    const double size = std::pow(10.0, uniform(-7.0, -3.0));
    return sign() * size;
  }
  /// 1, 2 or 4, either sign, or 0.
  double smallWhole() {
    const double size = chance(0.2) ? 0.0 : double(1 << whole(0, 2));
    return sign() * size;
  }
  double reach() const { return reach_; }
  double width(int axis) const { return box_.size()[axis]; }

private:
  Bounds3 box_;
  double reach_;
  std::mt19937 random_;
};

Line towardsTheBox(Sampler& s, double nearest, double farthest) {
  const glm::dvec3 target = s.inside();
  const glm::dvec3 direction = s.direction();
  return {target - s.uniform(nearest, farthest) * direction, direction};
}

/// Along an axis from outside, or from inside the box one time in four; `planes` of the two other coordinates, both
/// within the box, are multiples of `step`.
Line alongAxis(Sampler& s, int planes, int step) {
  const int axis = s.axis();
  const int first = (axis + s.whole(1, 2)) % 3;
  Line line{s.inside(), glm::dvec3(0.0)};
  line.direction[axis] = s.sign();
  if (s.chance(0.75)) {
    line.origin[axis] = s.centre(axis) - line.direction[axis] * (0.5 * s.width(axis) + s.whole(0, 20) * 0.25);
  }
  if (planes > 0) {
    line.origin[first] = s.plane(first, step);
  }
  if (planes > 1) {
    line.origin[3 - axis - first] = s.plane(3 - axis - first, step);
  }
  return line;
}

/// One or two components of 1e-3 to 1e-7 beside larger ones.
Line grazing(Sampler& s, bool fromPlane) {
  const int axis = s.axis();
  const double phi = s.uniform(0.0, 2.0 * std::numbers::pi);
  const bool two = s.chance(0.3);
  Line line{s.inside(), glm::dvec3(0.0)};
  line.direction[axis] = s.slope();
  line.direction[(axis + 1) % 3] = two ? s.slope() : std::sin(phi);
  line.direction[(axis + 2) % 3] = two ? s.sign() : std::cos(phi);
  if (fromPlane) {
    line.origin[axis] = s.plane(axis);
  } else if (s.chance(0.5)) {
    line.origin[axis] = s.plane(axis);
    line.origin[axis] += 10.0 * s.slope();
  }
  return line;
}

/// A vector of whole numbers whose direction has floats that are exact multiples of each other.
glm::dvec3 wholeDirection(Sampler& s, int least) {
  glm::dvec3 direction(0.0);
  while (glm::dot(glm::abs(glm::sign(direction)), glm::dvec3(1.0)) < least) {
    for (int axis = 0; axis < 3; ++axis) {
      direction[axis] = s.smallWhole();
    }
  }
  return direction;
}

/// Meets a corner, or an edge at any place, and another one each time that t grows by the length of `step`.
Line throughLattice(Sampler& s, bool corners) {
  Line line{s.corner(), wholeDirection(s, corners ? 2 : 1)};
  line.origin -= double(s.whole(0, s.reach())) * line.direction;
  if (!corners) {
    line.origin[s.axis()] += s.whole(1, 63) / 64.0;
  }
  return line;
}

/// Starts with one coordinate, or one time in three any of them, from `place(axis)`.
template <class Place>
Line fromPlace(Sampler& s, const Place& place) {
  Line line{s.inside(), s.direction()};
  const int axis = s.axis();
  const bool more = s.chance(1.0 / 3.0);
  for (int i = 0; i < 3; ++i) {
    if (i == axis || (more && s.chance(0.6))) {
      line.origin[i] = place(i);
    }
  }
  return line;
}

Line diagonal(Sampler& s) {
  Line line{s.chance(0.5) ? s.corner() : s.inside(), {s.sign(), s.sign(), s.sign()}};
  if (s.chance(0.5)) {
    line.direction[s.axis()] = 0.0;
  }
  if (s.chance(0.5)) {
    line.origin -= double(s.whole(0, s.reach())) * line.direction;
  }
  return line;
}

/// From beyond one face of the box and not towards it.
Line missing(Sampler& s) {
  const int axis = s.axis();
  const double side = s.sign();
  Line line{s.inside(), s.direction()};
  line.origin[axis] = s.centre(axis) + side * (0.5 * s.width(axis) + s.uniform(0.001, 2.0) * s.reach());
  line.direction[axis] = s.chance(0.2) ? 0.0 : side * std::abs(line.direction[axis]);
  return line;
}

Line draw(Sampler& s, RayKind kind) {
  switch (kind) {
  case RayKind::Random:
    return towardsTheBox(s, 0.1 * s.reach(), 2.0 * s.reach());
  case RayKind::AxisInsideCells:
    return alongAxis(s, 0, 1);
  case RayKind::AxisOnCellPlane:
    return alongAxis(s, 1, 1);
  case RayKind::AxisOnBrickPlane:
    return alongAxis(s, s.whole(1, 2), 8);
  case RayKind::AxisOnEdge:
    return alongAxis(s, 2, 1);
  case RayKind::GrazingFromPlane:
    return grazing(s, true);
  case RayKind::GrazingInside:
    return grazing(s, false);
  case RayKind::ThroughCorners:
    return throughLattice(s, true);
  case RayKind::ThroughEdges:
    return throughLattice(s, false);
  case RayKind::FromCellPlane:
    return fromPlace(s, [&](int axis) { return s.plane(axis); });
  case RayKind::FromBrickFace:
    return fromPlace(s, [&](int axis) { return s.plane(axis, 8); });
  case RayKind::FromBounds:
    return fromPlace(s, [&](int axis) { return s.face(axis); });
  case RayKind::FromInside:
    return {s.inside(), s.direction()};
  case RayKind::Missing:
    return missing(s);
  case RayKind::Diagonal:
    return diagonal(s);
  case RayKind::Far:
    return towardsTheBox(s, 300.0, 10000.0);
  }
  return {};
}

bool isSound(const Bounds3& box) {
  const glm::dvec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
  return box.min == glm::floor(box.min) && box.max == glm::floor(box.max) &&
         glm::all(glm::greaterThanEqual(box.size(), glm::dvec3(2.0))) &&
         glm::all(glm::lessThan(farthest, glm::dvec3(1e6)));
}

} // namespace

const char* rayKindName(RayKind kind) {
  switch (kind) {
  case RayKind::Random:
    return "random";
  case RayKind::AxisInsideCells:
    return "axis inside cells";
  case RayKind::AxisOnCellPlane:
    return "axis on cell plane";
  case RayKind::AxisOnBrickPlane:
    return "axis on brick plane";
  case RayKind::AxisOnEdge:
    return "axis on edge";
  case RayKind::GrazingFromPlane:
    return "grazing from plane";
  case RayKind::GrazingInside:
    return "grazing inside";
  case RayKind::ThroughCorners:
    return "through corners";
  case RayKind::ThroughEdges:
    return "through edges";
  case RayKind::FromCellPlane:
    return "from cell plane";
  case RayKind::FromBrickFace:
    return "from brick face";
  case RayKind::FromBounds:
    return "from bounds";
  case RayKind::FromInside:
    return "from inside";
  case RayKind::Missing:
    return "missing";
  case RayKind::Diagonal:
    return "diagonal";
  case RayKind::Far:
    return "far";
  }
  return "unknown";
}

RaySet rays(RayKind kind, std::size_t count, std::uint32_t seed, const Bounds3& box) {
  if (!isSound(box)) {
    fail("rays: the box [{} {} {}] to [{} {} {}] must have whole coordinates below 1e6 and 2 voxels per axis; give a "
         "grid's "
         "indexBounds()",
         box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
  }
  Sampler sampler(seed, kind, box);
  RaySet set;
  set.kind = kind;
  for (std::size_t i = 0; i < count; ++i) {
    const Line line = draw(sampler, kind);
    // One factor for all axes: components that were 1, 2 and 4 times another stay so exactly.
    const glm::vec3 direction(glm::normalize(line.direction));
    set.origins.push_back(glm::vec3(line.origin));
    set.directions.push_back(direction);
    set.exact.push_back({glm::dvec3(set.origins.back()), glm::normalize(glm::dvec3(direction))});
  }
  return set;
}

} // namespace tyndall::test

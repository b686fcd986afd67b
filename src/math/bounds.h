// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <limits>

namespace tyndall {

/// Axis-aligned box in double. Default-constructed it is empty (min > max).
struct Bounds3 {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  glm::dvec3 centre() const { return 0.5 * (min + max); }
  glm::dvec3 size() const { return max - min; }
  void extend(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void extend(const Bounds3& other) {
    if (!other.empty()) {
      extend(other.min);
      extend(other.max);
    }
  }
  /// Corner `i` in [0, 8): bit 0 selects x, bit 1 y, bit 2 z.
  glm::dvec3 corner(int i) const {
    return {(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z};
  }
};

/// The box around `bounds` seen through the affine map `targetFromSource`.
inline Bounds3 transformed(const glm::dmat4& targetFromSource, const Bounds3& bounds) {
  Bounds3 result;
  for (int i = 0; !bounds.empty() && i < 8; ++i) {
    result.extend(glm::dvec3(targetFromSource * glm::dvec4(bounds.corner(i), 1.0)));
  }
  return result;
}

} // namespace tyndall

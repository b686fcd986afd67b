// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tyndall::test {

/// A density over directions that depends on the polar angle alone [1/sr]. Takes 1 - cos and 1 + cos: near either
/// pole one of them has digits that the cosine has lost.
using PolarDensity = std::function<double(double oneMinusCos, double onePlusCos)>;

/// 1 - cos and 1 + cos between the axis and w, by differences of the vectors.
glm::dvec2 polarPlace(const glm::dvec3& axis, const glm::dvec3& w);

/// Bins over the sphere about an axis: polar rings of equal probability under a density, however narrow its peaks,
/// each cut into `sectors` of azimuth.
class SphereBins {
public:
  SphereBins(const PolarDensity& density, int rings, int sectors);

  /// P-value of chi-squared of directions about `axis`.
  double pValue(const glm::dvec3& axis, std::span<const glm::dvec3> directions) const;
  /// The density's integral over the sphere.
  double integral() const { return integral_; }

private:
  int sectors_;
  double integral_ = 0.0;
  std::vector<double> ringEdges_;         ///< ascending in polarCoordinate()
  std::vector<double> ringProbabilities_;
};

/// Directions and solid-angle weights of a fine quadrature over the sphere about `axis`, logarithmic towards both
/// poles: integrates peaks of any width at either.
struct SphereQuadrature {
  std::vector<glm::vec3> directions;
  std::vector<double> weights;            ///< [sr], sum 4 pi
};
SphereQuadrature sphereQuadrature(const glm::dvec3& axis);

} // namespace tyndall::test

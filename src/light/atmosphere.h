// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace tyndall::light {

/// A clear atmosphere over a spherical earth: air and haze with exponential profiles, and the ozone layer.
/// Lengths in kilometres from the earth's centre, coefficients per kilometre for red, green and blue (680, 550 and
/// 440 nm), `mu` = cosine of the zenith angle.
class Atmosphere {
public:
  static constexpr double kGroundRadius = 6360.0;
  static constexpr double kTopRadius = 6460.0;

  /// Local coefficients: Rayleigh and haze scattering, and the sum of all extinction.
  struct Coefficients {
    glm::dvec3 rayleigh;
    glm::dvec3 haze;
    glm::dvec3 extinction;
  };

  /// Nodes of a quadrature along a ray: distances, weights and optical depth from the start to each.
  struct Node {
    double distance;
    double weight;
    Coefficients medium;
    glm::dvec3 opticalDepth;
  };

  /// @param turbidity >= 1: optical depth of air and haze over that of air alone, at 550 nm towards the zenith.
  explicit Atmosphere(double turbidity);

  Coefficients at(double radius) const;

  /// Distance to the top for a ray from inside.
  static double distanceToTop(double radius, double mu);
  /// Whether a ray meets the ground, and where.
  static bool hitsGround(double radius, double mu, double& distance);

  /// Nodes over [0, length], denser near the start where a ray near the ground meets most of its matter.
  /// @param segments >= 1, of 4 Gauss points each. `total` is the optical depth of the whole.
  std::vector<Node> march(double radius, double mu, double length, int segments, glm::dvec3& total) const;

  /// Optical depth to the top, from a table; for rays that miss the ground.
  glm::dvec3 opticalDepthToTop(double radius, double mu) const;

  /// Sunlight that reaches a point, the part of the sun's disc above the horizon included.
  glm::dvec3 sunTransmittance(double radius, double muSun) const;

private:
  glm::dvec3 hazeScattering_{0.0};
  glm::uvec2 tableSize_{0};
  std::vector<glm::dvec3> table_; ///< mu fastest, both coordinates as tableCoordinates()

  static glm::dvec2 tableCoordinates(double radius, double mu);
  void fillTable();
};

} // namespace tyndall::light

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/sky_spectrum.h"

#include <glm/glm.hpp>

#include <vector>

namespace tyndall::light {

/// A clear atmosphere over a spherical earth: air and haze with exponential profiles, and the ozone layer.
/// Lengths in kilometres from the earth's centre, coefficients per kilometre, `mu` = cosine of the zenith angle.
/// Densities are (air, haze, ozone), relative to sea level for the first two and to the layer's peak for ozone;
/// columns are densities integrated along a path [km].
class Atmosphere {
public:
  static constexpr double kGroundRadius = 6360.0;
  static constexpr double kTopRadius = 6460.0;

  /// Nodes of a quadrature along a ray: distances, weights, and columns from the start to each.
  struct Node {
    double distance;
    double weight;
    glm::dvec3 density;
    glm::dvec3 column;
  };

  /// How sunlight comes to a point: the part of the sun's disc above the horizon, 0 to 1, and what lies in its way.
  struct SunPath {
    double visible = 0.0;
    glm::dvec3 column{0.0};
  };

  /// @param turbidity >= 1: optical depth of air and haze over that of air alone, at 550 nm towards the zenith.
  explicit Atmosphere(double turbidity);

  static glm::dvec3 densityAt(double radius);
  const SkySpectrum& airScattering() const { return airScattering_; }   ///< at density 1
  const SkySpectrum& hazeScattering() const { return hazeScattering_; } ///< at density 1
  SkySpectrum extinction(const glm::dvec3& density) const;
  SkySpectrum transmittance(const glm::dvec3& column) const;

  /// Distance to the top for a ray from inside.
  static double distanceToTop(double radius, double mu);
  /// Whether a ray meets the ground, and where.
  static bool hitsGround(double radius, double mu, double& distance);

  /// Nodes over [0, length], denser near the start, the more so for a rising ray, which leaves the matter behind.
  /// @param segments >= 1, of 4 Gauss points each. `total` is the column of the whole.
  static std::vector<Node> march(double radius, double mu, double length, int segments, glm::dvec3& total);

  /// Column to the top, from a table; for rays that miss the ground.
  glm::dvec3 columnToTop(double radius, double mu) const;

  SunPath sunPath(double radius, double muSun) const;
  /// Fraction of the sun's irradiance that reaches a point.
  SkySpectrum sunTransmittance(double radius, double muSun) const;

private:
  SkySpectrum airScattering_;
  SkySpectrum hazeScattering_;
  SkySpectrum hazeExtinction_;
  SkySpectrum ozoneAbsorption_;
  glm::uvec2 tableSize_{0};
  std::vector<glm::dvec3> table_; ///< columns, mu fastest, both coordinates as tableCoordinates()

  static glm::dvec2 tableCoordinates(double radius, double mu);
  void fillTable();
};

} // namespace tyndall::light

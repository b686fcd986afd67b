// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verify/test_scene.h"

#include <functional>

/// Light from spheres by quadrature in double: A3 of docs/theory.md.
namespace tyndall::verify {

/// Where a ray meets a sphere; first >= last: it misses.
struct Chord {
  double first = 0.0;
  double last = 0.0;
};
/// @param toCentre from the ray's origin. @param direction unit.
Chord chordOf(const glm::dvec3& toCentre, double radius, const glm::dvec3& direction);

/// Integral over the cone of directions that meet a sphere from outside.
double overSphere(const glm::dvec3& toCentre, double radius, const std::function<double(const glm::dvec3&)>& function);

/// A camera at the origin that looks along +z at fog from z = 0 to `depth`; a ball in it shines. One event.
struct BallInFog {
  glm::dvec3 centre{1.2, 0.3, 3.0};
  double radius = 0.6;
  double depth = 8.0;
  double sigmaT = 0.3;
  double albedo = 0.9;
  double g = 0.5;

  /// The fog alone, on 8 x 8 pixels that all see the axis.
  PathScene fog() const;
  /// The same with a sphere of radiance 5 as the ball, and what the axis carries.
  PathScene withLamp() const;
  double lampRadiance() const;
  /// In-scattering along the axis. @param light radiance that arrives from a direction, given the chord through the
  /// ball.
  double airlight(const std::function<double(const Chord&)>& light) const;
};

} // namespace tyndall::verify

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/light_tree_scenes.h"

#include <string>
#include <vector>

/// Emitters seen from points, with what is known of them in closed form.
namespace tyndall::test {

/// An emitter and a point that sees all of its front.
struct View {
  std::string name;
  interop::Emitter emitter;
  glm::vec3 point;
  double tolerance = 2e-6; ///< relative, of distances and densities
};

/// Near, across, far, grazing and from behind a two-sided one.
std::vector<View> triangles();
/// From outside: at ordinary distance, almost at the surface, far, small.
std::vector<View> spheres();

/// Solid angle of the emitter [sr]. A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983, equation 8.
double triangleSolidAngle(const View& view);
double sphereSolidAngle(const View& view);

/// Irradiance per radiance on a plane through the point, all of the triangle above it. Lambert's formula.
double lambertIrradiance(const View& view, const glm::dvec3& normal);

} // namespace tyndall::test

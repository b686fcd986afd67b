// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/bvh.h"

#include <string>
#include <vector>

namespace tyndall::bench {

/// Opaque triangles, a camera that looks along -z, and a light above them.
struct RayScene {
  std::string name;
  std::vector<geometry::BvhInput> triangles;
  glm::vec3 camera{0.0f};
  float tangent = 0.4f;     ///< of half the field of view
  glm::vec3 lightMin{0.0f}; ///< corners of a horizontal rectangle
  glm::vec3 lightMax{0.0f};
};

/// A box open in front, two blocks and a light: 36 triangles.
RayScene boxScene();
/// Twelve bumpy spheres of 2 `rings`^2 triangles above a ground of two.
RayScene bumpySpheres(int rings);

} // namespace tyndall::bench

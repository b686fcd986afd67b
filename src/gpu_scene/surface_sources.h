// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/meshes.h"

#include <vector>

/// An object's triangles, whether from a file or made from its numbers.
namespace tyndall::gpu_scene {

struct ObjectSource {
  struct Part {
    std::uint32_t mesh = 0;
    glm::dmat4 objectFromMesh{1.0};
  };
  const geometry::Model* model = nullptr; ///< of a file
  std::vector<geometry::Mesh> made;       ///< of a quad or box
  std::vector<Part> parts;
  bool insideOut = false; ///< it encloses a negative volume

  const geometry::Mesh& mesh(std::uint32_t index) const {
    return model != nullptr ? model->meshes[index] : made[index];
  }
  std::size_t usesOf(std::uint32_t mesh) const;
};

ObjectSource objectSource(const scene::Object& object, const MeshSet& meshes, std::size_t index);

/// How a ray from `origin` in a fixed direction crosses a triangle: 1 from behind its front, -1 from its front, 0 not.
int crossing(const glm::dvec3& origin, const glm::dvec3 (&corners)[3]);

} // namespace tyndall::gpu_scene

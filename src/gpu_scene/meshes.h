// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/model.h"
#include "scene/scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::gpu_scene {

/// The mesh files that a scene's objects name, each loaded once.
struct MeshSet {
  std::vector<geometry::Model> models;
  std::vector<std::optional<std::size_t>> uses; ///< one per object of the scene: index into models
  std::vector<std::string> notes;               ///< sentences for the user: "file: ..."
};

/// @throws Error if a file cannot be read or holds nothing to draw.
MeshSet loadMeshes(const scene::Scene& scene);

/// Adds to the scene the punctual lights that its mesh files hold, but for objects that leave them out.
void addModelLights(scene::Scene& scene, const MeshSet& meshes);

/// Where copies of something stand: its own place after each of the instances'.
std::vector<glm::dmat4> placements(const glm::dmat4& worldFromOwn, const std::vector<glm::dmat4>& instances);

/// Bounds of object `index` in its own space.
Bounds3 localBounds(const scene::Object& object, const MeshSet& meshes, std::size_t index);

/// World bounds of all objects.
Bounds3 objectBounds(const scene::Scene& scene, const MeshSet& meshes);

} // namespace tyndall::gpu_scene

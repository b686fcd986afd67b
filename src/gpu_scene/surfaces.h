// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/bvh.h"
#include "gpu_scene/motion.h"
#include "interop/emitters.h"
#include "interop/surfaces.h"

#include <string>
#include <vector>

namespace tyndall::gpu_scene {

/// The scene's objects as device structs but for addresses, relative to `centre`. A pure function of its arguments.
/// Meshes that are used more than once become instances where that saves memory; all others, and emissive ones, are
/// laid out in the world.
struct PackedSurfaces {
  geometry::Bvh bvh;
  std::vector<interop::Triangle> triangles;
  std::vector<interop::Vertex> vertices;
  std::vector<interop::Sphere> spheres;
  std::vector<interop::Instance> instances;
  std::vector<interop::Material> materials;
  std::vector<const geometry::Texture*> textures; ///< into the MeshSet
  std::vector<interop::Interior> interiors;
  std::vector<interop::Motion> motions;
  std::vector<interop::Emitter> emitters; ///< emissive triangles and spheres
  std::vector<float> emitterScales;       ///< mean of the emission texture, one per emitter
  std::uint32_t cameraInteriors = 0;      ///< bits of the interiors that the camera stands in
  std::uint32_t materialMask = 0;         ///< bit = MaterialId
  bool passing = false;                   ///< null boundaries, holes, or refracting objects that may overlap
  bool textured = false;
  std::vector<std::string> notes;
};

/// @param mediumIndex per medium of the scene: its index among the device's media (interop::kNoMedium: none).
/// @param previous the frame before, for motion; nullptr: there is none.
PackedSurfaces packSurfaces(const scene::Scene& scene, const MeshSet& meshes,
                            const std::vector<std::uint32_t>& mediumIndex, const glm::dvec3& centre,
                            const Pose* previous = nullptr);

} // namespace tyndall::gpu_scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/emitters.h"
#include "gpu_scene/surfaces.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tyndall::app {

/// What a scene's surfaces and its lights with a place come to on the device.
struct SurfaceCounts {
  std::size_t triangles = 0; ///< kept ones; of a mesh that is instanced once
  std::size_t spheres = 0;
  std::size_t instances = 0;  ///< of meshes; small or shining ones are laid out in the world instead
  std::size_t primitives = 0; ///< leaves of the trees: triangles, spheres, instances
  std::size_t nodes = 0;
  std::size_t materials = 0;
  std::size_t textures = 0;
  std::size_t interiors = 0; ///< objects that are filled or refract
  std::size_t emitters = 0;  ///< shining triangles and spheres, points, spots, shining media
  std::size_t lightTreeNodes = 0;
  double bytes = 0.0; ///< of all of it in device memory
};

SurfaceCounts countSurfaces(const gpu_scene::PackedSurfaces& surfaces, const gpu_scene::PackedEmitters& emitters);

/// One line: "12 triangles, 1 sphere, 2 emitters, 3.4 kB"; counts of 0 are left out.
std::string toText(const SurfaceCounts& counts);
nlohmann::ordered_json toJson(const SurfaceCounts& counts);

} // namespace tyndall::app

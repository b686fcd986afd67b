// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/meshes.h"
#include "scene/scene.h"
#include "volume/brick_grid.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::gpu_scene {

/// What the files hold that a scene names, each loaded once: the grids of its media, the meshes of its objects.
struct VolumeSet {
  struct Use {
    std::optional<std::size_t> density; ///< index into grids
    std::optional<std::size_t> emission;
  };
  std::vector<volume::BrickGrid> grids;
  std::vector<Use> uses; ///< one per medium of the scene
  MeshSet meshes;
  std::vector<std::string> notes; ///< sentences for the user: "file: grid: ..."

  double deviceBytes() const;
};

/// Reads what the scene names and nothing else. Where the grids do not fit into `memoryBudget` bytes, those whose
/// storage is "auto" are narrowed (half, then unorm8) and a note says so.
/// @throws Error if a file or grid is bad, or if they still do not fit, with the sizes and what to do.
VolumeSet loadVolumes(const scene::Scene& scene, double memoryBudget);

} // namespace tyndall::gpu_scene

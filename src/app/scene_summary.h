// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/surface_counts.h"
#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

namespace tyndall::app {

struct SceneFile {
  std::string path;         ///< as the scene has it; a pattern for a sequence
  std::string use;          ///< "medium \"cloud\"", ...
  std::uintmax_t bytes = 0; ///< of a sequence: its first frame
  std::size_t frames = 1;
};

struct PlannedGrid {
  std::string name;
  std::string storage;
  double bytes = 0.0;
  Bounds3 worldBounds; ///< in the file's own world
};

/// What `tyndall info SCENE.json` tells.
struct SceneSummary {
  scene::Scene scene;
  std::vector<SceneFile> files;
  std::vector<PlannedGrid> grids; ///< each once, however many media use it
  double deviceBytes = 0.0;       ///< of the grids as tracking reads them
  double cellBytes = 0.0;         ///< of the grids as the march reads them, light caches aside
  SurfaceCounts surfaces;         ///< as paths read them
  double filmBytes = 0.0;         ///< of the film's sums in the host's memory
  std::vector<std::string> notes;
};

/// Reads the volumes and meshes that the scene names; of a sequence its first frame. @throws Error if one of them is
/// bad.
SceneSummary summariseScene(const scene::Scene& scene);

std::string toText(const SceneSummary& summary);
nlohmann::ordered_json toJson(const SceneSummary& summary);

} // namespace tyndall::app

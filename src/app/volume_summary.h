// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/load.h"

#include <nlohmann/json_fwd.hpp>

namespace tyndall::app {

/// A grid as a bare render would hold it on the device.
struct GridPlan {
  std::string grid;
  volume::Storage storage = volume::Storage::Float; ///< what "auto" takes
  double deviceBytes = 0.0;
  double denseBytes = 0.0;        ///< of the active box at that storage without bricks
  double quantisationError = 0.0; ///< worst voxel, relative to the maximum
  std::vector<std::string> notes; ///< of loading: conversions, values that were mended
};

/// What `tyndall info FILE.vdb` tells.
struct VolumeSummary {
  volume::FileInfo file;
  std::string choice;              ///< the grids a bare render takes, and why
  std::string nothing;             ///< why there is nothing to render; empty if there is something
  std::vector<GridPlan> plans;     ///< density first, then emission
  double densityScale = 0.0;       ///< that a bare render takes; 0 without a density
  double medianOpticalDepth = 0.0; ///< through the volume at a density scale of 1
  std::vector<std::string> notes;  ///< of a bare render: scales it takes, and how to override them
};

/// Reads the file once for the description and once more for the grids of a bare render.
/// @throws Error if the file cannot be read as a VDB.
VolumeSummary summariseVolume(const std::filesystem::path& path);

std::string toText(const VolumeSummary& summary);
nlohmann::ordered_json toJson(const VolumeSummary& summary);

} // namespace tyndall::app

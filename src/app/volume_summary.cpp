// SPDX-License-Identifier: Apache-2.0
#include "app/volume_summary.h"

#include "app/quantities.h"
#include "base/error.h"
#include "scene/auto_scene.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace tyndall::app {
namespace {

using volume::BrickGrid;
using volume::GridInfo;

double denseBytes(const BrickGrid& grid) {
  const glm::dvec3 voxels = glm::dvec3(grid.indexMax) - glm::dvec3(grid.indexMin) + 1.0;
  return grid.empty() ? 0.0 : voxels.x * voxels.y * voxels.z * double(volume::bytesPerVoxel(grid.storage));
}

GridPlan planOf(const BrickGrid& grid, const std::string& name) {
  return {.grid = name,
          .storage = grid.storage,
          .deviceBytes = grid.deviceBytes(),
          .denseBytes = denseBytes(grid),
          .quantisationError = grid.report.quantisationError,
          .notes = grid.report.notes};
}

/// The grid, or nothing if it is not wanted or has no active voxel.
std::optional<BrickGrid> loadWanted(const volume::FileInfo& file, const std::string& name, bool signedValues) {
  const auto found =
      std::find_if(file.grids.begin(), file.grids.end(), [&](const GridInfo& grid) { return grid.name == name; });
  if (name.empty() || found == file.grids.end() || found->empty()) {
    return std::nullopt;
  }
  volume::LoadOptions options;
  options.grid = name;
  options.signedValues = signedValues;
  return volume::loadGrid(file.path, options);
}

/// Fills in what a bare render would do.
void planRender(VolumeSummary& summary) {
  const volume::GridChoice choice = volume::chooseGrids(summary.file);
  summary.choice = choice.reason;
  const std::optional<BrickGrid> density = loadWanted(summary.file, choice.density, false);
  const std::optional<BrickGrid> temperature = loadWanted(summary.file, choice.temperature, true);
  if (density) {
    summary.plans.push_back(planOf(*density, choice.density));
  }
  if (temperature) {
    summary.plans.push_back(planOf(*temperature, choice.temperature));
  }
  if (summary.plans.empty()) {
    summary.nothing = "the grids are empty: there is no active voxel in them";
    return;
  }
  scene::AutoInput input;
  input.file = summary.file.path;
  input.grids = choice;
  input.frames = {{density ? &*density : nullptr, temperature ? &*temperature : nullptr}};
  const scene::AutoScene made = scene::makeAutoScene(input);
  summary.notes = made.notes;
  if (made.empty) {
    summary.nothing = "every value is 0";
  }
  if (made.medianOpticalDepth > 0.0) {
    summary.densityScale = made.scene.media.front().densityScale;
    summary.medianOpticalDepth = made.medianOpticalDepth / summary.densityScale;
  }
}

Bounds3 worldBounds(const GridInfo& grid) {
  return transformed(grid.worldFromIndex, {glm::dvec3(grid.indexMin) - 0.5, glm::dvec3(grid.indexMax) + 0.5});
}

template <class Vector>
std::string inWords(const Vector& v) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", double(v.x), double(v.y), double(v.z));
}

std::string gridText(const GridInfo& grid) {
  std::string text = fmt::format("\ngrid \"{}\"\n", grid.name);
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", name, value);
  };
  line("type", fmt::format("{}, {}{}", grid.type, grid.gridClass, grid.scalar ? "" : " (cannot be rendered)"));
  if (!grid.whyNot.empty()) {
    line("", grid.whyNot);
  }
  line("transform", grid.transform);
  line("voxel size", inWords(grid.voxelSize));
  if (!grid.empty()) {
    const glm::ivec3 count = grid.indexMax - grid.indexMin + 1;
    line("index bounds", fmt::format("{} to {}, {} x {} x {} voxels", inWords(grid.indexMin), inWords(grid.indexMax),
                                     count.x, count.y, count.z));
    const Bounds3 world = worldBounds(grid);
    line("world bounds", fmt::format("{} to {}", inWords(world.min), inWords(world.max)));
  }
  line("active",
       fmt::format("{} voxels, {} tiles, {} leaf bricks", grid.activeVoxels, grid.activeTiles, grid.leafBricks));
  if (grid.scalar) {
    line("values", fmt::format("{:.6g} to {:.6g}, background {:.6g}", grid.minValue, grid.maxValue, grid.background));
  }
  for (const std::string& warning : grid.warnings) {
    line("warning", warning);
  }
  return text;
}

std::string planText(const GridPlan& plan) {
  std::string text =
      fmt::format("  {:<18}\"{}\" as {}: {}, {:.0f} % of the dense box ({}); worst voxel error {:.2g} of the maximum\n",
                  "on the device", plan.grid, volume::storageName(plan.storage), inBytes(plan.deviceBytes),
                  100.0 * plan.deviceBytes / plan.denseBytes, inBytes(plan.denseBytes), plan.quantisationError);
  for (const std::string& note : plan.notes) {
    text += fmt::format("  {:<18}\"{}\": {}\n", "note", plan.grid, note);
  }
  return text;
}

nlohmann::ordered_json toJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json toJson(const GridInfo& grid) {
  nlohmann::ordered_json json{{"name", grid.name},
                              {"type", grid.type},
                              {"class", grid.gridClass},
                              {"transform", grid.transform},
                              {"voxel_size", toJson(grid.voxelSize)}};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      json["world_from_index"].push_back(grid.worldFromIndex[column][row]);
    }
  }
  if (!grid.empty()) {
    const Bounds3 world = worldBounds(grid);
    json["index_bounds"] = {toJson(glm::dvec3(grid.indexMin)), toJson(glm::dvec3(grid.indexMax))};
    json["world_bounds"] = {toJson(world.min), toJson(world.max)};
  }
  json["active_voxels"] = grid.activeVoxels;
  json["active_tiles"] = grid.activeTiles;
  json["leaf_bricks"] = grid.leafBricks;
  json["can_be_rendered"] = grid.scalar;
  if (grid.scalar) {
    json["value_range"] = {grid.minValue, grid.maxValue};
    json["background"] = grid.background;
  } else {
    json["why_not"] = grid.whyNot;
  }
  json["warnings"] = grid.warnings;
  return json;
}

} // namespace

VolumeSummary summariseVolume(const std::filesystem::path& path) {
  VolumeSummary summary;
  summary.file = volume::inspectFile(path);
  try {
    planRender(summary);
  } catch (const Error& reason) {
    summary.nothing = reason.what();
  }
  return summary;
}

std::string toText(const VolumeSummary& summary) {
  std::string text =
      fmt::format("{}: OpenVDB {}, {} grid(s)\n", summary.file.path, summary.file.version, summary.file.grids.size());
  for (const GridInfo& grid : summary.file.grids) {
    text += gridText(grid);
  }
  text += "\na bare render\n";
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", name, value);
  };
  if (!summary.choice.empty()) {
    line("takes", summary.choice);
  }
  for (const GridPlan& plan : summary.plans) {
    text += planText(plan);
  }
  if (summary.densityScale > 0.0) {
    line("optical depth", fmt::format("median {:.4g} at density scale 1", summary.medianOpticalDepth));
  }
  for (const std::string& note : summary.notes) {
    line("note", note);
  }
  if (!summary.nothing.empty()) {
    line("nothing to render", summary.nothing);
  }
  return text;
}

nlohmann::ordered_json toJson(const VolumeSummary& summary) {
  nlohmann::ordered_json json{{"file", summary.file.path},
                              {"kind", "volume"},
                              {"format", summary.file.version},
                              {"metadata", summary.file.metadata},
                              {"grids", nlohmann::ordered_json::array()}};
  for (const GridInfo& grid : summary.file.grids) {
    json["grids"].push_back(toJson(grid));
  }
  nlohmann::ordered_json bare{{"choice", summary.choice},
                              {"nothing_to_render", summary.nothing},
                              {"density_scale", summary.densityScale},
                              {"median_optical_depth", summary.medianOpticalDepth},
                              {"notes", summary.notes},
                              {"grids", nlohmann::ordered_json::array()}};
  for (const GridPlan& plan : summary.plans) {
    bare["grids"].push_back({{"name", plan.grid},
                             {"storage", volume::storageName(plan.storage)},
                             {"device_bytes", plan.deviceBytes},
                             {"dense_bytes", plan.denseBytes},
                             {"quantisation_error", plan.quantisationError},
                             {"notes", plan.notes}});
  }
  json["bare_render"] = std::move(bare);
  return json;
}

} // namespace tyndall::app

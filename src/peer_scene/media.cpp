// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "peer_scene/parts.h"
#include "scene/field_names.h"
#include "volume/grid_write.h"

#include <set>

namespace tyndall::peer_scene {
namespace fs = std::filesystem;
namespace {

Json phaseOf(const scene::Phase& phase) {
  for (const scene::PhaseName& known : scene::kPhases) {
    if (known.id != phase.id) {
      continue;
    }
    Json json{{"type", known.name}};
    scene::forEachParameter(
        known.parameters, [&](std::string_view name, std::size_t i) { json[std::string(name)] = phase.parameters[i]; });
    return json;
  }
  fail("a phase function has no name");
}

Json shapeOf(const scene::Medium& medium, const glm::dmat4& worldFromMedium) {
  Json json{{"type", scene::nameOf(scene::kShapeTypes, medium.shape)}};
  if (medium.shape == scene::MediumShape::Box) {
    json["min"] = inJson(medium.box.min);
    json["max"] = inJson(medium.box.max);
  }
  if (medium.shape == scene::MediumShape::Sphere) {
    json["centre"] = inJson(medium.centre);
    json["radius"] = medium.radius;
  }
  if (medium.shape == scene::MediumShape::Box || medium.shape == scene::MediumShape::Sphere) {
    json["world_from_medium"] = inJson(worldFromMedium);
  }
  return json;
}

/// Writes a grid's voxels; `name` is that of its .vdb, which has the place of one medium, `values` that of the array.
Json gridShape(const volume::BrickGrid& grid, const glm::dmat4& worldFromMedium, const std::string& values,
               const std::string& name) {
  const glm::ivec3 size = grid.indexMax - grid.indexMin + 1;
  return {{"type", "grid"},
          {"values", values},
          {"vdb", name},
          {"size", {size.x, size.y, size.z}},
          {"index_min", {grid.indexMin.x, grid.indexMin.y, grid.indexMin.z}},
          {"maximum", grid.maximum()},
          {"world_from_index", inJson(worldFromMedium * grid.worldFromIndex)}};
}

class MediaWriter {
public:
  MediaWriter(const gpu_scene::VolumeSet& volumes, const fs::path& folder, WrittenMedia& out)
      : volumes_(volumes), folder_(folder), out_(out) {}

  void add(const scene::Medium& medium, const gpu_scene::VolumeSet::Use& use) {
    if (medium.emission) {
      fail("medium \"{}\": what glows (\"emission\") cannot be exported", medium.name);
    }
    const bool grid = !medium.homogeneous();
    if (grid && (!use.density || volumes_.grids[*use.density].empty())) {
      return;
    }
    out_.indexOf[medium.name] = out_.list.size();
    for (const glm::dmat4& place : gpu_scene::placements(medium.worldFromMedium, medium.instances)) {
      const double sigmaT = grid ? medium.densityScale : medium.sigmaT;
      out_.list.push_back({{"name", medium.name},
                           {"sigma_t", inJson(sigmaT * medium.extinctionColour)},
                           {"albedo", inJson(medium.albedo)},
                           {"phase", phaseOf(medium.phase)},
                           {"shape", grid ? writeGrid(*use.density, place) : shapeOf(medium, place)}});
    }
  }

private:
  Json writeGrid(std::size_t index, const glm::dmat4& place) {
    const volume::BrickGrid& grid = volumes_.grids[index];
    const std::string values = fmt::format("grid_{}.f32", index);
    const std::string name = fmt::format("medium_{}.vdb", out_.list.size());
    if (written_.insert(index).second) {
      volume::writeDense(folder_ / values, grid);
    }
    volume::writeGrid(folder_ / name, grid, place * grid.worldFromIndex);
    return gridShape(grid, place, values, name);
  }

  const gpu_scene::VolumeSet& volumes_;
  const fs::path& folder_;
  WrittenMedia& out_;
  std::set<std::size_t> written_;
};

} // namespace

WrittenMedia writeMedia(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, const fs::path& folder) {
  WrittenMedia media;
  MediaWriter writer(volumes, folder, media);
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    writer.add(scene.media[i], volumes.uses[i]);
  }
  return media;
}

} // namespace tyndall::peer_scene

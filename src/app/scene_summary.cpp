// SPDX-License-Identifier: Apache-2.0
#include "app/scene_summary.h"

#include "app/frames.h"
#include "app/quantities.h"
#include "film/film.h"
#include "gpu_scene/cell_grids.h"
#include "gpu_scene/volumes.h"
#include "scene/fields.h"
#include "scene/load.h"
#include "volume/sequence.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>

namespace tyndall::app {
namespace {

namespace fs = std::filesystem;

std::string inWords(const glm::dvec3& v) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z); }

/// `medium "cloud"`, or `medium 0` for one without a name.
std::string label(const char* kind, const std::string& name, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} \"{}\"", kind, name);
}

SceneFile fileOf(const std::string& path, const std::string& use) {
  const bool sequence = volume::isSequence(path) && !fs::exists(path);
  return {path, use, fs::file_size(firstFile(path)), sequence ? framesPresent(path).size() : 1};
}

std::vector<SceneFile> filesOf(const scene::Scene& scene) {
  std::vector<SceneFile> files;
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    if (!scene.media[i].homogeneous()) {
      files.push_back(fileOf(scene.media[i].file, label("medium", scene.media[i].name, i)));
    }
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (const auto* map = std::get_if<scene::MapEnvironment>(&scene.lights[i].light)) {
      files.push_back(fileOf(map->file, label("light", scene.lights[i].name, i)));
    }
  }
  return files;
}

std::string phaseText(const scene::Phase& phase) {
  for (const scene::PhaseName& known : scene::kPhases) {
    if (known.id == phase.id) {
      const auto count =
          known.parameters.empty() ? 0 : 1 + std::count(known.parameters.begin(), known.parameters.end(), ' ');
      std::string text(known.name);
      for (std::size_t i = 0; i < std::size_t(count); ++i) {
        text += fmt::format("{}{:g}", i == 0 ? " " : ", ", phase.parameters[i]);
      }
      return text;
    }
  }
  return "unknown";
}

std::string shapeText(const scene::Medium& medium) {
  switch (medium.shape) {
  case scene::MediumShape::Unbounded:
    return "everywhere";
  case scene::MediumShape::Box:
    return fmt::format("in the box {} to {}", inWords(medium.box.min), inWords(medium.box.max));
  case scene::MediumShape::Sphere:
    return fmt::format("in the ball of radius {:g} about {}", medium.radius, inWords(medium.centre));
  }
  return "";
}

std::string mediumText(const scene::Medium& medium) {
  std::string text =
      medium.homogeneous()
          ? fmt::format("homogeneous, extinction {:g}, {}", medium.sigmaT, shapeText(medium))
          : fmt::format("{}, grid {}, density scale {:g}", medium.file,
                        medium.grid.empty() ? "chosen automatically" : "\"" + medium.grid + "\"", medium.densityScale);
  text += fmt::format(", albedo {}, {}", inWords(medium.albedo), phaseText(medium.phase));
  if (medium.emission) {
    text += medium.emission->kind == scene::Emission::Kind::Blackbody ? ", glows as a blackbody" : ", glows";
    text += medium.emission->grid.empty() ? "" : fmt::format(" by grid \"{}\"", medium.emission->grid);
  }
  return text;
}

struct LightText {
  std::string operator()(const scene::PointLight& l) const {
    return fmt::format("point at {}, intensity {} W/sr", inWords(l.position), inWords(l.intensity));
  }
  std::string operator()(const scene::SunLight& l) const {
    return fmt::format("sun towards {}, irradiance {} W/m2, {:g} degrees wide", inWords(l.direction),
                       inWords(l.irradiance), l.angularDiameter);
  }
  std::string operator()(const scene::ConstantEnvironment& l) const {
    return fmt::format("constant, radiance {} W/(m2 sr)", inWords(l.radiance));
  }
  std::string operator()(const scene::MapEnvironment& l) const {
    return fmt::format("map {}, scale {:g}, rotated by {:g} degrees", l.file, l.scale, l.rotation);
  }
  std::string operator()(const scene::SkyEnvironment& l) const {
    return fmt::format("sky, sun's light towards {}, turbidity {:g}, scale {:g}", inWords(l.sunDirection), l.turbidity,
                       l.scale);
  }
};

std::string cameraText(const scene::Camera& camera) {
  const std::string lens = camera.kind == scene::Camera::Kind::Perspective
                               ? fmt::format("perspective, {:g} degrees high", camera.verticalFov)
                               : fmt::format("orthographic, {:g} scene units high", camera.height);
  return fmt::format("{}, at {} towards {}", lens, inWords(camera.position), inWords(camera.target));
}

} // namespace

SceneSummary summariseScene(const scene::Scene& scene) {
  SceneSummary summary;
  summary.scene = scene;
  summary.files = filesOf(scene);
  scene::Scene firstFrame = scene;
  for (scene::Medium& medium : firstFrame.media) {
    medium.file = medium.homogeneous() ? "" : firstFile(medium.file).string();
  }
  const gpu_scene::VolumeSet volumes = gpu_scene::loadVolumes(firstFrame, std::numeric_limits<double>::infinity());
  for (const volume::BrickGrid& grid : volumes.grids) {
    summary.grids.push_back({grid.name, volume::storageName(grid.storage), grid.deviceBytes(), grid.worldBounds()});
  }
  summary.deviceBytes = volumes.deviceBytes();
  const gpu_scene::PackedMedia media =
      gpu_scene::packMedia(firstFrame, volumes, gpu_scene::sceneBounds(firstFrame, volumes).centre());
  summary.cellBytes = gpu_scene::plannedCellBytes(media, volumes);
  summary.filmBytes = double(scene.film.size.x) * scene.film.size.y * sizeof(film::PixelState);
  summary.notes = volumes.notes;
  return summary;
}

std::string toText(const SceneSummary& summary) {
  const scene::Scene& scene = summary.scene;
  std::string text = fmt::format("scene \"{}\"\n", scene.name);
  const auto line = [&](const std::string& name, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", name, value);
  };
  line("camera", cameraText(scene.camera));
  line("film", fmt::format("{} x {} pixels, exposure {:+g} stops{}", scene.film.size.x, scene.film.size.y,
                           scene.film.exposure, scene.film.transparent ? ", transparent" : ""));
  line("render", fmt::format("{} samples per pixel, seed {}, depth {}", scene.render.samples, scene.render.seed,
                             scene.render.depth));
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    line(label("medium", scene.media[i].name, i), mediumText(scene.media[i]));
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    line(label("light", scene.lights[i].name, i),
         std::visit(LightText{}, scene.lights[i].light) + (scene.lights[i].visible ? "" : ", not seen by the camera"));
  }
  for (const SceneFile& file : summary.files) {
    line("file", fmt::format("{} ({}{}), for {}", file.path, inBytes(double(file.bytes)),
                             file.frames > 1 ? fmt::format(" the first of {} frames", file.frames) : "", file.use));
  }
  for (const PlannedGrid& grid : summary.grids) {
    line("grid", fmt::format("\"{}\": {} as {}, world bounds {} to {}", grid.name, inBytes(grid.bytes), grid.storage,
                             inWords(grid.worldBounds.min), inWords(grid.worldBounds.max)));
  }
  for (const std::string& note : summary.notes) {
    line("note", note);
  }
  line("memory", fmt::format("{} for grids on the device ({} with --estimator tracking) beside light caches, {} for "
                             "the film on the host",
                             inBytes(summary.cellBytes), inBytes(summary.deviceBytes), inBytes(summary.filmBytes)));
  return text;
}

nlohmann::ordered_json toJson(const SceneSummary& summary) {
  nlohmann::ordered_json json{{"kind", "scene"},
                              {"scene", nlohmann::ordered_json::parse(scene::toJson(summary.scene))},
                              {"files", nlohmann::ordered_json::array()},
                              {"grids", nlohmann::ordered_json::array()}};
  for (const SceneFile& file : summary.files) {
    json["files"].push_back({{"path", file.path}, {"use", file.use}, {"bytes", file.bytes}, {"frames", file.frames}});
  }
  for (const PlannedGrid& grid : summary.grids) {
    json["grids"].push_back({{"name", grid.name}, {"storage", grid.storage}, {"device_bytes", grid.bytes}});
  }
  json["device_bytes"] = summary.deviceBytes;
  json["march_device_bytes"] = summary.cellBytes;
  json["film_bytes"] = summary.filmBytes;
  json["notes"] = summary.notes;
  return json;
}

} // namespace tyndall::app

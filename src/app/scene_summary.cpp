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
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const scene::Object& object = scene.objects[i];
    if (object.kind == scene::Object::Kind::Mesh) {
      files.push_back({object.file, label("object", object.name, i), fs::file_size(object.file), 1});
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
  case scene::MediumShape::Objects:
    return "inside the objects that name it";
  }
  return "";
}

/// ", 3 instances"; nothing for a single one.
std::string copiesText(const std::vector<glm::dmat4>& instances) {
  return instances.empty() ? "" : fmt::format(", {} instance{}", instances.size(), instances.size() == 1 ? "" : "s");
}

std::string mediumText(const scene::Medium& medium) {
  std::string text =
      medium.homogeneous()
          ? fmt::format("homogeneous, extinction {:g}, {}", medium.sigmaT, shapeText(medium))
          : fmt::format("{}, grid {}, density scale {:g}", medium.file,
                        medium.grid.empty() ? "chosen automatically" : "\"" + medium.grid + "\"", medium.densityScale);
  if (medium.extinctionColour != glm::dvec3(1.0)) {
    text += fmt::format(" times {}", inWords(medium.extinctionColour));
  }
  text +=
      fmt::format(", albedo {}, {}{}", inWords(medium.albedo), phaseText(medium.phase), copiesText(medium.instances));
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
  std::string operator()(const scene::SpotLight& l) const {
    return fmt::format("spot at {} towards {}, intensity {} W/sr within {:g} degrees, falling off from {:g}",
                       inWords(l.position), inWords(l.direction), inWords(l.intensity), l.outerAngle, l.innerAngle);
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

std::string materialText(const geometry::Material& material) {
  std::string text(scene::nameOf(scene::kMaterialTypes, material.model));
  if (material.model == MaterialId::Null) {
    return text;
  }
  const bool measured = material.model == MaterialId::Conductor && material.k != glm::dvec3(0.0);
  text += measured ? fmt::format(", eta {}, k {}", inWords(material.eta), inWords(material.k))
                   : fmt::format(", colour {}", inWords(material.colour));
  if (material.model != MaterialId::Diffuse) {
    text += fmt::format(", roughness {:g}", material.roughness);
  }
  if (material.model == MaterialId::MetalRough) {
    text += fmt::format(", metallic {:g}", material.metallic);
  }
  if (material.model == MaterialId::Dielectric || material.model == MaterialId::MetalRough) {
    text += fmt::format(", index of refraction {:g}", material.ior);
  }
  text += material.opacity < 1.0 ? fmt::format(", opacity {:g}", material.opacity) : "";
  if (material.emission != glm::dvec3(0.0)) {
    text +=
        fmt::format(", shines {} W/(m2 sr){}", inWords(material.emission), material.twoSided ? " on both sides" : "");
  }
  return text;
}

std::string geometryText(const scene::Object& object) {
  switch (object.kind) {
  case scene::Object::Kind::Mesh:
    return object.file + (object.lights ? "" : " without its lights");
  case scene::Object::Kind::Quad:
    return fmt::format("quad at {} along {} and {}", inWords(object.origin), inWords(object.edgeU),
                       inWords(object.edgeV));
  case scene::Object::Kind::Box:
    return fmt::format("box {} to {}", inWords(object.box.min), inWords(object.box.max));
  case scene::Object::Kind::Sphere:
    return fmt::format("sphere of radius {:g} about {}", object.radius, inWords(object.centre));
  }
  return "";
}

std::string objectText(const scene::Object& object) {
  const bool own = object.kind == scene::Object::Kind::Mesh;
  std::string text = geometryText(object);
  text += !object.material.empty() ? fmt::format(", material \"{}\"", object.material)
          : own                    ? ", the file's materials"
                                   : ", white diffuse";
  text += object.medium.empty() ? "" : fmt::format(", filled with \"{}\"", object.medium);
  return text + copiesText(object.instances);
}

std::string cameraText(const scene::Camera& camera) {
  const std::string lens = camera.kind == scene::Camera::Kind::Perspective
                               ? fmt::format("perspective, {:g} degrees high", camera.verticalFov)
                               : fmt::format("orthographic, {:g} scene units high", camera.height);
  const std::string focus = camera.lensRadius > 0.0 ? fmt::format(", lens radius {:g}, in focus at {:g}",
                                                                  camera.lensRadius, camera.focusDistance)
                                                    : "";
  return fmt::format("{}{}, at {} towards {}", lens, focus, inWords(camera.position), inWords(camera.target));
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
  gpu_scene::addModelLights(firstFrame, volumes.meshes);
  const Bounds3 bounds = gpu_scene::sceneBounds(firstFrame, volumes);
  const glm::dvec3 centre = bounds.centre();
  gpu_scene::PackedMedia media = gpu_scene::packMedia(firstFrame, volumes, centre);
  summary.cellBytes = gpu_scene::plannedCellBytes(media, volumes);
  const gpu_scene::PackedSurfaces surfaces = gpu_scene::packSurfaces(firstFrame, volumes.meshes, media.indexOf, centre);
  summary.surfaces = countSurfaces(surfaces, gpu_scene::packEmitters(firstFrame, surfaces, media, bounds));
  summary.filmBytes = double(scene.film.size.x) * scene.film.size.y * sizeof(film::PixelState);
  summary.notes = volumes.notes;
  summary.notes.insert(summary.notes.end(), surfaces.notes.begin(), surfaces.notes.end());
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
                             scene.depth() == 0 ? "unlimited" : std::to_string(scene.depth())));
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    line(label("medium", scene.media[i].name, i), mediumText(scene.media[i]));
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    line(label("light", scene.lights[i].name, i),
         std::visit(LightText{}, scene.lights[i].light) + (scene.lights[i].visible ? "" : ", not seen by the camera"));
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    line(label("material", scene.materials[i].name, i), materialText(scene.materials[i]));
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    line(label("object", scene.objects[i].name, i), objectText(scene.objects[i]));
  }
  if (const std::vector<double> frames = scene::keyFrames(scene.animation); !frames.empty()) {
    line("animation", fmt::format("{} tracks, keys from frame {} to {}; told is frame {}",
                                  scene.animation.tracks.size(), frames.front(), frames.back(), scene::kFirstFrame));
  }
  for (const SceneFile& file : summary.files) {
    line("file", fmt::format("{} ({}{}), for {}", file.path, inBytes(double(file.bytes)),
                             file.frames > 1 ? fmt::format(" the first of {} frames", file.frames) : "", file.use));
  }
  for (const PlannedGrid& grid : summary.grids) {
    line("grid", fmt::format("\"{}\": {} as {}, world bounds {} to {}", grid.name, inBytes(grid.bytes), grid.storage,
                             inWords(grid.worldBounds.min), inWords(grid.worldBounds.max)));
  }
  if (!scene.objects.empty()) {
    line("surfaces", toText(summary.surfaces) + " on the device");
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
  json["surfaces"] = toJson(summary.surfaces);
  json["film_bytes"] = summary.filmBytes;
  json["notes"] = summary.notes;
  return json;
}

} // namespace tyndall::app

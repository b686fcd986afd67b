// SPDX-License-Identifier: Apache-2.0
#include "peer_scene/peer_scene.h"

#include "base/error.h"
#include "base/file.h"
#include "peer_scene/parts.h"
#include "scene/camera_frame.h"

#include <fstream>
#include <limits>

namespace tyndall::peer_scene {
namespace fs = std::filesystem;
namespace {

constexpr int kVersion = 1;

Json cameraOf(const scene::Camera& camera) {
  const scene::CameraFrame frame = scene::cameraFrame(camera);
  const bool perspective = camera.kind == scene::Camera::Kind::Perspective;
  Json json{{"type", perspective ? "perspective" : "orthographic"},
            {"position", inJson(camera.position)},
            {"forward", inJson(frame.forward)},
            {"up", inJson(frame.up)}};
  if (perspective) {
    json["vertical_fov"] = camera.verticalFov;
    json["lens_radius"] = camera.lensRadius;
    json["focus_distance"] = camera.focusDistance;
  } else {
    json["height"] = camera.height;
  }
  return json;
}

/// Peers get the voxels of the file, not those of a device's storage.
scene::Scene withExactGrids(scene::Scene scene) {
  for (scene::Medium& medium : scene.media) {
    medium.storage = "float";
  }
  return scene;
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    fail("{}: cannot be made: {}", folder.string(), error.message());
  }
}

} // namespace

void writePeerScene(const scene::Scene& given, const fs::path& folder) {
  scene::Scene scene = withExactGrids(given);
  const gpu_scene::VolumeSet volumes = gpu_scene::loadVolumes(scene, std::numeric_limits<double>::infinity());
  gpu_scene::addModelLights(scene, volumes.meshes);
  makeFolder(folder);
  const WrittenMedia media = writeMedia(scene, volumes, folder);
  Materials materials;
  const Json objects = writeObjects(scene, volumes.meshes, media, materials, folder);
  const Json json{{"format", "tyndall-peer-scene"},
                  {"version", kVersion},
                  {"name", scene.name},
                  {"camera", cameraOf(scene.camera)},
                  {"size", {scene.film.size.x, scene.film.size.y}},
                  {"depth", scene.depth()},
                  {"media", media.list},
                  {"lights", writeLights(scene, folder)},
                  {"materials", materials.list()},
                  {"objects", objects}};
  writeFileAtomically(folder / "scene.json", [&](const fs::path& temporary) {
    std::ofstream stream(temporary);
    // Names in files may be in any encoding; JSON is UTF-8.
    stream << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
    if (!stream.flush()) {
      fail("{}: cannot be written; is the disk full?", (folder / "scene.json").string());
    }
  });
}

} // namespace tyndall::peer_scene

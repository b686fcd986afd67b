// SPDX-License-Identifier: Apache-2.0
#include "scene/file_camera.h"

#include "base/error.h"
#include "geometry/model.h"
#include "scene/check_report.h"

#include <algorithm>

namespace tyndall::scene {
namespace {

/// "\"a\", \"b\"", those without a name left out.
std::string namesOf(const std::vector<geometry::ModelCamera>& cameras) {
  std::string names;
  for (const geometry::ModelCamera& camera : cameras) {
    if (!camera.name.empty()) {
      names += (names.empty() ? "" : ", ") + json::inQuotes(camera.name);
    }
  }
  return names.empty() ? "none with a name" : names;
}

Camera cameraFrom(const geometry::ModelCamera& model) {
  Camera camera;
  const glm::dmat4& world = model.worldFromCamera;
  camera.kind = model.perspective ? Camera::Kind::Perspective : Camera::Kind::Orthographic;
  camera.position = glm::dvec3(world[3]);
  camera.target = camera.position - glm::normalize(glm::dvec3(world[2]));
  camera.up = glm::normalize(glm::dvec3(world[1]));
  camera.verticalFov = model.verticalFov;
  camera.height = model.height;
  return camera;
}

} // namespace

void resolveFileCamera(Camera& camera, double seconds, const json::Value& root, Findings& findings) {
  CheckReport report(root, findings);
  if (camera.kind != Camera::Kind::File || report.errorIn("camera")) {
    return;
  }
  try {
    const std::vector<geometry::ModelCamera> cameras = geometry::loadModel(camera.file, seconds).cameras;
    const auto wanted = std::find_if(cameras.begin(), cameras.end(), [&](const geometry::ModelCamera& candidate) {
      return camera.name.empty() || candidate.name == camera.name;
    });
    if (cameras.empty()) {
      report.error("camera.file",
                   "holds no camera; give \"position\" and \"target\" with type \"perspective\" instead");
    } else if (wanted == cameras.end()) {
      report.error("camera.name", "is no camera of the file, which has " + namesOf(cameras));
    } else {
      const std::string file = camera.file;
      camera = cameraFrom(*wanted);
      camera.file = file;
    }
  } catch (const Error& error) {
    report.error("camera.file", error.what());
  }
}

} // namespace tyndall::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace tyndall::scene {

/// Orthonormal axes of a camera in world space.
struct CameraFrame {
  glm::dvec3 forward, right, up;
};

inline CameraFrame cameraFrame(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  return {forward, right, glm::cross(right, forward)};
}

} // namespace tyndall::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interop/scene.h"
#include "scene/scene.h"

namespace tyndall::gpu_scene {

/// Where a camera sees points that are relative to `centre`: x and y of the picture in [0, 1], from the top left, times
/// z; z is positive before the camera. Of a lens: through its middle.
glm::mat4x3 rasterFromWorld(const scene::Camera& camera, const glm::uvec2& imageSize, const glm::dvec3& centre);

} // namespace tyndall::gpu_scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interop/scene.h"
#include "light/environment.h"
#include "math/bounds.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace tyndall::gpu_scene {

/// The device's lights. Black ones are left out. Selection probabilities are proportional to a guess of the
/// irradiance at the scene; every light that is not black has one above 0.
struct PackedLights {
  std::vector<interop::PointLight> points;
  std::vector<interop::DistantLight> distant;  ///< map addresses still empty
  std::vector<light::EnvironmentTable> tables; ///< for distant lights of kind kDistantMap, in their order
  float pointShare = 0.0f;
  bool deltas = false;     ///< a sun without angular size is there
  bool areas = false;      ///< something at infinity that a direction can hit
  bool background = false; ///< a distant light is visible to the camera
  std::vector<std::string> notes;
};

/// @throws Error if an environment file cannot be read.
PackedLights packLights(const scene::Scene& scene, const Bounds3& bounds, const glm::dvec3& centre);

} // namespace tyndall::gpu_scene

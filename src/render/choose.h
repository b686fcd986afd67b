// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "render/estimator.h"
#include "scene/scene.h"

#include <optional>
#include <string>

namespace tyndall::render {

/// Which method a scene is rendered with, and why.
struct MethodChoice {
  Method method = Method::March;
  double cacheBytes = 0.0; ///< what light caches may take
  std::string reason;      ///< for the user, without a full stop
};

/// The march where it serves; tracking for what it does not (many grids, memory, very long grids), and, unless the
/// march is asked for, where environments alone light a peaked phase function: there tracking has less variance for its
/// time.
/// @param wanted the user's choice. @param memoryBytes for volumes and light caches together.
/// @throws Error if the march is wanted where it does not serve, with the reason.
MethodChoice chooseMethod(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, std::optional<Method> wanted,
                          double memoryBytes);

} // namespace tyndall::render

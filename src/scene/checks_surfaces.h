// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/check_report.h"
#include "scene/scene.h"

namespace tyndall::scene {

/// What contradicts itself among materials, objects and the media inside them. See checks.h.
void checkSurfaces(const Scene& scene, CheckReport& report);

/// Whether an object glows, or is a file that may hold lights or glowing materials.
bool surfacesMayShine(const Scene& scene);

} // namespace tyndall::scene

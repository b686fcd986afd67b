// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "scene/scene.h"

#include <vector>

namespace tyndall::render {

/// Which pixels a medium can be seen through, conservatively: a pixel that is not marked sees the background alone
/// from anywhere in its footprint. Grids are marked brick by brick.
/// @return image size.x * size.y flags, x fastest.
std::vector<bool> sceneCoverage(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes);

} // namespace tyndall::render

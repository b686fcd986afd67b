// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/load.h"

namespace tyndall::app {

/// Opens what a scene file names and reports at the place where it is named: volumes that cannot be read, grids that
/// are not there or cannot be rendered (with the nearest name), environment maps without usable colour. Files that do
/// not exist are left to scene::readScene, and so is everything in a text that is not JSON.
std::vector<scene::Problem> checkReferences(const std::filesystem::path& sceneFile);

} // namespace tyndall::app

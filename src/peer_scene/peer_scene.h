// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

#include <filesystem>

/// Scenes as other renderers are given them: every value settled, in world space. peers/README.md has the format.
namespace tyndall::peer_scene {

/// Writes folder/scene.json with the grids, meshes and maps that it names; makes the folder.
/// @throws Error that names the feature which the format cannot say, or if a file cannot be read or written.
void writePeerScene(const scene::Scene& scene, const std::filesystem::path& folder);

} // namespace tyndall::peer_scene

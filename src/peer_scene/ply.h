// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/model.h"

#include <filesystem>
#include <vector>

namespace tyndall::peer_scene {

/// Writes positions, normals (if there are any) and some of the triangles of a mesh as binary PLY.
/// @throws Error if the file cannot be written.
void writePly(const std::filesystem::path& path, const geometry::Mesh& mesh, const std::vector<glm::uvec3>& triangles);

} // namespace tyndall::peer_scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>

namespace tyndall::app {

/// Whether a file name is that of a mesh, which commands take inside a scene only.
inline bool isMesh(const std::string& path) {
  return path.ends_with(".gltf") || path.ends_with(".glb") || path.ends_with(".obj") || path.ends_with(".ply");
}

/// What to do with a mesh instead.
inline std::string meshAdvice(const std::string& path) {
  return fmt::format("{}: is a mesh, not a scene; write a scene (.json) that has it as an object and a light, such as "
                     R"({{"objects": [{{"type": "mesh", "file": "{}"}}], "lights": [{{"type": "sky"}}]}}; )"
                     "docs/scene-format.md has the rest",
                     path, path);
}

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/json.h"

#include <filesystem>
#include <functional>
#include <string>

namespace tyndall::scene {

/// A file that a scene names.
struct FileReference {
  std::filesystem::path path; ///< absolute, or relative to the working folder
  std::string problem;        ///< empty if it can be read; else what is wrong and the fix
};

/// Resolves a file name against `folder` and checks that it is there. A name with frame digits left open
/// (`smoke_####.vdb`, `smoke_%04d.vdb`) needs only its folder.
FileReference resolveFile(const std::string& name, const std::filesystem::path& folder);

/// `file` as it should be written into a scene file in `folder`.
std::string relativeName(const std::string& file, const std::filesystem::path& folder);

/// Replaces the file names in a value: the texts of its members "file", and its own if it `isName`.
void mapFileNames(json::Value& value, bool isName, const std::function<std::string(const json::Value&)>& replacement);

} // namespace tyndall::scene

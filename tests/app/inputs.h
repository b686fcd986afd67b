// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tyndall::test {

/// A folder, made once for the whole program, with readable and malformed volumes (support/fixtures.h), scenes with
/// one mistake each, `sound.json`, pictures `picture_WxH.exr`, and parts of a film to be merged (`left.part`,
/// `right.part`, `other_scene.part`).
const std::filesystem::path& inputs();

/// A ball of fog beside a point light with further members at the top level and in the medium.
std::string sceneText(const std::string& members = "", const std::string& medium = "");

} // namespace tyndall::test

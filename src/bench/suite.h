// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tyndall::bench {

/// A scene to be rendered at several efforts.
struct SuiteScene {
  std::string name;  ///< unique in the suite
  std::string title; ///< what it is about, a line
  std::filesystem::path file;
  glm::uvec2 size{128};
  std::vector<std::uint32_t> samples;  ///< per pixel, rising
  std::vector<std::string> arguments;  ///< of `tyndall render`, for all of ours
  std::vector<std::string> contenders; ///< names of Suite::contenders that take part beside the default
};

/// Scenes, and arguments of `tyndall render` by the name of the contender that they make.
struct Suite {
  std::string name;
  std::string title;
  std::map<std::string, std::vector<std::string>> contenders;
  std::vector<SuiteScene> scenes;
};

/// Files of scenes are relative to the suite's folder.
/// @throws Error with file, line and column if the file is no suite.
Suite loadSuite(const std::filesystem::path& file);

/// The file of a suite that is named by a path, or by the name of one that comes with the program.
/// @throws Error that lists those.
std::filesystem::path findSuite(const std::string& nameOrPath);

/// A file that comes with the program, such as "scenes/bench": beside the program, in a folder above it, or in the
/// working folder or above. Empty if it is nowhere.
std::filesystem::path findShipped(const std::filesystem::path& relative);

} // namespace tyndall::bench

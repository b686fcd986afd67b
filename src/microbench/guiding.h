// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/load.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::microbench {

struct GuidingOptions {
  std::filesystem::path folder = "scenes/guiding";
  std::vector<std::string> scenes; ///< names of its files; empty: all, or those of the ablation
  std::vector<std::string> integrators{"path", "screen-chains", "mcpg-paper", "mcpg"};
  std::vector<bool> lightSampling{false, true};
  glm::uvec2 size{128, 128};
  std::uint32_t samples = 64; ///< per pixel
  std::uint32_t seeds = 5;
  bool ablate = false;
  std::vector<scene::Override> overrides; ///< of the guide, for what is guided
  std::string device;
  std::filesystem::path json;  ///< empty: none is written
  std::filesystem::path plots; ///< folder; likewise
};

/// Fills the options in while parsing.
std::shared_ptr<GuidingOptions> addGuidingOptions(CLI::App& command);

/// Files of the scenes asked for. @throws Error naming those that there are.
std::vector<std::filesystem::path> sceneFiles(const GuidingOptions& options);

/// Judges guided paths: their variance and time beside those of integrator `path`, with intervals; whether their means
/// agree. Prints the table, and writes what is asked for after every scene. @throws Error
void runGuiding(const GuidingOptions& options);

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microbench/frames_run.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <vector>

namespace tyndall::microbench {

struct SheetOptions {
  std::filesystem::path scene; ///< empty: the room whose brighter lamp moves after frame 12
  FrameOptions frame{.size = {64, 48}, .samples = 1, .seeds = 1};
  int frames = 30;
  int every = 1; ///< of the frames one is shown
  std::vector<std::string> contenders{"path", "mcpg-paper", "mcpg"};
  std::vector<scene::Override> overrides;
  std::string device;
  std::filesystem::path output = "sheet.png";
};

/// Fills the options in while parsing.
std::shared_ptr<SheetOptions> addSheetOptions(CLI::App& command);

/// Frames side by side, a row for each contender, as a PNG: what people see of sequences. @throws Error
void runSheet(const SheetOptions& options);

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microbench/frames_run.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tyndall::microbench {

struct FramesOptions {
  FrameOptions frame;
  int frames = 24;
  std::uint32_t referenceSamples = 256; ///< per pixel, with light sampling
  std::vector<std::string> events;      ///< names; empty: all
  std::vector<std::string> contenders;  ///< names; empty: all
  std::vector<scene::Override> overrides;
  std::string device;
  std::filesystem::path json;  ///< empty: none is written
  std::filesystem::path plots; ///< folder; likewise
};

/// Fills the options in while parsing.
std::shared_ptr<FramesOptions> addFramesOptions(CLI::App& command);

/// Those of the names; all where there are none. `overrides` change what is guided. @throws Error naming those that
/// there are
std::vector<FrameContender> frameContenders(const std::vector<std::string>& names,
                                            const std::vector<scene::Override>& overrides);

/// Errors of frames while lamps and camera of a room do what they do, and how soon guiding has got over it. @throws
/// Error
void runFrames(const FramesOptions& options);

} // namespace tyndall::microbench

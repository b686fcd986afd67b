// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/contender.h"
#include "bench/results.h"

#include <functional>

namespace tyndall::bench {

struct MeasureOptions {
  std::uint32_t seeds = 8;
  std::uint32_t firstSeed = 1;
  double limitSeconds = 60.0;    ///< of CPU time: an effort that is expected to take longer is left out
  unsigned threads = 0;          ///< 0: what each program chooses
  std::filesystem::path folder;  ///< for pictures; it is there
  std::filesystem::path program; ///< ours, which writes scenes for peers
};

/// One line about what has been measured.
using Say = std::function<void(const std::string&)>;

/// Renders a scene with all contenders at all their efforts, in turn: effort by effort, seed by seed, so that what else
/// the machine does meets all of them. The first contender is the one whose mean is the reference.
/// @throws Error if a program of ours fails.
SceneResult measureScene(const SuiteScene& scene, const std::vector<Contender>& contenders,
                         const MeasureOptions& options, const Say& say);

} // namespace tyndall::bench

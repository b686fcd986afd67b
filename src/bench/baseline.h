// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/results.h"

#include <string>
#include <vector>

namespace tyndall::bench {

/// A figure beside what it was.
struct Change {
  std::string scene;
  std::string contender;
  std::string effort;
  std::string measure; ///< "relMSE x lookups" and the like
  Figure ratio;        ///< now over then
  std::size_t runs = 0;
  bool worse = false; ///< surely, and by more than kAllowedRise
  bool better = false;
};

/// A rise that is not yet a regression.
inline constexpr double kAllowedRise = 1.05;

/// relMSE times each kind of counted work, of every effort of ours that both reports have. Work is counted by the
/// device and pictures are fixed by their seeds, so that a loaded machine changes nothing.
/// @throws Error if they have nothing in common.
std::vector<Change> compareReports(const Report& now, const Report& then);

/// What has surely changed as a table, worst first.
std::string formatChanges(const std::vector<Change>& changes);

} // namespace tyndall::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/line_chart.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tyndall::microbench {

/// One contender through one event.
struct FrameRow {
  std::string event;
  std::string name;
  std::vector<double> errors; ///< of the frames from the first one on
  std::vector<double> steady; ///< ... where what happens has always been so
  int eventFrame = 0;         ///< the last one before it

  std::optional<std::size_t> recovery() const;
  /// Mean of `steady` after the event.
  double level() const;
};

/// A table for each event: errors of some frames, the level, frames to recover.
std::string markdownOf(const std::vector<FrameRow>& rows);

/// What is not a number becomes null.
nlohmann::ordered_json toJson(const FrameRow& row);

/// Errors over the frames, of one event.
bench::LineChart chartOf(const std::vector<FrameRow>& rows, const std::string& event, const std::string& title);

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/renderer.h"

#include <string>

namespace tyndall::app {

/// "1:23:45", "2:05" or "7 s".
std::string formatDuration(double seconds);

/// One line about how far a render is. `width` is the number of characters of the bar, 0 = without.
std::string formatProgress(const render::Progress& progress, int barWidth);

/// Shows progress on stderr: a bar that is drawn over on a terminal; else a line at most every 2 s, and only after
/// another tenth of the work or 10 s.
class ProgressDisplay {
public:
  explicit ProgressDisplay(bool quiet);
  /// Ends the bar's line.
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const render::Progress& progress);

private:
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  double lastSeconds_ = 0.0;
  double lastFraction_ = 0.0;
};

} // namespace tyndall::app

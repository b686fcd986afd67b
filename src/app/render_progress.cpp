// SPDX-License-Identifier: Apache-2.0
#include "app/render_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace tyndall::app {
namespace {

constexpr int kBarWidth = 24;
constexpr double kRedrawSeconds = 0.1;
constexpr double kLineSeconds = 2.0;      // plain lines are never nearer
constexpr double kLineFraction = 0.1;
constexpr double kSilentSeconds = 10.0;   // ... and never farther apart

std::string bar(double fraction, int width) {
  const int full = static_cast<int>(std::lround(fraction * width));
  return fmt::format("[{}{}] ", std::string(static_cast<std::size_t>(full), '#'),
                     std::string(static_cast<std::size_t>(width - full), '.'));
}

} // namespace

std::string formatDuration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) {
    return fmt::format("{} s", whole);
  }
  if (whole < 3600) {
    return fmt::format("{}:{:02d}", whole / 60, whole % 60);
  }
  return fmt::format("{}:{:02d}:{:02d}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string formatProgress(const render::Progress& progress, int barWidth) {
  std::string text = barWidth > 0 ? bar(progress.fraction, barWidth) : std::string();
  text += fmt::format("{:3.0f} %  {:.0f} samples per pixel", 100.0 * progress.fraction, progress.samplesPerPixel);
  if (progress.fraction > 0.0 && progress.fraction < 1.0) {
    text += fmt::format("  {} left", formatDuration(progress.seconds / progress.fraction * (1.0 - progress.fraction)));
  }
  if (std::isfinite(progress.error)) {
    text += fmt::format("  error {:.2g} %", 100.0 * progress.error);
  }
  if (progress.nonFinite > 0) {
    text += fmt::format("  {} NOT FINITE", progress.nonFinite);
  }
  return text;
}

ProgressDisplay::ProgressDisplay(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressDisplay::~ProgressDisplay() {
  if (drawn_) {
    std::fputc('\n', stderr);
  }
}

void ProgressDisplay::show(const render::Progress& progress) {
  if (quiet_) {
    return;
  }
  const double waited = progress.seconds - lastSeconds_;
  if (terminal_) {
    if (!drawn_ || waited >= kRedrawSeconds || progress.fraction >= 1.0) {
      fmt::print(stderr, "\r{}\x1b[K", formatProgress(progress, kBarWidth)); // and clear the rest of the line
      std::fflush(stderr);
      drawn_ = true;
      lastSeconds_ = progress.seconds;
    }
    return;
  }
  const bool worth = progress.fraction - lastFraction_ >= kLineFraction || waited >= kSilentSeconds;
  if (waited >= kLineSeconds && worth) {
    fmt::print(stderr, "{}\n", formatProgress(progress, 0));
    lastSeconds_ = progress.seconds;
    lastFraction_ = progress.fraction;
  }
}

} // namespace tyndall::app

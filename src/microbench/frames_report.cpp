// SPDX-License-Identifier: Apache-2.0
#include "microbench/frames_report.h"

#include "microbench/frames_statistics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>

namespace tyndall::microbench {
namespace {

/// After the event; the last frame follows.
constexpr int kShownAfter[] = {0, 1, 2, 4, 6, 8};

std::vector<int> shownFrames(const FrameRow& row) {
  std::vector<int> frames;
  for (const int after : kShownAfter) {
    if (row.eventFrame + after < int(row.errors.size())) {
      frames.push_back(row.eventFrame + after);
    }
  }
  frames.push_back(int(row.errors.size()));
  return frames;
}

std::string headOf(const FrameRow& row) {
  std::string head = fmt::format("| {}, frame |", row.event);
  std::string rule = "| --- |";
  for (const int frame : shownFrames(row)) {
    head += fmt::format(" {} |", frame);
    rule += " --- |";
  }
  return head + " always so | recovered after |\n" + rule + " --- | --- |\n";
}

std::span<const double> after(const std::vector<double>& errors, int eventFrame) {
  return std::span(errors).subspan(std::min(std::size_t(eventFrame), errors.size()));
}

} // namespace

std::optional<std::size_t> FrameRow::recovery() const {
  return framesToRecover(after(errors, eventFrame), after(steady, eventFrame));
}

double FrameRow::level() const {
  const std::span<const double> late = after(steady, eventFrame);
  return std::accumulate(late.begin(), late.end(), 0.0) / double(late.size());
}

std::string markdownOf(const std::vector<FrameRow>& rows) {
  std::string text;
  const FrameRow* last = nullptr;
  for (const FrameRow& row : rows) {
    if (last == nullptr || last->event != row.event) {
      text += (last == nullptr ? "" : "\n") + headOf(row);
    }
    last = &row;
    text += fmt::format("| {} |", row.name);
    for (const int frame : shownFrames(row)) {
      text += fmt::format(" {:.2g} |", row.errors[std::size_t(frame) - 1]);
    }
    const std::optional<std::size_t> recovery = row.recovery();
    text += fmt::format(" {:.2g} | {} |\n", row.level(), recovery ? std::to_string(*recovery) : "not yet");
  }
  return text;
}

nlohmann::ordered_json toJson(const FrameRow& row) {
  const std::optional<std::size_t> recovery = row.recovery();
  return {{"event", row.event},
          {"contender", row.name},
          {"eventFrame", row.eventFrame},
          {"relMse", row.errors},
          {"steady", row.steady},
          {"level", row.level()},
          {"recovery", recovery ? nlohmann::ordered_json(*recovery) : nlohmann::ordered_json()}};
}

bench::LineChart chartOf(const std::vector<FrameRow>& rows, const std::string& event, const std::string& title) {
  bench::LineChart chart{.title = title, .xAxis = "frame", .yAxis = "relMSE of a frame", .lines = {}};
  for (const FrameRow& row : rows) {
    if (row.event != event) {
      continue;
    }
    bench::ChartLine line{.label = row.name, .points = {}};
    for (std::size_t i = 0; i < row.errors.size(); ++i) {
      line.points.push_back({double(i + 1), row.errors[i], {}});
    }
    chart.lines.push_back(line);
  }
  return chart;
}

} // namespace tyndall::microbench

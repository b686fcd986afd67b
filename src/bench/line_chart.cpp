// SPDX-License-Identifier: Apache-2.0
#include "bench/line_chart.h"

#include "bench/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::bench {
namespace {

// In pixels.
constexpr double kLeft = 76.0;
constexpr double kTop = 40.0;
constexpr double kWidth = 400.0; ///< of the plot
constexpr double kHeight = 260.0;
constexpr double kBottom = 52.0;
constexpr double kKey = 52.0;   ///< beside the names of lines
constexpr double kLetter = 7.0; ///< width of one, about
constexpr double kRow = 18.0;
constexpr double kMark = 3.5;

bool drawable(const ChartPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0.0 && point.y > 0.0;
}

/// A logarithmic axis.
struct Axis {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  std::vector<double> ticks;

  void include(double value) {
    if (std::isfinite(value) && value > 0.0) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  void settle() {
    if (high <= 0.0) {
      low = high = 1.0;
    }
    ticks = logTicks(low, high);
    low = ticks.front();
    high = ticks.back();
  }
  /// In [0, 1].
  double at(double value) const { return std::log(value / low) / std::log(high / low); }
};

struct Layout {
  Axis x;
  Axis y;
  double across(double value) const { return kLeft + kWidth * x.at(value); }
  double down(double value) const { return kTop + kHeight * (1.0 - y.at(value)); }
};

Layout layoutOf(const LineChart& chart) {
  Layout layout;
  for (const ChartLine& line : chart.lines) {
    for (const ChartPoint& point : line.points) {
      if (drawable(point)) {
        layout.x.include(point.x);
        layout.y.include(point.y);
      }
    }
  }
  layout.x.settle();
  layout.y.settle();
  return layout;
}

std::string text(double x, double y, const std::string& attributes, const std::string& what) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, attributes, escaped(what));
}

std::string lineText(double x1, double y1, double x2, double y2, const std::string& stroke) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2,
                     stroke);
}

std::string axesText(const LineChart& chart, const Layout& layout) {
  std::string result;
  for (const double tick : layout.x.ticks) {
    const double x = layout.across(tick);
    result += lineText(x, kTop, x, kTop + kHeight, "#e4e4e4");
    result += text(x, kTop + kHeight + 18.0, " text-anchor=\"middle\"", fmt::format("{:g}", tick));
  }
  for (const double tick : layout.y.ticks) {
    const double y = layout.down(tick);
    result += lineText(kLeft, y, kLeft + kWidth, y, "#e4e4e4");
    result += text(kLeft - 7.0, y + 4.0, " text-anchor=\"end\"", fmt::format("{:g}", tick));
  }
  result += text(kLeft + 0.5 * kWidth, kTop + kHeight + 40.0, " text-anchor=\"middle\"", chart.xAxis);
  const double middle = kTop + 0.5 * kHeight;
  return result + text(16.0, middle, fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 16 {:.1f})\"", middle),
                       chart.yAxis);
}

std::string whiskerText(const ChartPoint& point, const Layout& layout, const char* colour) {
  if (!(point.range.low > 0.0) || !std::isfinite(point.range.high)) {
    return {};
  }
  const auto inside = [&](double value) { return std::clamp(value, layout.y.low, layout.y.high); };
  return fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"{3}\" stroke-width=\"1\"/>\n",
                     layout.across(point.x), layout.down(inside(point.range.low)),
                     layout.down(inside(point.range.high)), colour);
}

std::string pathText(const ChartLine& line, const Layout& layout, const char* colour) {
  std::string path;
  std::string marks;
  for (const ChartPoint& point : line.points) {
    if (!drawable(point)) {
      continue;
    }
    const double x = layout.across(point.x);
    const double y = layout.down(point.y);
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    if (!line.dashed) {
      marks += whiskerText(point, layout, colour);
      marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x, y, kMark, colour);
    }
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"{}/>\n{}", path, colour,
                     line.dashed ? " stroke-dasharray=\"5 4\"" : "", marks);
}

} // namespace

std::string svgText(const LineChart& chart) {
  const Layout layout = layoutOf(chart);
  const double key = kRow * double(chart.lines.size());
  std::size_t letters = 0;
  for (const ChartLine& line : chart.lines) {
    letters = std::max(letters, line.label.size());
  }
  std::string result = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      kLeft + kWidth + kKey + kLetter * double(letters), std::max(kTop + kHeight + kBottom, kTop + key));
  result += text(kLeft, 24.0, " font-size=\"14\" font-weight=\"bold\"", chart.title);
  result += axesText(chart, layout);
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    const ChartLine& line = chart.lines[i];
    const char* colour = line.dashed ? "#888" : kSeriesColours[i % kSeriesColours.size()];
    result += pathText(line, layout, colour);
    const double y = kTop + kRow * (0.5 + double(i));
    const double x = kLeft + kWidth + 14.0;
    result += fmt::format("<path d=\"M{:.1f} {:.1f}h18\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", x, y, colour,
                          line.dashed ? " stroke-dasharray=\"5 4\"" : "");
    result += text(x + 24.0, y + 4.0, "", line.label);
  }
  return result + "</svg>\n";
}

} // namespace tyndall::bench

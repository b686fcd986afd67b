// SPDX-License-Identifier: Apache-2.0
#include "microbench/bar_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tyndall::microbench {
namespace {

// In pixels.
constexpr double kRow = 20.0;
constexpr double kBar = 12.0;
constexpr double kFont = 13.0;
constexpr double kLetter = 7.2;  ///< width of one, about
constexpr double kPlot = 460.0;  ///< width between the axis' ends
constexpr double kTop = 56.0;    ///< title
constexpr double kBottom = 78.0; ///< numbers, name and note of the axis
constexpr double kMargin = 16.0;
constexpr double kTextRight = 190.0;   ///< figures beside the bars

bool drawable(const Bar& bar) { return std::isfinite(bar.value) && bar.value > 0.0; }

bool hasRange(const Bar& bar) {
  return std::isfinite(bar.range.low) && std::isfinite(bar.range.high) && bar.range.low > 0.0;
}

/// Where things are.
struct Layout {
  double left = 0.0; ///< of the axis
  double bottom = 0.0;
  std::vector<double> ticks;

  double x(double value) const {
    const double low = std::log(ticks.front());
    return left + kPlot * (std::log(value) - low) / (std::log(ticks.back()) - low);
  }
  double width() const { return left + kPlot + kTextRight; }
  double height() const { return bottom + kBottom; }
};

bool beginsGroup(const BarChart& chart, std::size_t bar) {
  return bar == 0 || chart.bars[bar].group != chart.bars[bar - 1].group;
}

Layout layoutOf(const BarChart& chart) {
  Layout layout;
  double low = 1.0;
  double high = 1.0;
  std::size_t letters = 0;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    const Bar& bar = chart.bars[i];
    rows += beginsGroup(chart, i) ? 2 : 1;
    letters = std::max({letters, bar.label.size(), bar.group.size()});
    if (drawable(bar)) {
      low = std::min({low, bar.value, hasRange(bar) ? bar.range.low : bar.value});
      high = std::max({high, bar.value, hasRange(bar) ? bar.range.high : bar.value});
    }
  }
  layout.left = 2.0 * kMargin + kLetter * double(letters);
  layout.bottom = kTop + kRow * double(rows) + 0.5 * kRow;
  layout.ticks = logTicks(low, high);
  return layout;
}

std::string text(double x, double y, const std::string& attributes, const std::string& what) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, attributes, escaped(what));
}

std::string axisText(const BarChart& chart, const Layout& layout) {
  std::string result;
  for (const double tick : layout.ticks) {
    const double x = layout.x(tick);
    result += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\"/>\n", x,
                          kTop, layout.bottom, tick == 1.0 ? "#000" : "#ddd");
    result += text(x, layout.bottom + 18.0, " text-anchor=\"middle\"", fmt::format("{:g}", tick));
  }
  result += text(layout.left + 0.5 * kPlot, layout.bottom + 42.0, " text-anchor=\"middle\"", chart.axis);
  return result +
         text(layout.left + 0.5 * kPlot, layout.bottom + 62.0, " text-anchor=\"middle\" fill=\"#555\"", chart.note);
}

std::string whiskerText(const Bar& bar, const Layout& layout, double middle) {
  const double low = layout.x(bar.range.low);
  const double high = layout.x(bar.range.high);
  return fmt::format("<path d=\"M{0:.1f} {2:.1f}H{1:.1f}M{0:.1f} {3:.1f}V{4:.1f}M{1:.1f} {3:.1f}V{4:.1f}\" "
                     "stroke=\"#000\" fill=\"none\"/>\n",
                     low, high, middle, middle - 3.0, middle + 3.0);
}

std::string barText(const Bar& bar, const Layout& layout, double top) {
  const double middle = top + 0.5 * kRow;
  const double baseline = middle + 0.35 * kFont;
  std::string result = text(layout.left - 8.0, baseline, " text-anchor=\"end\"", bar.label);
  const double one = layout.x(1.0);
  if (!drawable(bar)) {
    return result + text(one + 6.0, baseline, " fill=\"#555\"", "no figure");
  }
  const double end = layout.x(bar.value);
  result += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                        std::min(one, end), middle - 0.5 * kBar, std::abs(end - one), kBar,
                        kSeriesColours[bar.colour % kSeriesColours.size()]);
  std::string figure = shortText(bar.value);
  if (hasRange(bar)) {
    result += whiskerText(bar, layout, middle);
    figure += fmt::format(" [{}, {}]", shortText(bar.range.low), shortText(bar.range.high));
  }
  return result + text(layout.left + kPlot + 12.0, baseline, "", figure);
}

} // namespace

std::string svgText(const BarChart& chart) {
  const Layout layout = layoutOf(chart);
  std::string result = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"{2:.0f}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      layout.width(), layout.height(), kFont);
  result += text(kMargin, 30.0, " font-size=\"16\" font-weight=\"bold\"", chart.title);
  result += axisText(chart, layout);
  double top = kTop;
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    if (beginsGroup(chart, i)) {
      result += text(kMargin, top + 0.5 * kRow + 0.35 * kFont, " font-weight=\"bold\"", chart.bars[i].group);
      top += kRow;
    }
    result += barText(chart.bars[i], layout, top);
    top += kRow;
  }
  return result + "</svg>\n";
}

} // namespace tyndall::microbench

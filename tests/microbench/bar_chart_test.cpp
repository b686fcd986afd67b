// SPDX-License-Identifier: Apache-2.0
#include "microbench/bar_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace tyndall::microbench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

BarChart chartOf(std::vector<Bar> bars) { return {"Title", "axis", "note", std::move(bars)}; }

/// x of the bars, and their widths, in the order of the file.
struct Rectangle {
  double x = 0.0;
  double width = 0.0;
};
std::vector<Rectangle> barsIn(const std::string& svg) {
  static const std::regex kRectangle("<rect x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\"");
  std::vector<Rectangle> result;
  for (auto each = std::sregex_iterator(svg.begin(), svg.end(), kRectangle); each != std::sregex_iterator(); ++each) {
    result.push_back({std::stod((*each)[1]), std::stod((*each)[2])});
  }
  return result;
}

std::size_t countOf(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) {
    ++count;
  }
  return count;
}

TEST(LogTicks, SpanTheFiguresInStepsOfOneTwoFive) {
  EXPECT_THAT(logTicks(0.3, 4.0), ElementsAre(0.2, 0.5, 1.0, 2.0, 5.0));
  EXPECT_THAT(logTicks(0.02, 30.0), ElementsAre(0.01, 0.1, 1.0, 10.0, 100.0));
  EXPECT_THAT(logTicks(1.0, 1.0), ElementsAre(1.0, 2.0));
}

TEST(LogTicks, HoldEveryFigureAndOne) {
  for (double low = 1e-6; low <= 1.0; low *= 1.7) {
    for (double high = 1.0; high <= 1e6; high *= 2.3) {
      const std::vector<double> ticks = logTicks(low, high);
      ASSERT_GE(ticks.size(), 2u);
      EXPECT_LE(ticks.front(), low);
      EXPECT_GE(ticks.back(), high);
      EXPECT_THAT(ticks, testing::Contains(1.0));
    }
  }
}

TEST(BarChart, LengthsAreLogarithmsFromOne) {
  const std::vector<Rectangle> bars = barsIn(svgText(chartOf(
      {{"g", "a", 10.0, {10.0, 10.0}, 0}, {"g", "b", 0.1, {0.1, 0.1}, 1}, {"g", "c", 100.0, {100.0, 100.0}, 2}})));
  ASSERT_EQ(bars.size(), 3u);
  // Written to a tenth of a pixel.
  EXPECT_NEAR(bars[1].width, bars[0].width, 0.11);
  EXPECT_NEAR(bars[2].width, 2.0 * bars[0].width, 0.11);
  EXPECT_NEAR(bars[1].x + bars[1].width, bars[0].x, 0.11); // the worse one ends where the better one begins
  EXPECT_GT(bars[0].width, 50.0);
}

TEST(BarChart, TellsEveryFigureAndItsInterval) {
  const std::string svg = svgText(chartOf(
      {{"first", "a", 3.2, {2.1, 4.5}, 0}, {"first", "b", 0.5, {0.4, 0.6}, 1}, {"second", "a", 2.0, {1.5, 2.5}, 0}}));
  EXPECT_THAT(svg, HasSubstr(">3.20 [2.10, 4.50]<"));
  EXPECT_THAT(svg, HasSubstr(">0.500 [0.400, 0.600]<"));
  EXPECT_EQ(countOf(svg, ">first<"), 1u); // a heading, once for its bars
  EXPECT_EQ(countOf(svg, ">second<"), 1u);
  EXPECT_EQ(countOf(svg, "<path"), 3u);
}

TEST(BarChart, NeedsNothingFromElsewhereAndQuotesWhatItIsGiven) {
  const std::string svg = svgText(chartOf({{"a<b", "x & \"y\"", 2.0, {1.0, 3.0}, 0}}));
  EXPECT_THAT(svg, HasSubstr("a&lt;b"));
  EXPECT_THAT(svg, HasSubstr("x &amp; &quot;y&quot;"));
  EXPECT_THAT(svg, Not(HasSubstr("href")));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  EXPECT_EQ(countOf(svg, "<text"), countOf(svg, "</text>"));
  EXPECT_EQ(countOf(svg, "http"), 1u); // the name space
}

TEST(BarChart, LeavesOutWhatIsNoFigure) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::string svg =
      svgText(chartOf({{"g", "none", kNone, {kNone, kNone}, 0}, {"g", "half", 2.0, {kNone, kNone}, 0}}));
  EXPECT_EQ(barsIn(svg).size(), 1u);
  EXPECT_THAT(svg, HasSubstr("no figure"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(countOf(svgText(chartOf({})), "</svg>"), 1u);
}

} // namespace
} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/figure.h"

#include <string>
#include <vector>

namespace tyndall::bench {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
  Interval range; ///< of y; empty: none
};

struct ChartLine {
  std::string label;
  std::vector<ChartPoint> points; ///< by rising x; what is not positive is left out
  bool dashed = false;            ///< theory, not measurement: no marks
};

/// Lines over two logarithmic axes.
struct LineChart {
  std::string title;
  std::string xAxis;
  std::string yAxis;
  std::vector<ChartLine> lines;
};

/// SVG of its own, to stand in a page or in a file.
std::string svgText(const LineChart& chart);

} // namespace tyndall::bench

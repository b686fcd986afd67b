// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/svg.h"
#include "microbench/measure.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tyndall::microbench {

/// A positive figure with its interval.
struct Bar {
  std::string group; ///< heading above its bars, which follow each other
  std::string label;
  double value = 0.0; ///< not a positive number: there is no bar, and the text says so
  Interval range;
  std::size_t colour = 0; ///< the same for what is the same in all groups
};

/// Lying bars on a logarithmic axis. They begin at 1: what is worse than the reference goes to the left.
struct BarChart {
  std::string title;
  std::string axis; ///< what the figures are
  std::string note; ///< below it
  std::vector<Bar> bars;
};

/// A picture file of its own, without anything from elsewhere.
std::string svgText(const BarChart& chart);

} // namespace tyndall::microbench

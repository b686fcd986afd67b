// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

/// What charts share.
namespace tyndall::bench {

/// Told apart by colour-blind eyes too: M. Okabe, K. Ito, Color Universal Design (2008).
inline constexpr std::array kSeriesColours{"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00"};

/// Text for SVG and HTML.
std::string escaped(const std::string& text);

/// Numbers 1, 2 and 5 times powers of ten, or powers alone where that is enough, from below `low` to above `high`.
std::vector<double> logTicks(double low, double high);

} // namespace tyndall::bench

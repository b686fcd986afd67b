// SPDX-License-Identifier: Apache-2.0
#include "bench/svg.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

constexpr double kMostFineTicks = 1.5; ///< decades

} // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    switch (letter) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += letter;
    }
  }
  return result;
}

std::vector<double> logTicks(double low, double high) {
  const auto first = static_cast<int>(std::floor(std::log10(low)));
  const auto last = static_cast<int>(std::ceil(std::log10(high)));
  const bool fine = std::log10(high / low) < kMostFineTicks;
  std::vector<double> ticks;
  for (int power = first; power <= last + 1; ++power) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      // Positive powers are exact, so 1 is 1.
      const double decade = power < 0 ? 1.0 / std::pow(10.0, -power) : std::pow(10.0, power);
      if (fine || factor == 1.0) {
        ticks.push_back(factor * decade);
      }
    }
  }
  const auto begin = std::upper_bound(ticks.begin(), ticks.end(), low) - 1;
  auto end = std::lower_bound(ticks.begin(), ticks.end(), high);
  if (end == begin) {
    ++end; // an axis has two ends
  }
  return {begin, end + 1};
}

} // namespace tyndall::bench

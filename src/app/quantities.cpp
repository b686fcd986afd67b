// SPDX-License-Identifier: Apache-2.0
#include "app/quantities.h"

#include "base/error.h"

#include <array>
#include <cmath>
#include <cstdlib>

namespace tyndall::app {

double parseFraction(const std::string& text, const char* option) {
  char* end = nullptr;
  double value = std::strtod(text.c_str(), &end);
  std::string unit(end);
  unit.erase(0, unit.find_first_not_of(' '));
  const bool percent = unit == "%";
  if (end == text.c_str() || !(unit.empty() || percent) || !(value >= 0.0) || !std::isfinite(value)) {
    fail("{} is \"{}\", not a share; write it as 0.01 or 1%", option, text);
  }
  return percent ? 0.01 * value : value;
}

std::string inBytes(double bytes) {
  static constexpr std::array kUnits{"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < kUnits.size()) {
    bytes /= 1000.0;
    ++unit;
  }
  return fmt::format("{:.{}f} {}", bytes, unit > 0 && bytes < 99.95 ? 1 : 0, kUnits[unit]);
}

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"

#include <cstdint>
#include <string>

/// Values of the command line. Each takes the option's name for its messages and throws Error with the right form.
namespace tyndall::app {

struct WholeLimits {
  std::uint32_t min = 0;
  std::uint32_t max = 0xffffffffu;
};
std::uint32_t parseWhole(const std::string& option, const std::string& text, const WholeLimits& limits);

/// Finite. "1.5".
double parseNumber(const std::string& option, const std::string& text);
/// Finite and above 0.
double parsePositive(const std::string& option, const std::string& text);
/// "60", "60s", "2m", "1h" -> seconds, above 0.
double parseSeconds(const std::string& option, const std::string& text);
/// "1%" or "0.01" -> 0.01; above 0 and below 1.
double parseShare(const std::string& option, const std::string& text);
/// "800M", "2G", "2GiB", "1e9" -> bytes, above 0. K, M, G are powers of 1000; KiB, MiB, GiB of 1024.
double parseBytes(const std::string& option, const std::string& text);
/// "640x480", edges from 1 to 65536.
glm::uvec2 parseSize(const std::string& option, const std::string& text);
/// "x0,y0,x1,y1": pixels [x0, x1) x [y0, y1), not empty.
film::Window parseWindow(const std::string& option, const std::string& text);

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#include "app/render_parse.h"

#include "base/error.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace tyndall::app {
namespace {

constexpr std::uint32_t kLargestEdge = 65536;

struct Unit {
  std::string_view name;
  double factor;
};

/// A finite number at the start of the text; `rest` is what follows it.
std::optional<double> leadingNumber(std::string_view text, std::string_view& rest) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || !std::isfinite(value)) {
    return std::nullopt;
  }
  rest = text.substr(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// A positive number with one of the units, or nothing.
template <std::size_t Count>
std::optional<double> withUnit(const std::string& text, const std::array<Unit, Count>& units) {
  std::string_view rest;
  const std::optional<double> value = leadingNumber(text, rest);
  for (const Unit& unit : units) {
    if (value && *value > 0.0 && rest == unit.name) {
      return *value * unit.factor;
    }
  }
  return std::nullopt;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<std::uint32_t> wholeNumber(const std::string& text) {
  std::uint32_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return problem == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

} // namespace

std::uint32_t parseWhole(const std::string& option, const std::string& text, const WholeLimits& limits) {
  const std::optional<std::uint32_t> value = wholeNumber(text);
  if (!value || *value < limits.min || *value > limits.max) {
    fail("{} {}: give a whole number from {} to {}", option, text, limits.min, limits.max);
  }
  return *value;
}

double parseNumber(const std::string& option, const std::string& text) {
  std::string_view rest;
  const std::optional<double> value = leadingNumber(text, rest);
  if (!value || !rest.empty()) {
    fail("{} {}: give a number", option, text);
  }
  return *value;
}

double parsePositive(const std::string& option, const std::string& text) {
  std::string_view rest;
  const std::optional<double> value = leadingNumber(text, rest);
  if (!value || !rest.empty() || *value <= 0.0) {
    fail("{} {}: give a number above 0", option, text);
  }
  return *value;
}

double parseSeconds(const std::string& option, const std::string& text) {
  constexpr std::array units{Unit{"", 1.0}, Unit{"s", 1.0}, Unit{"m", 60.0}, Unit{"min", 60.0}, Unit{"h", 3600.0}};
  const std::optional<double> seconds = withUnit(text, units);
  if (!seconds) {
    fail("{} {}: give a time such as 60, 60s, 2m or 1h", option, text);
  }
  return *seconds;
}

double parseShare(const std::string& option, const std::string& text) {
  constexpr std::array units{Unit{"", 1.0}, Unit{"%", 0.01}};
  const std::optional<double> share = withUnit(text, units);
  if (!share || *share >= 1.0) {
    fail("{} {}: give a relative error above 0 and below 1, such as 1% or 0.01", option, text);
  }
  return *share;
}

double parseBytes(const std::string& option, const std::string& text) {
  constexpr double kKibi = 1024.0;
  constexpr std::array units{Unit{"", 1.0},      Unit{"K", 1e3},          Unit{"M", 1e6},
                             Unit{"G", 1e9},     Unit{"KB", 1e3},         Unit{"MB", 1e6},
                             Unit{"GB", 1e9},    Unit{"KiB", kKibi},      Unit{"MiB", kKibi * kKibi},
                             Unit{"GiB", kKibi * kKibi * kKibi}};
  const std::optional<double> bytes = withUnit(text, units);
  if (!bytes) {
    fail("{} {}: give an amount of memory such as 800M or 2G", option, text);
  }
  return *bytes;
}

glm::uvec2 parseSize(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, 'x');
  glm::uvec2 size{0};
  for (int axis = 0; parts.size() == 2 && axis < 2; ++axis) {
    size[axis] = wholeNumber(parts[static_cast<std::size_t>(axis)]).value_or(0);
  }
  if (size.x < 1 || size.y < 1 || size.x > kLargestEdge || size.y > kLargestEdge) {
    fail("{} {}: give width x height in pixels, such as 640x480, each from 1 to {}", option, text, kLargestEdge);
  }
  return size;
}

film::Window parseWindow(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  std::array<std::uint32_t, 4> edges{};
  bool good = parts.size() == edges.size();
  for (std::size_t i = 0; good && i < edges.size(); ++i) {
    const std::optional<std::uint32_t> edge = wholeNumber(parts[i]);
    good = edge.has_value();
    edges[i] = edge.value_or(0);
  }
  if (!good || edges[0] >= edges[2] || edges[1] >= edges[3]) {
    fail("{} {}: give x0,y0,x1,y1 in pixels with x0 < x1 and y0 < y1, such as 0,0,320,240; the last are not included",
         option, text);
  }
  return {{edges[0], edges[1]}, {edges[2], edges[3]}};
}

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#include "microbench/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace tyndall::microbench {
namespace {

constexpr std::uint32_t kLargestEdge = 8192;
constexpr const char* kGuidePrefix = "guide.";

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& why) {
  throw CLI::ValidationError(option, fmt::format("{}: {}", value, why));
}

glm::uvec2 parseSize(const std::string& text) {
  glm::uvec2 size(0);
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.x);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.y);
    const bool whole = height.ec == std::errc() && height.ptr == end;
    if (whole && size.x > 0 && size.y > 0 && std::max(size.x, size.y) <= kLargestEdge) {
      return size;
    }
  }
  refuse("--size", text, fmt::format("write width x height in pixels, such as 128x128, {} at most", kLargestEdge));
}

scene::Override parseOverride(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || !text.starts_with(kGuidePrefix)) {
    refuse(
        "--set", text,
        "write a path of the section guide, = and a value, such as guide.states=2; what else a scene has must be the "
        "same for all");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

} // namespace

void addSize(CLI::App& command, glm::uvec2& size) {
  command
      .add_option_function<std::string>(
          "--size", [&size](const std::string& text) { size = parseSize(text); }, "Of the pictures, pixels")
      ->type_name("WxH");
}

void addGuideOverrides(CLI::App& command, std::vector<scene::Override>& overrides) {
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&overrides](const std::vector<std::string>& values) {
            std::transform(values.begin(), values.end(), std::back_inserter(overrides), parseOverride);
          },
          "Changes the guide in all rows that are guided; can be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->type_name("guide.key=value");
}

} // namespace tyndall::microbench

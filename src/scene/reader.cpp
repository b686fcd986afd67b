// SPDX-License-Identifier: Apache-2.0
#include "scene/reader.h"

#include "base/error.h"
#include "scene/file_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tyndall::scene {
namespace {

bool within(const Range& range, double number) {
  return number <= range.max && (range.openMin ? number > range.min : number >= range.min);
}

bool isWhole(const json::Value& value, const WholeRange& range) {
  return value.kind == json::Kind::Number && std::trunc(value.number) == value.number &&
         value.number >= double(range.min) && value.number <= double(range.max);
}

/// "\"a\", \"b\" or \"c\"".
std::string alternatives(std::span<const std::string_view> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
    text += json::inQuotes(words[i]);
  }
  return text;
}

} // namespace

std::string inWords(const Range& range) {
  const std::string unit = range.unit.empty() ? "" : fmt::format(" ({})", range.unit);
  if (range.openMin) {
    return fmt::format("a number above {} and up to {}{}", range.min, range.max, unit);
  }
  return fmt::format("a number from {} to {}{}", range.min, range.max, unit);
}

void Reader::reject(const json::Value& value, std::string_view key, const std::string& needs) {
  context_.findings.error(value.position, pathOf(key), fmt::format("must be {}, not {}", needs, json::inWords(value)));
}

std::optional<std::size_t> Reader::chosen(std::string_view key, std::span<const std::string_view> words) {
  const json::Value* value = take(key);
  if (value == nullptr) {
    return std::nullopt;
  }
  const auto found = std::find(words.begin(), words.end(), std::string_view(value->text));
  if (value->kind == json::Kind::String && found != words.end()) {
    return static_cast<std::size_t>(found - words.begin());
  }
  const std::string nearest = nearestName(value->text, std::vector<std::string>(words.begin(), words.end()));
  const bool suggest = value->kind == json::Kind::String && !nearest.empty();
  reject(*value, key, alternatives(words));
  if (suggest) {
    context_.findings.amend(fmt::format("; did you mean {}?", json::inQuotes(nearest)));
  }
  return std::nullopt;
}

void Reader::word(std::string_view key, std::string& target, std::span<const std::string_view> words,
                  std::string_view) {
  if (const std::optional<std::size_t> index = chosen(key, words)) {
    target = words[*index];
  }
}

void Reader::text(std::string_view key, std::string& target, std::string_view) {
  const bool required = required_;
  const json::Value* value = take(key);
  if (value == nullptr) {
    return;
  }
  if (value->kind != json::Kind::String) {
    return reject(*value, key, "text in double quotes");
  }
  if (required && value->text.empty()) {
    return reject(*value, key, "a name");
  }
  target = value->text;
}

void Reader::file(std::string_view key, std::string& target, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr) {
    return;
  }
  if (value->kind != json::Kind::String || value->text.empty()) {
    return reject(*value, key, "a file name in double quotes");
  }
  const bool fromCommandLine = value->position.override >= 0;
  const FileReference reference = resolveFile(value->text, fromCommandLine ? std::filesystem::path{} : context_.folder);
  if (!reference.problem.empty()) {
    context_.findings.error(value->position, pathOf(key), reference.problem);
  }
  target = reference.path.string();
}

void Reader::number(std::string_view key, double& target, const Range& range, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr) {
    return;
  }
  if (value->kind != json::Kind::Number || !within(range, value->number)) {
    return reject(*value, key, inWords(range));
  }
  target = value->number;
}

void Reader::whole(std::string_view key, std::uint32_t& target, const WholeRange& range, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr) {
    return;
  }
  if (!isWhole(*value, range)) {
    return reject(*value, key, fmt::format("a whole number from {} to {}", range.min, range.max));
  }
  target = static_cast<std::uint32_t>(value->number);
}

void Reader::whole(std::string_view key, std::optional<std::uint32_t>& target, const WholeRange& range,
                   std::string_view help) {
  const json::Value* value = object_.find(key);
  if (value != nullptr && value->kind == json::Kind::Null) {
    take(key);
    return target.reset();
  }
  std::uint32_t read = target.value_or(0);
  whole(key, read, range, help);
  if (active_ && value != nullptr && isWhole(*value, range)) {
    target = read;
  }
}

void Reader::flag(std::string_view key, bool& target, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr) {
    return;
  }
  if (value->kind != json::Kind::Boolean) {
    return reject(*value, key, "true or false");
  }
  target = value->boolean;
}

std::optional<glm::dvec3> Reader::three(const json::Value& value, std::string_view key) {
  const bool list = value.kind == json::Kind::Array && value.items.size() == 3;
  if (!list) {
    reject(value, key, "three numbers, such as [0, 1, 0]");
    return std::nullopt;
  }
  glm::dvec3 result(0.0);
  for (int i = 0; i < 3; ++i) {
    const json::Value& item = value.items[static_cast<std::size_t>(i)];
    if (item.kind != json::Kind::Number) {
      reject(item, fmt::format("{}.{}", key, i), "a number");
      return std::nullopt;
    }
    result[i] = item.number;
  }
  return result;
}

void Reader::point(std::string_view key, glm::dvec3& target, std::string_view) {
  const json::Value* value = take(key);
  const std::optional<glm::dvec3> read = value != nullptr ? three(*value, key) : std::nullopt;
  if (!read) {
    return;
  }
  constexpr Range kCoordinate{-kLargestLength, kLargestLength, "scene units"};
  for (int i = 0; i < 3; ++i) {
    if (!within(kCoordinate, (*read)[i])) {
      return reject(value->items[static_cast<std::size_t>(i)], fmt::format("{}.{}", key, i), inWords(kCoordinate));
    }
  }
  target = *read;
}

void Reader::direction(std::string_view key, glm::dvec3& target, std::string_view) {
  const json::Value* value = take(key);
  const std::optional<glm::dvec3> read = value != nullptr ? three(*value, key) : std::nullopt;
  if (!read) {
    return;
  }
  const double largest = std::max({std::abs(read->x), std::abs(read->y), std::abs(read->z)});
  if (largest == 0.0) {
    context_.findings.error(value->position, pathOf(key), "is zero; give a direction, such as [0, -1, 0]");
    return;
  }
  // Already of unit length: kept to the last bit, so that a scene written out reads back the same.
  const bool unit = std::abs(glm::dot(*read, *read) - 1.0) < 1e-14;
  target = unit ? *read : glm::normalize(*read / largest);
}

void Reader::triple(std::string_view key, glm::dvec3& target, const Range& range, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr) {
    return;
  }
  const std::string needs = inWords(range) + ", or a list of three";
  if (value->kind == json::Kind::Number) {
    return within(range, value->number) ? void(target = glm::dvec3(value->number)) : reject(*value, key, needs);
  }
  if (value->kind != json::Kind::Array || value->items.size() != 3) {
    return reject(*value, key, needs);
  }
  const std::optional<glm::dvec3> read = three(*value, key);
  for (int i = 0; read && i < 3; ++i) {
    if (!within(range, (*read)[i])) {
      return reject(value->items[static_cast<std::size_t>(i)], fmt::format("{}.{}", key, i), inWords(range));
    }
  }
  target = read.value_or(target);
}

void Reader::pair(std::string_view key, glm::uvec2& target, const WholeRange& range, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr) {
    return;
  }
  const std::vector<json::Value>& items = value->items;
  if (items.size() != 2 || !isWhole(items[0], range) || !isWhole(items[1], range)) {
    return reject(*value, key,
                  fmt::format("two whole numbers from {} to {}, such as [640, 480]", range.min, range.max));
  }
  target = glm::uvec2(items[0].number, items[1].number);
}

} // namespace tyndall::scene

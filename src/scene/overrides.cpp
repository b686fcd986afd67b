// SPDX-License-Identifier: Apache-2.0
#include "scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace tyndall::scene {
namespace {

std::vector<std::string> splitPath(const std::string& path) {
  std::vector<std::string> keys(1);
  for (const char c : path) {
    if (c == '.') {
      keys.emplace_back();
    } else {
      keys.back() += c;
    }
  }
  return keys;
}

/// The number of the element that `key` means, by its number or its "name"; the list's length if there is none.
std::size_t elementNumber(const json::Value& list, const std::string& key) {
  std::size_t index = 0;
  const char* end = key.data() + key.size();
  const auto [last, error] = std::from_chars(key.data(), end, index);
  if (error == std::errc{} && last == end) {
    return std::min(index, list.items.size());
  }
  const auto found = std::find_if(list.items.begin(), list.items.end(), [&](const json::Value& item) {
    const json::Value* name = item.find("name");
    return name != nullptr && name->kind == json::Kind::String && name->text == key;
  });
  return static_cast<std::size_t>(found - list.items.begin());
}

/// "it has 0 (\"fog\"), 1".
std::string elements(const json::Value& list) {
  if (list.items.empty()) {
    return "the list is empty";
  }
  std::string text;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const json::Value* name = list.items[i].find("name");
    text += fmt::format("{}{}", i == 0 ? "there is " : ", ", i);
    text += name != nullptr && !name->text.empty() ? fmt::format(" ({})", json::inQuotes(name->text)) : "";
  }
  return text;
}

/// Walks a path from key to key and makes the objects on the way.
class Walk {
public:
  Walk(const json::Position& position, const std::string& about, Findings& findings)
      : position_(position), about_(about), findings_(findings) {}

  /// nullptr, and a finding, if there is no such place.
  json::Value* to(json::Value& root, const std::string& path) {
    json::Value* target = &root;
    for (const std::string& key : splitPath(path)) {
      target = step(*target, key);
      if (target == nullptr) {
        break;
      }
    }
    return target;
  }

private:
  void error(const std::string& message) { findings_.error(position_, about_, message); }

  json::Value* step(json::Value& value, const std::string& key) {
    if (key.empty()) {
      error("a path is keys joined by dots, such as film.size or lights.0.irradiance");
      return nullptr;
    }
    if (value.kind == json::Kind::Array) {
      const std::size_t number = elementNumber(value, key);
      if (number < value.items.size()) {
        return &value.items[number];
      }
      error(fmt::format("there is no element {}: {}", json::inQuotes(key), elements(value)));
      return nullptr;
    }
    if (value.kind == json::Kind::Null || value.kind == json::Kind::Object) {
      return memberOf(value, key);
    }
    error(fmt::format("{} has no keys: what stands before it is {}", json::inQuotes(key), json::inWords(value)));
    return nullptr;
  }

  /// The member `key`, made if it is not there.
  json::Value* memberOf(json::Value& object, const std::string& key) {
    if (object.kind == json::Kind::Null) {
      object.kind = json::Kind::Object;
      object.position = position_;
    }
    if (json::Value* found = object.find(key)) {
      return found;
    }
    object.members.push_back({.key = key, .position = position_, .value = {}});
    object.members.back().value.position = position_;
    return &object.members.back().value;
  }

  const json::Position& position_;
  const std::string& about_;
  Findings& findings_;
};

/// The value of an override. A bare word is text; so is what only begins like a number (a file name).
std::optional<json::Value> valueOf(const std::string& text, const json::Position& position, Findings& findings) {
  json::Parsed parsed = json::parse(text, position.override);
  if (parsed.complete && parsed.mistakes.empty()) {
    return std::move(parsed.root);
  }
  const std::size_t start = text.find_first_not_of(" \t");
  if (start != std::string::npos && std::string_view("[{\"'").find(text[start]) != std::string_view::npos) {
    findings.error(position, "", "the value cannot be read: " + parsed.mistakes.front().message);
    return std::nullopt;
  }
  json::Value value;
  value.kind = json::Kind::String;
  value.text = text;
  value.position = position;
  return value;
}

} // namespace

std::string inWords(const Override& override) { return fmt::format("--set {}={}", override.path, override.value); }

void assign(json::Value& root, const std::string& path, json::Value value, const json::Position& position,
            const std::string& about, Findings& findings) {
  if (json::Value* target = Walk(position, about, findings).to(root, path)) {
    *target = std::move(value);
  }
}

void applyOverrides(const std::vector<Override>& overrides, json::Value& root, Findings& findings) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const json::Position position{0, 0, static_cast<int>(i)};
    if (std::optional<json::Value> value = valueOf(overrides[i].value, position, findings)) {
      assign(root, overrides[i].path, std::move(*value), position, "", findings);
    }
  }
}

std::string numberedPath(const json::Value& root, const std::string& path) {
  std::string result;
  const json::Value* value = &root;
  for (std::string key : splitPath(path)) {
    if (value != nullptr && value->kind == json::Kind::Array) {
      const std::size_t number = elementNumber(*value, key);
      const bool found = number < value->items.size();
      key = found ? std::to_string(number) : key;
      value = found ? &value->items[number] : nullptr;
    } else if (value != nullptr) {
      value = value->find(key);
    }
    result += (result.empty() ? "" : ".") + key;
  }
  return result;
}

const json::Value* valueAt(const json::Value& root, const std::string& path) {
  const json::Value* value = &root;
  for (const std::string& key : splitPath(path)) {
    const std::size_t number = elementNumber(*value, key);
    value = number < value->items.size() ? &value->items[number] : value->find(key);
    if (value == nullptr) {
      break;
    }
  }
  return value;
}

} // namespace tyndall::scene

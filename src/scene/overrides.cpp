// SPDX-License-Identifier: Apache-2.0
#include "scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

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

/// The element that `key` means: its number, or its "name". nullptr if there is none.
json::Value* element(json::Value& list, const std::string& key) {
  std::size_t index = 0;
  const char* end = key.data() + key.size();
  const auto [last, error] = std::from_chars(key.data(), end, index);
  if (error == std::errc{} && last == end) {
    return index < list.items.size() ? &list.items[index] : nullptr;
  }
  const auto found = std::find_if(list.items.begin(), list.items.end(), [&](const json::Value& item) {
    const json::Value* name = item.find("name");
    return name != nullptr && name->kind == json::Kind::String && name->text == key;
  });
  return found == list.items.end() ? nullptr : &*found;
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

class Application {
public:
  Application(const Override& override, int number, Findings& findings)
      : override_(override), position_{0, 0, number}, findings_(findings) {}

  void run(json::Value& root) {
    json::Value value;
    if (!readValue(value)) {
      return;
    }
    json::Value* target = &root;
    for (const std::string& key : splitPath(override_.path)) {
      target = step(*target, key);
      if (target == nullptr) {
        return;
      }
    }
    *target = std::move(value);
  }

private:
  void error(const std::string& message) { findings_.error(position_, "", message); }

  /// A bare word is text; so is what only begins like a number (a file name).
  bool readValue(json::Value& value) {
    const std::string& text = override_.value;
    json::Parsed parsed = json::parse(text, position_.override);
    if (parsed.complete && parsed.mistakes.empty()) {
      value = std::move(parsed.root);
      return true;
    }
    const std::size_t start = text.find_first_not_of(" \t");
    if (start != std::string::npos && std::string_view("[{\"'").find(text[start]) != std::string_view::npos) {
      error("the value cannot be read: " + parsed.mistakes.front().message);
      return false;
    }
    value.kind = json::Kind::String;
    value.text = text;
    value.position = position_;
    return true;
  }

  json::Value* step(json::Value& value, const std::string& key) {
    if (key.empty()) {
      error("a path is keys joined by dots, such as film.size or lights.0.irradiance");
      return nullptr;
    }
    if (value.kind == json::Kind::Array) {
      json::Value* item = element(value, key);
      if (item == nullptr) {
        error(fmt::format("there is no element {}: {}", json::inQuotes(key), elements(value)));
      }
      return item;
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

  const Override& override_;
  json::Position position_;
  Findings& findings_;
};

} // namespace

std::string inWords(const Override& override) { return fmt::format("--set {}={}", override.path, override.value); }

void applyOverrides(const std::vector<Override>& overrides, json::Value& root, Findings& findings) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    Application(overrides[i], static_cast<int>(i), findings).run(root);
  }
}

} // namespace tyndall::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/bounds.h"
#include "scene/findings.h"
#include "scene/json.h"

#include <fmt/format.h>

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

namespace tyndall::scene {

/// Findings by key path, at the place where the value was written or the nearest object around it.
class CheckReport {
public:
  CheckReport(const json::Value& root, Findings& findings) : root_(root), findings_(findings) {}

  void error(const std::string& path, std::string message);
  void warning(const std::string& path, std::string message);

  bool errorIn(std::string_view path) const { return findings_.errorIn(path); }
  /// Whether one of these keys already has an error.
  bool wrong(const std::string& path, std::initializer_list<std::string_view> keys) const;

  /// Reports names that occur twice. `list` is the key path of `items`, which have a member `name`.
  template <class Items>
  void checkNames(const std::string& list, const Items& items) {
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto [entry, added] = first.emplace(items[i].name, i);
      if (!added && !items[i].name.empty()) {
        error(fmt::format("{}.{}.name", list, i),
              fmt::format("is also the name of {}.{}; rename one", list, entry->second));
      }
    }
  }
  void checkBox(const Bounds3& box, const std::string& path);

private:
  const json::Value& root_;
  Findings& findings_;
};

} // namespace tyndall::scene

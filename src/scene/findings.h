// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/json.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tyndall::scene {

/// A problem before its position is turned into file:line:column.
struct Finding {
  json::Position position;
  std::string path; ///< key path, "media.0.phase.g"; empty: the whole file
  std::string message;
  bool warning = false;
};

/// Collects what is wrong with a scene file.
class Findings {
public:
  /// After this many, the rest would only repeat itself.
  static constexpr std::size_t kMost = 200;

  void error(const json::Position& position, std::string path, std::string message) {
    add({position, std::move(path), std::move(message), false});
  }
  void warning(const json::Position& position, std::string path, std::string message) {
    add({position, std::move(path), std::move(message), true});
  }
  /// Adds to the message of the last finding.
  void amend(const std::string& text) { all_.back().message += text; }
  const std::vector<Finding>& all() const { return all_; }

  /// Whether an error concerns `path` or something inside it: later checks would only repeat it.
  bool errorIn(std::string_view path) const {
    for (const Finding& finding : all_) {
      const std::string_view found = finding.path;
      const bool inside =
          found.starts_with(path) && (found.size() == path.size() || path.empty() || found[path.size()] == '.');
      if (!finding.warning && (inside || found.empty())) {
        return true;
      }
    }
    return false;
  }

private:
  void add(Finding finding) {
    if (all_.size() == kMost) {
      finding = {finding.position, "", "too many problems; the rest is left out", false};
    }
    if (all_.size() <= kMost) {
      all_.push_back(std::move(finding));
    }
  }

  std::vector<Finding> all_;
};

} // namespace tyndall::scene

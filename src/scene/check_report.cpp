// SPDX-License-Identifier: Apache-2.0
#include "scene/check_report.h"

#include <algorithm>
#include <charconv>

namespace tyndall::scene {
namespace {

/// Where the value at `path` was written, or the nearest object around it.
json::Position locate(const json::Value& root, std::string_view path) {
  const json::Value* value = &root;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('.'), path.size());
    const std::string_view key = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));
    std::size_t index = 0;
    const bool number = std::from_chars(key.data(), key.data() + key.size(), index).ec == std::errc{};
    const json::Value* inner = number && index < value->items.size() ? &value->items[index] : value->find(key);
    if (inner == nullptr) {
      break;
    }
    value = inner;
  }
  return value->position;
}

} // namespace

void CheckReport::error(const std::string& path, std::string message) {
  findings_.error(locate(root_, path), path, std::move(message));
}

void CheckReport::warning(const std::string& path, std::string message) {
  findings_.warning(locate(root_, path), path, std::move(message));
}

bool CheckReport::wrong(const std::string& path, std::initializer_list<std::string_view> keys) const {
  return std::any_of(keys.begin(), keys.end(),
                     [&](std::string_view key) { return errorIn(fmt::format("{}.{}", path, key)); });
}

void CheckReport::checkBox(const Bounds3& box, const std::string& path) {
  if (wrong(path, {"min", "max"})) {
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.min[axis] < box.max[axis])) {
      error(path + ".max",
            fmt::format("must be above min in {}, but {} is not above {}", "xyz"[axis], box.max[axis], box.min[axis]));
    }
  }
}

} // namespace tyndall::scene

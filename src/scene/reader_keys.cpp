// SPDX-License-Identifier: Apache-2.0
// Which keys an object has, and which of them nothing asked for.
#include "base/error.h"
#include "scene/reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::scene {
namespace {

/// Already reported as text that cannot be read: nothing more is said about it.
bool malformed(const json::Value& value) {
  return value.kind == json::Kind::Invalid || std::any_of(value.items.begin(), value.items.end(), malformed);
}

} // namespace

Reader::Reader(const json::Value& object, std::string path, ReadContext& context)
    : object_(object), path_(std::move(path)), context_(context) {}

std::string Reader::pathOf(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

const json::Value* Reader::take(std::string_view key) {
  const bool required = std::exchange(required_, false);
  asked_.push_back({key, active_ ? Use::Read : Use::DoesNotApply, active_ ? "" : when_});
  if (!active_) {
    return nullptr;
  }
  const json::Value* value = object_.find(key);
  if (value == nullptr && required) {
    context_.findings.error(object_.position, pathOf(key),
                            fmt::format("is missing; add \"{}\" to the object that starts here", key));
  }
  return value != nullptr && !malformed(*value) ? value : nullptr;
}

bool Reader::isList(const json::Value& value, const std::string& path) {
  if (value.kind == json::Kind::Array) {
    return true;
  }
  context_.findings.error(value.position, path, fmt::format("must be a list, [ ... ], not {}", json::inWords(value)));
  return false;
}

bool Reader::isObject(const json::Value& value, const std::string& path) {
  if (value.kind == json::Kind::Object) {
    return true;
  }
  context_.findings.error(value.position, path,
                          fmt::format("must be an object, {{ ... }}, not {}", json::inWords(value)));
  return false;
}

void Reader::finish() {
  if (abandoned_) {
    return;
  }
  for (const json::Member& member : object_.members) {
    const bool read = std::any_of(asked_.begin(), asked_.end(), [&](const Asked& asked) {
      return asked.key == member.key && asked.use == Use::Read;
    });
    if (!read) {
      reportUnused(member);
    }
  }
}

void Reader::reportUnused(const json::Member& member) {
  std::vector<std::string> known;
  std::vector<std::string> conditions;
  for (const Asked& asked : asked_) {
    if (asked.key == member.key) {
      conditions.push_back(asked.when);
    } else if (asked.use == Use::Read) {
      known.emplace_back(asked.key);
    }
  }
  std::string message;
  if (!conditions.empty()) {
    message = fmt::format("has no meaning here, only with {}; remove it or change the type", joinNames(conditions));
  } else if (const std::string nearest = nearestName(member.key, known); !nearest.empty()) {
    message = fmt::format("is not a known key; did you mean \"{}\"?", nearest);
  } else {
    std::sort(known.begin(), known.end());
    message = fmt::format("is not a known key; here stand {}", joinNames(known));
  }
  context_.findings.error(member.position, pathOf(member.key), message);
}

void readRoot(const json::Value& root, ReadContext& context, Scene& scene) {
  if (root.kind != json::Kind::Object) {
    context.findings.error(root.position, "",
                           fmt::format("a scene must be an object, {{ ... }}, not {}", json::inWords(root)));
    return;
  }
  Reader reader(root, "", context);
  std::string schema;
  reader.text("$schema", schema, "for editors; not used");
  fields(reader, scene);
  reader.finish();
}

} // namespace tyndall::scene

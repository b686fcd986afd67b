// SPDX-License-Identifier: Apache-2.0
#include "scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tyndall::scene {
namespace {

constexpr double kLargestFrame = 1e9;

/// A number, or lists of such.
bool isNumeric(const json::Value& value) {
  return value.kind == json::Kind::Number || (value.kind == json::Kind::Array && !value.items.empty() &&
                                              std::all_of(value.items.begin(), value.items.end(), isNumeric));
}

/// Of numeric values.
bool sameShape(const json::Value& a, const json::Value& b) {
  return a.kind == b.kind && std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), sameShape);
}

} // namespace

void Reader::keys(std::string_view key, Track& track, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr || !isList(*value, pathOf(key))) {
    return;
  }
  if (value->items.empty()) {
    context_.findings.error(value->position, pathOf(key),
                            "has no key; give at least one, a frame and the value there, such as [1, 0.5]");
    return;
  }
  std::vector<Key> read;
  for (const json::Value& pair : value->items) {
    if (!isKey(pair, fmt::format("{}.{}", key, read.size()), read, track.interpolation)) {
      return;
    }
    read.push_back({pair.items[0].number, pair.items[1]});
  }
  track.keys = std::move(read);
}

bool Reader::isKey(const json::Value& pair, const std::string& key, const std::vector<Key>& before, Interpolation how) {
  const std::size_t findings = context_.findings.all().size();
  if (pair.kind != json::Kind::Array || pair.items.size() != 2) {
    reject(pair, key, "a frame and the value there, such as [24, 0.5]");
    return false;
  }
  const json::Value& frame = pair.items[0];
  const json::Value& value = pair.items[1];
  if (frame.kind != json::Kind::Number || std::abs(frame.number) > kLargestFrame) {
    reject(frame, key + ".0", "the number of a frame");
  } else if (!before.empty() && frame.number <= before.back().frame) {
    reject(frame, key + ".0", fmt::format("above {}, the frame of the key before it", before.back().frame));
    context_.findings.amend("; sort the keys by frame");
  } else if (how == Interpolation::Linear && !isNumeric(value)) {
    reject(value, key + ".1", "a number or a list of numbers, to be interpolated");
    context_.findings.amend("; for anything else write \"interpolation\": \"step\"");
  } else if (how == Interpolation::Linear && !before.empty() && !sameShape(before.front().value, value)) {
    reject(value, key + ".1", "of the shape of the first key's value, " + json::inWords(before.front().value));
  }
  return context_.findings.all().size() == findings;
}

} // namespace tyndall::scene

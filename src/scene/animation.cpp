// SPDX-License-Identifier: Apache-2.0
#include "scene/animation.h"

#include "scene/file_reference.h"
#include "scene/overrides.h"
#include "scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace tyndall::scene {
namespace fs = std::filesystem;
namespace {

/// Of numeric values of one shape.
json::Value mixed(const json::Value& a, const json::Value& b, double shareOfB) {
  json::Value result = a;
  if (a.kind == json::Kind::Number) {
    result.number = (1.0 - shareOfB) * a.number + shareOfB * b.number;
    result.text = fmt::format("{}", result.number);
  }
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    result.items[i] = mixed(a.items[i], b.items[i], shareOfB);
  }
  return result;
}

json::Value valueAtFrame(const Track& track, double frame) {
  const auto after = std::upper_bound(track.keys.begin(), track.keys.end(), frame,
                                      [](double wanted, const Key& key) { return wanted < key.frame; });
  if (after == track.keys.begin()) {
    return after->value;
  }
  const auto before = std::prev(after);
  if (after == track.keys.end() || track.interpolation == Interpolation::Step) {
    return before->value;
  }
  return mixed(before->value, after->value, (frame - before->frame) / (after->frame - before->frame));
}

/// Whether one of two paths leads to or through the other.
bool overlap(const std::string& a, const std::string& b) {
  const auto leadsTo = [](const std::string& outer, const std::string& inner) {
    return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '.');
  };
  return leadsTo(a, b) || leadsTo(b, a);
}

/// The path of the camera, medium or object that a target belongs to; empty if to none of these.
std::string elementOf(const std::string& target) {
  const std::size_t first = std::min(target.find('.'), target.size());
  const std::string section = target.substr(0, first);
  if (section == "camera") {
    return section;
  }
  return section == "media" || section == "objects" ? target.substr(0, target.find('.', first + 1)) : "";
}

class Animator {
public:
  Animator(json::Value& root, const std::vector<Override>& overrides, const fs::path& folder, Findings& findings)
      : root_(root), document_(root), overrides_(overrides), folder_(folder), findings_(findings) {}

  Animation run(double frame) {
    Findings reportedLater;
    ReadContext context{.findings = reportedLater, .folder = folder_};
    Animation read;
    Reader(document_, "", context).object("animation", read, "");
    animation_.framesPerSecond = read.framesPerSecond;
    for (std::size_t i = 0; i < read.tracks.size(); ++i) {
      const std::string path = fmt::format("animation.tracks.{}", i);
      const bool unread = read.tracks[i].keys.empty(); // text that is no JSON was reported when it was parsed
      if (!unread && !reportedLater.errorIn(path)) {
        apply(read.tracks[i], path + ".target", frame);
      }
    }
    return std::move(animation_);
  }

private:
  void apply(Track& track, const std::string& about, double frame) {
    const json::Position position = valueAt(document_, about)->position;
    const std::string target = numberedPath(document_, track.target);
    if (overlap(target, "animation")) {
      return findings_.error(position, about, "is part of the animation itself; name what is to move");
    }
    if (isOverruled(target)) {
      return;
    }
    const auto [other, isNew] = targets_.try_emplace(target, about);
    if (!isNew) {
      return findings_.error(position, about, fmt::format("is that of {} too; join their keys", other->second));
    }
    assign(root_, track.target, valueAtFrame(track, frame), position, about, findings_);
    keep(track, target);
  }

  bool isOverruled(const std::string& target) const {
    return std::any_of(overrides_.begin(), overrides_.end(), [&](const Override& override) {
      return overlap(numberedPath(document_, override.path), target);
    });
  }

  void keep(Track& track, const std::string& target) {
    for (Key& key : track.keys) {
      resolveNames(key.value, track.movesFileName());
    }
    animation_.tracks.push_back(std::move(track));
    const std::string element = elementOf(target);
    const json::Value* value = element.empty() ? nullptr : valueAt(document_, element);
    if (value != nullptr) {
      animation_.elements.push_back({element, *value});
      resolveNames(animation_.elements.back().value, false);
    }
  }

  void resolveNames(json::Value& value, bool isName) const {
    mapFileNames(value, isName, [this](const json::Value& name) {
      return resolveFile(name.text, name.position.override >= 0 ? fs::path{} : folder_).path.string();
    });
  }

  json::Value& root_;
  const json::Value document_; ///< without the tracks' changes
  const std::vector<Override>& overrides_;
  const fs::path& folder_;
  Findings& findings_;
  Animation animation_;
  std::map<std::string, std::string> targets_; ///< and which track has them
};

} // namespace

Animation animate(json::Value& root, const std::vector<Override>& overrides, double frame, const fs::path& folder,
                  Findings& findings) {
  const bool none = root.find("animation") == nullptr;
  Animation animation = none ? Animation{} : Animator(root, overrides, folder, findings).run(frame);
  animation.seconds = frame / animation.framesPerSecond;
  return animation;
}

std::vector<double> keyFrames(const Animation& animation) {
  std::vector<double> frames;
  for (const Track& track : animation.tracks) {
    std::transform(track.keys.begin(), track.keys.end(), std::back_inserter(frames),
                   [](const Key& key) { return key.frame; });
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

} // namespace tyndall::scene

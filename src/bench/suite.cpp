// SPDX-License-Identifier: Apache-2.0
#include "bench/suite.h"

#include "base/error.h"
#include "base/file.h"
#include "scene/json.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

namespace json = scene::json;
using json::Kind;
using json::Value;

constexpr const char* kSuiteFolder = "scenes/bench";
constexpr const char* kSuiteEnding = ".suite.json";
constexpr double kMostSamples = 1 << 24;
constexpr double kMostPixels = 1 << 14; ///< along an edge

class SuiteReader {
public:
  explicit SuiteReader(const std::filesystem::path& file) : file_(file) {}

  Suite read() {
    const json::Parsed parsed = json::parse(readTextFile(file_));
    if (!parsed.mistakes.empty()) {
      complain(parsed.mistakes.front().position, parsed.mistakes.front().message);
    }
    const Value& root = parsed.root;
    knownKeys(root, {"title", "contenders", "scenes"});
    Suite suite;
    suite.name = file_.filename().string();
    suite.name = suite.name.substr(0, suite.name.find('.'));
    suite.title = text(member(root, "title"));
    if (const Value* contenders = root.find("contenders"); contenders != nullptr) {
      wanted(*contenders, Kind::Object, "an object: name of a contender to arguments");
      for (const json::Member& entry : contenders->members) {
        suite.contenders[entry.key] = texts(entry.value);
      }
    }
    const Value& scenes = member(root, "scenes");
    wanted(scenes, Kind::Array, "a list of scenes");
    for (const Value& item : scenes.items) {
      suite.scenes.push_back(scene(item, suite));
    }
    if (suite.scenes.empty()) {
      complain(scenes.position, "there is no scene; a suite needs one");
    }
    return suite;
  }

private:
  SuiteScene scene(const Value& item, const Suite& suite) {
    knownKeys(item, {"name", "title", "file", "size", "samples", "arguments", "contenders"});
    SuiteScene scene;
    scene.name = text(member(item, "name"));
    if (std::ranges::any_of(suite.scenes, [&](const SuiteScene& other) { return other.name == scene.name; })) {
      complain(member(item, "name").position, fmt::format("a second scene has the name \"{}\"", scene.name));
    }
    scene.title = text(member(item, "title"));
    const Value& file = member(item, "file");
    scene.file = file_.parent_path() / text(file);
    if (!std::filesystem::exists(scene.file)) {
      complain(file.position, fmt::format("{} is not there; names are relative to this file", scene.file.string()));
    }
    const std::vector<std::uint32_t> size = counts(member(item, "size"), kMostPixels);
    if (size.size() != 2) {
      complain(member(item, "size").position, "\"size\" must be [width, height]");
    }
    scene.size = {size[0], size[1]};
    scene.samples = counts(member(item, "samples"), kMostSamples);
    if (!std::ranges::is_sorted(scene.samples, std::less_equal<>())) {
      complain(member(item, "samples").position, "\"samples\" must rise");
    }
    if (const Value* arguments = item.find("arguments"); arguments != nullptr) {
      scene.arguments = texts(*arguments);
    }
    if (const Value* contenders = item.find("contenders"); contenders != nullptr) {
      scene.contenders = known(*contenders, suite);
    }
    return scene;
  }

  std::vector<std::string> known(const Value& list, const Suite& suite) {
    const std::vector<std::string> names = texts(list);
    std::vector<std::string> all;
    for (const auto& [name, arguments] : suite.contenders) {
      all.push_back(name);
    }
    for (const std::string& name : names) {
      if (std::ranges::find(all, name) == all.end()) {
        complain(list.position, fmt::format("no contender is called \"{}\"; there are {}", name, joinNames(all)));
      }
    }
    return names;
  }

  [[noreturn]] void complain(const json::Position& position, const std::string& message) {
    throw Error(SourceLocation{file_.string(), position.line, position.column}, message);
  }

  void wanted(const Value& value, Kind kind, const char* what) {
    if (value.kind != kind) {
      complain(value.position, fmt::format("here must be {}, not {}", what, json::inWords(value)));
    }
  }

  void knownKeys(const Value& object, const std::vector<std::string>& keys) {
    wanted(object, Kind::Object, "an object");
    for (const json::Member& entry : object.members) {
      if (std::ranges::find(keys, entry.key) == keys.end()) {
        complain(entry.position, fmt::format("\"{}\" is not known; there are {}", entry.key, joinNames(keys)));
      }
    }
  }

  const Value& member(const Value& object, const char* key) {
    const Value* value = object.find(key);
    if (value == nullptr) {
      complain(object.position, fmt::format("\"{}\" is missing", key));
    }
    return *value;
  }

  std::string text(const Value& value) {
    wanted(value, Kind::String, "a text");
    return value.text;
  }

  std::vector<std::string> texts(const Value& value) {
    wanted(value, Kind::Array, "a list of texts");
    std::vector<std::string> result;
    std::ranges::transform(value.items, std::back_inserter(result), [this](const Value& item) { return text(item); });
    return result;
  }

  /// One or more whole numbers from 1 to `most`.
  std::vector<std::uint32_t> counts(const Value& value, double most) {
    wanted(value, Kind::Array, "a list of whole numbers");
    std::vector<std::uint32_t> result;
    for (const Value& item : value.items) {
      wanted(item, Kind::Number, "a whole number");
      if (item.number != std::floor(item.number) || item.number < 1.0 || item.number > most) {
        complain(item.position, fmt::format("here must be a whole number from 1 to {}, not {}", most, item.text));
      }
      result.push_back(static_cast<std::uint32_t>(item.number));
    }
    if (result.empty()) {
      complain(value.position, "the list is empty; it needs a number");
    }
    return result;
  }

  std::filesystem::path file_;
};

std::vector<std::string> shippedSuites(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(kSuiteEnding)) {
      names.push_back(name.substr(0, name.size() - std::string_view(kSuiteEnding).size()));
    }
  }
  std::ranges::sort(names);
  return names;
}

} // namespace

Suite loadSuite(const std::filesystem::path& file) { return SuiteReader(file).read(); }

std::filesystem::path findShipped(const std::filesystem::path& relative) {
  std::error_code ignored;
  for (std::filesystem::path start :
       {std::filesystem::canonical("/proc/self/exe", ignored).parent_path(), std::filesystem::current_path(ignored)}) {
    for (; !start.empty(); start = start.parent_path()) {
      if (std::filesystem::exists(start / relative, ignored)) {
        return start / relative;
      }
      if (start == start.root_path()) {
        break;
      }
    }
  }
  return {};
}

std::filesystem::path findSuite(const std::string& nameOrPath) {
  if (nameOrPath.ends_with(".json")) {
    return nameOrPath;
  }
  const std::filesystem::path folder = findShipped(kSuiteFolder);
  if (folder.empty()) {
    fail("{}: no folder {} lies above the program or the working folder; name a suite's file", nameOrPath,
         kSuiteFolder);
  }
  const std::vector<std::string> names = shippedSuites(folder);
  if (std::ranges::find(names, nameOrPath) == names.end()) {
    const std::string nearest = nearestName(nameOrPath, names);
    fail("no suite is called \"{}\"{}; there are {}, or name a .json file", nameOrPath,
         nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest), joinNames(names));
  }
  return folder / (nameOrPath + kSuiteEnding);
}

} // namespace tyndall::bench

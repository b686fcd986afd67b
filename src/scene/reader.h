// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/fields.h"
#include "scene/findings.h"
#include "scene/json.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::scene {

/// What reading needs beside the tree.
struct ReadContext {
  Findings& findings;
  std::filesystem::path
      folder; ///< file references in the text are relative to it, those of --set to the working folder
};

/// The visitor of fields.h that fills one object from JSON and reports what does not fit. A value that does not fit
/// leaves its target as it was.
class Reader {
public:
  Reader(const json::Value& object, std::string path, ReadContext& context);

  Reader& required() {
    required_ = true;
    return *this;
  }
  void applies(bool active, std::string when) {
    active_ = active;
    when_ = std::move(when);
  }
  void always() { active_ = true; }

  template <class Enum>
  bool type(Enum& target, Names<Enum> names, std::string_view help) {
    required_ = true;
    const std::size_t before = context_.findings.all().size();
    choice("type", target, names, help);
    abandoned_ = context_.findings.all().size() > before;
    return !abandoned_;
  }
  template <class Enum>
  void choice(std::string_view key, Enum& target, Names<Enum> names, std::string_view) {
    std::vector<std::string_view> words;
    for (const auto& name : names) {
      words.push_back(name.first);
    }
    if (const std::optional<std::size_t> index = chosen(key, words)) {
      target = names[*index].second;
    }
  }
  void word(std::string_view key, std::string& target, std::span<const std::string_view> words, std::string_view);
  void text(std::string_view key, std::string& target, std::string_view);
  void file(std::string_view key, std::string& target, std::string_view);
  void number(std::string_view key, double& target, const Range& range, std::string_view);
  void whole(std::string_view key, std::uint32_t& target, const WholeRange& range, std::string_view);
  void whole(std::string_view key, std::optional<std::uint32_t>& target, const WholeRange& range,
             std::string_view help);
  void flag(std::string_view key, bool& target, std::string_view);
  void point(std::string_view key, glm::dvec3& target, std::string_view);
  void direction(std::string_view key, glm::dvec3& target, std::string_view);
  void triple(std::string_view key, glm::dvec3& target, const Range& range, std::string_view);
  void pair(std::string_view key, glm::uvec2& target, const WholeRange& range, std::string_view);
  void matrix(std::string_view key, glm::dmat4& target, std::string_view);
  void transform(std::string_view key, glm::dmat4& targetFromSource, std::string_view);
  void transforms(std::string_view key, std::vector<glm::dmat4>& targetFromSource, std::string_view);

  void keys(std::string_view key, Track& track, std::string_view);

  template <class T>
  void object(std::string_view key, T& target, std::string_view) {
    if (const json::Value* value = take(key)) {
      readObject(*value, pathOf(key), target);
    }
  }
  template <class T, class AsView = std::identity>
  void optional(std::string_view key, std::optional<T>& target, std::string_view, AsView asView = {}) {
    const json::Value* value = take(key);
    if (value == nullptr || value->kind == json::Kind::Null) {
      return;
    }
    auto&& view = asView(target.emplace());
    readObject(*value, pathOf(key), view);
  }
  template <class T>
  void list(std::string_view key, std::vector<T>& target, std::string_view) {
    const json::Value* value = take(key);
    if (value == nullptr || !isList(*value, pathOf(key))) {
      return;
    }
    target.assign(value->items.size(), T{});
    for (std::size_t i = 0; i < target.size(); ++i) {
      readObject(value->items[i], pathOf(key) + '.' + std::to_string(i), target[i]);
    }
  }

  /// Reports the keys that nothing asked for. Call it last.
  void finish();

private:
  enum class Use { Read, DoesNotApply };
  struct Asked {
    std::string_view key;
    Use use;
    std::string when;
  };

  /// The value of a key that applies, nullptr if there is none; reports a required one that is missing.
  const json::Value* take(std::string_view key);
  std::string pathOf(std::string_view key) const;
  void reject(const json::Value& value, std::string_view key, const std::string& needs);
  std::optional<std::size_t> chosen(std::string_view key, std::span<const std::string_view> words);
  std::optional<glm::dvec3> three(const json::Value& value, std::string_view key);
  /// Whether the pair can follow the keys read so far; reports why not.
  bool isKey(const json::Value& pair, const std::string& key, const std::vector<Key>& before, Interpolation how);
  /// The product of a list of steps, the first one applied first; reports what is wrong with them.
  glm::dmat4 composed(const json::Value& steps, const std::string& path);
  bool isList(const json::Value& value, const std::string& path);
  bool isObject(const json::Value& value, const std::string& path);
  void reportUnused(const json::Member& member);

  template <class T>
  void readObject(const json::Value& value, std::string path, T& target) {
    if (!isObject(value, path)) {
      return;
    }
    Reader reader(value, std::move(path), context_);
    fields(reader, target);
    reader.finish();
  }

  const json::Value& object_;
  std::string path_;
  ReadContext& context_;
  std::vector<Asked> asked_;
  std::string when_;
  bool active_ = true;
  bool required_ = false;
  bool abandoned_ = false;
};

/// Fills `scene` from the root value.
void readRoot(const json::Value& root, ReadContext& context, Scene& scene);

/// "a number from 0 to 1", with the unit.
std::string inWords(const Range& range);

} // namespace tyndall::scene

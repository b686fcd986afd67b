// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/fields.h"
#include "scene/json.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace tyndall::scene {

/// The visitor of fields.h that writes one object with every key that applies.
class Writer {
public:
  struct Target {
    std::string& out;
    std::optional<std::filesystem::path> folder;     ///< file names are written relative to it; nullopt: as they are
    const std::vector<Animation::Element>& elements; ///< written as they are
  };
  /// `path`: of the object in the scene.
  Writer(const Target& target, std::size_t indent, std::string path);

  Writer& required() { return *this; }
  void applies(bool active, const std::string&) { active_ = active; }
  void always() { active_ = true; }

  template <class Enum>
  bool type(Enum& target, Names<Enum> names, std::string_view help) {
    choice("type", target, names, help);
    return true;
  }
  template <class Enum>
  void choice(std::string_view key, Enum& target, Names<Enum> names, std::string_view) {
    for (const auto& [word, value] : names) {
      if (value == target) {
        put(key, json::inQuotes(word));
      }
    }
  }
  void word(std::string_view key, std::string& target, std::span<const std::string_view>, std::string_view) {
    put(key, json::inQuotes(target));
  }
  void text(std::string_view key, std::string& target, std::string_view) { put(key, json::inQuotes(target)); }
  void file(std::string_view key, std::string& target, std::string_view);
  void number(std::string_view key, double& target, const Range&, std::string_view);
  void whole(std::string_view key, std::uint32_t& target, const WholeRange&, std::string_view);
  void whole(std::string_view key, std::optional<std::uint32_t>& target, const WholeRange&, std::string_view);
  void flag(std::string_view key, bool& target, std::string_view) { put(key, target ? "true" : "false"); }
  void point(std::string_view key, glm::dvec3& target, std::string_view);
  void direction(std::string_view key, glm::dvec3& target, std::string_view help) { point(key, target, help); }
  void triple(std::string_view key, glm::dvec3& target, const Range&, std::string_view help) {
    point(key, target, help);
  }
  void pair(std::string_view key, glm::uvec2& target, const WholeRange&, std::string_view);
  void matrix(std::string_view key, glm::dmat4& target, std::string_view);
  void transform(std::string_view key, glm::dmat4& targetFromSource, std::string_view);
  void transforms(std::string_view key, std::vector<glm::dmat4>& targetFromSource, std::string_view);

  void keys(std::string_view key, Track& track, std::string_view);

  template <class T>
  void object(std::string_view key, T& target, std::string_view) {
    if (active_) {
      put(key, "");
      writeObject(target, indent_ + 2, pathOf(key));
    }
  }
  template <class T, class AsView = std::identity>
  void optional(std::string_view key, std::optional<T>& target, std::string_view help, AsView asView = {}) {
    if (!target) {
      return put(key, "null");
    }
    auto&& view = asView(*target);
    object(key, view, help);
  }
  template <class T>
  void list(std::string_view key, std::vector<T>& target, std::string_view) {
    put(key, "[");
    for (T& item : target) {
      out_ += &item == target.data() ? "\n" : ",\n";
      out_.append(indent_ + 4, ' ');
      writeObject(item, indent_ + 4, pathOf(key) + '.' + std::to_string(&item - target.data()));
    }
    out_ += target.empty() ? "]" : "\n" + std::string(indent_ + 2, ' ') + "]";
  }

  void finish();

private:
  /// Writes "key": value if the key applies.
  void put(std::string_view key, const std::string& value);
  std::string pathOf(std::string_view key) const;
  /// A value of the file, with its names as `folder` wants them.
  std::string written(json::Value value, bool isName) const;
  /// Writes what is to be written as it is; false if the object at `path` is not.
  bool writeElement(const std::string& path);
  template <class T>
  void writeObject(T& target, std::size_t indent, const std::string& path) {
    if (writeElement(path)) {
      return;
    }
    Writer writer(target_, indent, path);
    fields(writer, target);
    writer.finish();
  }

  const Target& target_;
  std::string& out_;
  std::size_t indent_;
  std::string path_;
  bool active_ = true;
  bool empty_ = true;
};

} // namespace tyndall::scene

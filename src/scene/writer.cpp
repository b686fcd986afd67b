// SPDX-License-Identifier: Apache-2.0
#include "scene/writer.h"

#include "scene/file_reference.h"
#include "scene/load.h"

#include <fmt/format.h>

namespace tyndall::scene {
namespace {

/// The shortest text that reads back to the same double; -0 becomes 0.
std::string shortest(double number) { return fmt::format("{}", number == 0.0 ? 0.0 : number); }

std::string matrixText(const glm::dmat4& matrix) {
  std::string text = "[";
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      text += (row + column == 0 ? "" : ", ") + shortest(matrix[column][row]);
    }
  }
  return text + "]";
}

std::string transformText(const glm::dmat4& targetFromSource) {
  const bool identity = targetFromSource == glm::dmat4(1.0);
  return identity ? "[]" : "[{\"matrix\": " + matrixText(targetFromSource) + "}]";
}

} // namespace

Writer::Writer(const Target& target, std::size_t indent, std::string path)
    : target_(target), out_(target.out), indent_(indent), path_(std::move(path)) {
  out_ += '{';
}

std::string Writer::pathOf(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void Writer::put(std::string_view key, const std::string& value) {
  if (!active_) {
    return;
  }
  out_ += empty_ ? "\n" : ",\n";
  out_.append(indent_ + 2, ' ');
  out_ += json::inQuotes(key) + ": " + value;
  empty_ = false;
}

void Writer::file(std::string_view key, std::string& target, std::string_view) {
  if (active_) {
    put(key, json::inQuotes(target_.folder ? relativeName(target, *target_.folder) : target));
  }
}

void Writer::number(std::string_view key, double& target, const Range&, std::string_view) {
  put(key, shortest(target));
}

void Writer::whole(std::string_view key, std::uint32_t& target, const WholeRange&, std::string_view) {
  put(key, fmt::format("{}", target));
}

void Writer::whole(std::string_view key, std::optional<std::uint32_t>& target, const WholeRange&, std::string_view) {
  put(key, target ? fmt::format("{}", *target) : "null");
}

void Writer::point(std::string_view key, glm::dvec3& target, std::string_view) {
  put(key, fmt::format("[{}, {}, {}]", shortest(target.x), shortest(target.y), shortest(target.z)));
}

void Writer::pair(std::string_view key, glm::uvec2& target, const WholeRange&, std::string_view) {
  put(key, fmt::format("[{}, {}]", target.x, target.y));
}

void Writer::matrix(std::string_view key, glm::dmat4& target, std::string_view) { put(key, matrixText(target)); }

void Writer::transform(std::string_view key, glm::dmat4& targetFromSource, std::string_view) {
  put(key, transformText(targetFromSource));
}

void Writer::transforms(std::string_view key, std::vector<glm::dmat4>& targetFromSource, std::string_view) {
  std::string text = "[";
  for (const glm::dmat4& matrix : targetFromSource) {
    text += &matrix == targetFromSource.data() ? "\n" : ",\n";
    text += std::string(indent_ + 4, ' ') + transformText(matrix);
  }
  put(key, text + (targetFromSource.empty() ? "]" : "\n" + std::string(indent_ + 2, ' ') + "]"));
}

std::string Writer::written(json::Value value, bool isName) const {
  if (target_.folder) {
    mapFileNames(value, isName, [this](const json::Value& name) { return relativeName(name.text, *target_.folder); });
  }
  return json::toText(value);
}

bool Writer::writeElement(const std::string& path) {
  for (const Animation::Element& element : target_.elements) {
    if (element.path == path) {
      out_ += written(element.value, false);
      return true;
    }
  }
  return false;
}

void Writer::keys(std::string_view key, Track& track, std::string_view) {
  std::string text = "[";
  for (const Key& each : track.keys) {
    text += fmt::format("{}[{}, {}]", text.size() > 1 ? ", " : "", shortest(each.frame),
                        written(each.value, track.movesFileName()));
  }
  put(key, text + "]");
}

void Writer::finish() { out_ += empty_ ? "}" : "\n" + std::string(indent_, ' ') + "}"; }

std::string toJson(const Scene& scene, const std::filesystem::path& folder) {
  std::string text;
  Scene visited = scene; // visitors take their targets by reference
  const Writer::Target target{text, folder.empty() ? std::nullopt : std::optional(folder), scene.animation.elements};
  Writer writer(target, 0, "");
  fields(writer, visited);
  writer.finish();
  return text + '\n';
}

} // namespace tyndall::scene

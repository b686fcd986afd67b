// SPDX-License-Identifier: Apache-2.0
#include "app/reference_check.h"

#include "app/frames.h"
#include "base/file.h"
#include "film/exr.h"
#include "geometry/model.h"
#include "scene/file_reference.h"
#include "scene/json.h"
#include "volume/load.h"

#include <cmath>
#include <map>
#include <set>

namespace tyndall::app {
namespace {

namespace json = scene::json;
using volume::FileInfo;
using volume::GridInfo;

/// The member if it is a string, else null.
const json::Value* text(const json::Value& object, std::string_view key) {
  const json::Value* value = object.find(key);
  return value != nullptr && value->kind == json::Kind::String ? value : nullptr;
}

class ReferenceCheck {
public:
  explicit ReferenceCheck(const std::filesystem::path& file) : file_(file) {}

  std::vector<scene::Problem> run() {
    const json::Parsed parsed = json::parse(readTextFile(file_));
    forEach(parsed.root, "media", [this](const json::Value& medium) { checkMedium(medium); });
    forEach(parsed.root, "lights", [this](const json::Value& light) { checkLight(light); });
    forEach(parsed.root, "objects", [this](const json::Value& object) { checkMesh(object); });
    return std::move(problems_);
  }

private:
  template <class Work>
  void forEach(const json::Value& root, std::string_view key, const Work& work) {
    const json::Value* list = root.find(key);
    if (list == nullptr || list->kind != json::Kind::Array) {
      return;
    }
    for (const json::Value& item : list->items) {
      current_ = fmt::format("{}.{}", key, &item - list->items.data());
      if (item.kind == json::Kind::Object) {
        work(item);
      }
    }
  }

  void report(const json::Value& at, const std::string& key, const std::string& message, bool warning = false) {
    problems_.push_back({{file_.string(), at.position.line, at.position.column},
                         fmt::format("{}.{}: {}", current_, key, message),
                         warning});
  }

  /// The file that a value names; empty if it is not there.
  std::string present(const json::Value& name) const {
    const scene::FileReference reference = scene::resolveFile(name.text, file_.parent_path());
    return reference.problem.empty() ? reference.path.string() : "";
  }

  void checkMedium(const json::Value& medium) {
    const json::Value* name = text(medium, "file");
    const std::string path = name == nullptr ? "" : present(*name);
    const FileInfo* info = path.empty() ? nullptr : inspected(*name, path);
    if (info == nullptr) {
      return;
    }
    const json::Value* grid = text(medium, "grid");
    if (grid == nullptr || grid->text.empty()) {
      checkChoice(*name, *info);
    } else if (grid->text != "none") {
      checkGrid(*grid, "grid", *info);
    }
    const json::Value* emission = medium.find("emission");
    if (const json::Value* glow = emission == nullptr ? nullptr : text(*emission, "grid")) {
      checkGrid(*glow, "emission.grid", *info);
    }
  }

  /// Null, and a problem, if the volume cannot be read.
  const FileInfo* inspected(const json::Value& name, const std::string& path) {
    try {
      const std::string file = firstFile(path).string();
      const auto known = volumes_.find(file);
      return known != volumes_.end() ? &known->second
                                     : &volumes_.emplace(file, volume::inspectFile(file)).first->second;
    } catch (const Error& error) {
      report(name, "file", error.what());
      return nullptr;
    }
  }

  void checkChoice(const json::Value& name, const FileInfo& info) {
    try {
      const volume::GridChoice choice = volume::chooseGrids(info);
      if (choice.density.empty()) {
        report(name, "file", choice.reason + "; name one with \"grid\", or write \"grid\": \"none\" for emission only");
      } else {
        checkGrid(name, "file", info, choice.density);
      }
    } catch (const Error& error) {
      report(name, "file", error.what());
    }
  }

  void checkGrid(const json::Value& at, const std::string& key, const FileInfo& info) {
    checkGrid(at, key, info, at.text);
  }

  void checkGrid(const json::Value& at, const std::string& key, const FileInfo& info, const std::string& wanted) {
    std::vector<std::string> names;
    for (const GridInfo& grid : info.grids) {
      if (grid.name == wanted) {
        checkUsable(at, key, info, grid);
        return;
      }
      names.push_back("\"" + grid.name + "\"");
    }
    const std::string nearest = nearestName("\"" + wanted + "\"", names);
    report(at, key,
           fmt::format("{} has no grid \"{}\"{}; it has {}", info.path, wanted,
                       nearest.empty() ? "" : "; did you mean " + nearest + "?",
                       names.empty() ? "none" : joinNames(names)));
  }

  void checkUsable(const json::Value& at, const std::string& key, const FileInfo& info, const GridInfo& grid) {
    if (!grid.scalar) {
      report(at, key,
             fmt::format("grid \"{}\" of {} cannot be rendered: {}; name a scalar grid", grid.name, info.path,
                         grid.whyNot));
    } else if (grid.empty()) {
      report(at, key, fmt::format("grid \"{}\" of {} is empty and adds nothing to the picture", grid.name, info.path),
             true);
    }
  }

  void checkMesh(const json::Value& object) {
    const json::Value* name = text(object, "file");
    const std::string path = name == nullptr ? "" : present(*name);
    if (path.empty() || !meshes_.insert(path).second) {
      return;
    }
    try {
      for (const std::string& warning : geometry::loadModel(path).warnings) {
        report(*name, "file", fmt::format("{}: {}", path, warning), true);
      }
    } catch (const Error& error) {
      report(*name, "file", error.what());
    }
  }

  void checkLight(const json::Value& light) {
    const json::Value* name = text(light, "file");
    const std::string path = name == nullptr ? "" : present(*name);
    if (path.empty()) {
      return;
    }
    try {
      checkMap(*name, path);
    } catch (const Error& error) {
      report(*name, "file", error.what());
    }
  }

  void checkMap(const json::Value& name, const std::string& path) {
    const film::Image image = film::readExr(path);
    std::size_t bad = 0;
    double sum = 0.0;
    for (const std::vector<float>* channel : film::colourChannels(image, path)) {
      for (const float value : *channel) {
        const bool sound = std::isfinite(value) && value >= 0.0f;
        bad += sound ? 0 : 1;
        sum += sound ? double(value) : 0.0;
      }
    }
    if (bad > 0) {
      report(name, "file", fmt::format("{}: {} channel values are negative or not finite and count as 0", path, bad),
             true);
    }
    if (sum == 0.0) {
      report(name, "file", fmt::format("{}: is black, so this light gives no light", path), true);
    }
  }

  std::filesystem::path file_;
  std::string current_; ///< key path of the element being checked, "media.0"
  std::map<std::string, FileInfo> volumes_;
  std::set<std::string> meshes_; ///< looked at already
  std::vector<scene::Problem> problems_;
};

} // namespace

std::vector<scene::Problem> checkReferences(const std::filesystem::path& sceneFile) {
  return ReferenceCheck(sceneFile).run();
}

} // namespace tyndall::app

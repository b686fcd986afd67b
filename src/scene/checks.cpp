// SPDX-License-Identifier: Apache-2.0
#include "scene/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <map>

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

class Checker {
public:
  Checker(const Scene& scene, const json::Value& root, Findings& findings)
      : scene_(scene), root_(root), findings_(findings) {}

  void run() {
    checkCamera();
    checkDepth();
    checkNames("media", scene_.media);
    checkNames("lights", scene_.lights);
    for (std::size_t i = 0; i < scene_.media.size(); ++i) {
      checkMedium(scene_.media[i], fmt::format("media.{}", i));
    }
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      checkLight(scene_.lights[i].light, fmt::format("lights.{}", i));
    }
    checkSomethingToSee();
  }

private:
  void error(const std::string& path, std::string message) {
    findings_.error(locate(root_, path), path, std::move(message));
  }
  void warning(const std::string& path, std::string message) {
    findings_.warning(locate(root_, path), path, std::move(message));
  }

  /// Whether one of these keys already has an error.
  bool wrong(const std::string& path, std::initializer_list<std::string_view> keys) const {
    return std::any_of(keys.begin(), keys.end(),
                       [&](std::string_view key) { return findings_.errorIn(fmt::format("{}.{}", path, key)); });
  }

  void checkCamera() {
    const Camera& camera = scene_.camera;
    if (wrong("camera", {"position", "target", "up"})) {
      return;
    }
    if (camera.target == camera.position) {
      return error("camera.target", "is the point where the camera stands; move one of them, so that there is a "
                                    "direction to look in");
    }
    const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
    if (glm::length(glm::cross(forward, camera.up)) < 1e-6) {
      error("camera.up", "is parallel to the direction of view; choose another, such as [0, 0, 1] for a camera that "
                         "looks straight up or down");
    }
  }

  void checkDepth() {
    if (!findings_.errorIn("render.depth") && scene_.render.depth != 1) {
      error("render.depth",
            fmt::format("is {}, but this version renders one scattering event; set it to 1", scene_.render.depth));
    }
  }

  template <class Items>
  void checkNames(const std::string& list, const Items& items) {
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto [entry, added] = first.emplace(items[i].name, i);
      if (!added && !items[i].name.empty()) {
        error(fmt::format("{}.{}.name", list, i),
              fmt::format("is also the name of {}.{}; rename one", list, entry->second));
      }
    }
  }

  void checkBox(const Bounds3& box, const std::string& path) {
    if (wrong(path, {"min", "max"})) {
      return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (!(box.min[axis] < box.max[axis])) {
        error(path + ".max", fmt::format("must be above min in {}, but {} is not above {}", "xyz"[axis], box.max[axis],
                                         box.min[axis]));
      }
    }
  }

  void checkMedium(const Medium& medium, const std::string& path) {
    if (medium.homogeneous() && medium.shape == MediumShape::Box) {
      checkBox(medium.box, path + ".shape");
    }
    if (medium.clip) {
      checkBox(*medium.clip, path + ".clip");
    }
    if (wrong(path, {"type", "file", "shape.type", "extinction", "emission"})) {
      return;
    }
    if (medium.grid == "none" && !medium.emission) {
      warning(path + ".grid", "is \"none\" and there is no emission, so that nothing of this medium is seen; name a "
                              "grid or add \"emission\"");
    }
    const bool unbounded = medium.homogeneous() && medium.shape == MediumShape::Unbounded;
    if (unbounded && medium.sigmaT == 0.0 && medium.emission && !medium.emission->tiedToAbsorption) {
      error(path + ".emission", "shines from infinitely far, because the medium is unbounded and absorbs nothing; "
                                "give it a shape or an extinction above 0");
    }
    if (unbounded && medium.sigmaT > 0.0) {
      checkUnbounded(path);
    }
  }

  /// Between the camera and infinity an unbounded medium has infinite optical depth.
  void checkUnbounded(const std::string& path) {
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const bool local = std::holds_alternative<PointLight>(scene_.lights[i].light);
      if (local || wrong(fmt::format("lights.{}", i), {"type"})) {
        continue;
      }
      error(path + ".shape",
            fmt::format("is unbounded: no light comes from infinity (lights.{}) through a medium that fills all space, "
                        "and the picture would be black; give it a shape, such as {{\"type\": \"box\", \"min\": "
                        "[-1, -1, -1], \"max\": [1, 1, 1]}}, or use point lights only",
                        i));
      return;
    }
  }

  void checkLight(const Light& light, const std::string& path) {
    const auto* sky = std::get_if<SkyEnvironment>(&light);
    if (sky != nullptr && !wrong(path, {"sun_direction"}) && sky->sunDirection.y > 0.0) {
      warning(path + ".sun_direction", "points up: it is the way the light travels, so that the sun is below the "
                                       "horizon and the sky dark; by day y is negative");
    }
  }

  void checkSomethingToSee() {
    const bool emits = std::any_of(scene_.media.begin(), scene_.media.end(),
                                   [](const Medium& medium) { return medium.emission.has_value(); });
    if (scene_.lights.empty() && !emits && !findings_.errorIn("lights") && !findings_.errorIn("media")) {
      warning("lights", "there are no lights and no emission: the picture will be black; add a light, such as "
                        "{\"type\": \"sun\", \"direction\": [0, -1, 0], \"irradiance\": 3}");
    }
    if (scene_.media.empty() && !findings_.errorIn("media")) {
      warning("media", "there are no media: nothing scatters light; add one, such as {\"type\": \"grid\", \"file\": "
                       "\"cloud.vdb\"}");
    }
  }

  const Scene& scene_;
  const json::Value& root_;
  Findings& findings_;
};

} // namespace

void checkScene(const Scene& scene, const json::Value& root, Findings& findings) {
  // Findings without a path come from the text itself: values are then missing from the scene.
  const bool unread = std::any_of(findings.all().begin(), findings.all().end(),
                                  [](const Finding& finding) { return finding.path.empty(); });
  if (!unread) {
    Checker(scene, root, findings).run();
  }
}

} // namespace tyndall::scene

// SPDX-License-Identifier: Apache-2.0
#include "scene/checks_surfaces.h"

#include "base/error.h"
#include "interop/material.h"

#include <algorithm>
#include <filesystem>

namespace tyndall::scene {
namespace {

template <class Items>
auto find(const Items& items, const std::string& name) {
  return std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
}

/// Rotation, uniform scale, mirroring and translation only: spheres stay spheres.
bool isSimilarity(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const glm::dmat3 gram = glm::transpose(linear) * linear;
  const double squared = (gram[0][0] + gram[1][1] + gram[2][2]) / 3.0;
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      worst = std::max(worst, std::abs(gram[i][j] - (i == j ? squared : 0.0)));
    }
  }
  return worst <= 1e-6 * squared; // what a matrix written with 7 digits keeps
}

/// A medium or a refracting material: one bit of the mask of what a ray is in.
bool hasInterior(const Scene& scene, const Object& object) {
  const auto material = find(scene.materials, object.material);
  return !object.medium.empty() || (material != scene.materials.end() && material->model == MaterialId::Dielectric);
}

class SurfaceChecker {
public:
  SurfaceChecker(const Scene& scene, CheckReport& report) : scene_(scene), report_(report) {}

  void run() {
    report_.checkNames("materials", scene_.materials);
    report_.checkNames("objects", scene_.objects);
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      checkMaterial(scene_.materials[i], fmt::format("materials.{}", i));
    }
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      const std::string path = fmt::format("objects.{}", i);
      if (!report_.wrong(path, {"type"})) {
        checkGeometry(scene_.objects[i], path);
        checkMaterialOf(scene_.objects[i], path);
        checkMediumOf(scene_.objects[i], path);
      }
    }
    checkInteriors();
    for (std::size_t i = 0; i < scene_.media.size(); ++i) {
      const bool inObjects = scene_.media[i].homogeneous() && scene_.media[i].shape == MediumShape::Objects;
      if (inObjects && !report_.wrong(fmt::format("media.{}", i), {"type", "shape"})) {
        checkFilling(scene_.media[i], fmt::format("media.{}", i));
      }
    }
  }

private:
  void checkMaterial(const geometry::Material& material, const std::string& path) {
    const glm::dvec3 none(0.0);
    if (material.eta != none && material.k == none && !report_.wrong(path, {"eta", "k"})) {
      report_.warning(path + ".eta", "has no effect while k is 0, where the colour is the reflectance; add \"k\" or "
                                     "remove it");
    }
  }

  void checkGeometry(const Object& object, const std::string& path) {
    std::error_code ignored;
    if (object.kind == Object::Kind::Mesh && !report_.wrong(path, {"file"}) &&
        !std::filesystem::exists(object.file, ignored)) {
      report_.error(path + ".file",
                    fmt::format("there is no file {}; a mesh is one file, not a sequence", object.file));
    }
    if (object.kind == Object::Kind::Box) {
      report_.checkBox(object.box, path);
    }
    if (object.kind == Object::Kind::Quad && !report_.wrong(path, {"edge_u", "edge_v"})) {
      const double area = glm::length(glm::cross(object.edgeU, object.edgeV));
      if (!(area > 1e-9 * glm::length(object.edgeU) * glm::length(object.edgeV))) {
        report_.error(path + ".edge_v", "spans no area with edge_u; choose two edges that are not 0 and not parallel");
      }
    }
    if (object.kind == Object::Kind::Sphere && !report_.wrong(path, {"transform", "instances"})) {
      checkStaysSphere(object, path);
    }
  }

  void checkStaysSphere(const Object& object, const std::string& path) {
    constexpr const char* kNeeds =
        "makes the sphere an ellipsoid; use rotations, translations and one scale factor for "
        "all axes, or a mesh";
    const bool similar = isSimilarity(object.worldFromObject);
    if (object.instances.empty() && !similar) {
      report_.error(path + ".transform", kNeeds);
    }
    for (std::size_t i = 0; i < object.instances.size(); ++i) {
      if (!isSimilarity(object.instances[i] * object.worldFromObject)) {
        report_.error(similar ? fmt::format("{}.instances.{}", path, i) : path + ".transform", kNeeds);
        return;
      }
    }
  }

  void checkMaterialOf(const Object& object, const std::string& path) {
    if (object.material.empty() || report_.wrong(path, {"material"})) {
      return;
    }
    const auto material = find(scene_.materials, object.material);
    if (material == scene_.materials.end()) {
      reportUnknown(path + ".material", "materials", object.material, scene_.materials);
    } else if (material->model == MaterialId::Null && object.medium.empty() && !report_.wrong(path, {"medium"})) {
      report_.warning(path + ".material", fmt::format("\"{}\" is of type \"null\" and there is no medium inside, so "
                                                      "that nothing of this object is seen; add \"medium\" or choose "
                                                      "another material",
                                                      object.material));
    }
  }

  void checkMediumOf(const Object& object, const std::string& path) {
    if (object.medium.empty() || report_.wrong(path, {"medium"})) {
      return;
    }
    if (object.kind == Object::Kind::Quad) {
      return report_.error(path + ".medium", "cannot be inside a quad, which is not closed; remove it, or use a box, a "
                                             "sphere or a closed mesh");
    }
    const auto medium = find(scene_.media, object.medium);
    if (medium == scene_.media.end()) {
      return reportUnknown(path + ".medium", "media", object.medium, scene_.media);
    }
    const auto index = medium - scene_.media.begin();
    if (report_.wrong(fmt::format("media.{}", index), {"type", "file", "shape"})) {
      return;
    }
    if (!medium->homogeneous()) {
      report_.error(path + ".medium",
                    fmt::format("\"{}\" is of type \"grid\", but only a homogeneous medium can fill an "
                                "object; name one of type \"homogeneous\" with the shape {{\"type\": "
                                "\"objects\"}}",
                                object.medium));
    } else if (medium->shape != MediumShape::Objects) {
      report_.error(path + ".medium", fmt::format("\"{}\" has a shape of its own; give media.{} the shape {{\"type\": "
                                                  "\"objects\"}}, which lets objects bound it",
                                                  object.medium, index));
    }
  }

  /// Elements whose names could not be read might be the ones that are meant: nothing is said then.
  template <class Items>
  void reportUnknown(const std::string& path, const std::string& list, const std::string& name, const Items& items) {
    std::vector<std::string> names;
    bool unread = items.empty() && report_.errorIn(list);
    for (std::size_t i = 0; i < items.size(); ++i) {
      unread = unread || (items[i].name.empty() && report_.errorIn(fmt::format("{}.{}", list, i)));
      if (!items[i].name.empty()) {
        names.push_back(items[i].name);
      }
    }
    if (unread) {
      return;
    }
    const std::string nearest = nearestName(name, names);
    const std::string fix = !nearest.empty() ? fmt::format("did you mean \"{}\"?", nearest)
                            : names.empty()  ? fmt::format("nothing in \"{}\" has a name; add it there", list)
                                             : fmt::format("\"{}\" has {}", list, joinNames(names));
    report_.error(path, fmt::format("there is no \"{}\" in \"{}\"; {}", name, list, fix));
  }

  void checkInteriors() {
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      count += hasInterior(scene_, scene_.objects[i]) ? 1 : 0;
      if (count > interop::kMaxInteriors) {
        report_.error(fmt::format("objects.{}", i),
                      fmt::format("is one too many with a medium or a dielectric material: at most {} can be told "
                                  "apart along a ray; make like ones instances of one object, or one mesh",
                                  interop::kMaxInteriors));
        return;
      }
    }
  }

  void checkFilling(const Medium& medium, const std::string& path) {
    if (!report_.wrong(path, {"transform"}) && medium.worldFromMedium != glm::dmat4(1.0)) {
      report_.error(path + ".transform", "has no meaning for the shape \"objects\": the objects say where the medium "
                                         "is; remove it, or transform them");
    }
    if (!report_.wrong(path, {"instances"}) && !medium.instances.empty()) {
      report_.error(path + ".instances", "has no meaning for the shape \"objects\": the objects say where the medium "
                                         "is; remove it, or give them instances");
    }
    const bool named = std::any_of(scene_.objects.begin(), scene_.objects.end(), [&](const Object& object) {
      return !object.medium.empty() && object.medium == medium.name;
    });
    if (!named && !report_.errorIn("objects")) {
      report_.error(path + ".shape",
                    medium.name.empty()
                        ? "is inside objects, but no object can name the medium; give it a \"name\" and an object "
                          "\"medium\" with that name, or another shape"
                        : fmt::format("is inside objects, but no object names the medium, so that it would be nowhere; "
                                      "add \"medium\": \"{}\" to an object, or give it another shape",
                                      medium.name));
    }
  }

  const Scene& scene_;
  CheckReport& report_;
};

} // namespace

void checkSurfaces(const Scene& scene, CheckReport& report) { SurfaceChecker(scene, report).run(); }

bool surfacesMayShine(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    const auto material = find(scene.materials, object.material);
    const bool glows = material != scene.materials.end() && material->emission != glm::dvec3(0.0);
    const bool mesh = object.kind == Object::Kind::Mesh;
    return glows || (mesh && (object.lights || object.material.empty()));
  });
}

} // namespace tyndall::scene

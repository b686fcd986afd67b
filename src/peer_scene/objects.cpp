// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "gpu_scene/surface_sources.h"
#include "peer_scene/parts.h"
#include "peer_scene/ply.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall::peer_scene {
namespace fs = std::filesystem;
namespace {

using geometry::Material;
using geometry::Mesh;

const Material kDefaultMaterial{};

/// The mesh laid out in the world. `insideOut`: it encloses a negative volume, which its front has to leave.
Mesh inWorld(const Mesh& mesh, const glm::dmat4& worldFromMesh, bool insideOut) {
  Mesh world = mesh;
  for (glm::vec3& position : world.positions) {
    position = glm::vec3(worldFromMesh * glm::dvec4(glm::dvec3(position), 1.0));
  }
  const glm::dmat3 normalMatrix = glm::inverseTranspose(glm::dmat3(worldFromMesh)) * (insideOut ? -1.0 : 1.0);
  for (glm::vec3& normal : world.normals) {
    normal = glm::vec3(glm::normalize(normalMatrix * glm::dvec3(normal)));
  }
  const bool mirrored = glm::determinant(glm::dmat3(worldFromMesh)) < 0.0;
  for (glm::uvec3& triangle : world.triangles) {
    if (mirrored != insideOut) {
      std::swap(triangle.y, triangle.z);
    }
  }
  return world;
}

class ObjectWriter {
public:
  ObjectWriter(const scene::Scene& scene, const gpu_scene::MeshSet& meshes, const WrittenMedia& media,
               Materials& materials, const fs::path& folder)
      : scene_(scene), meshes_(meshes), media_(media), materials_(materials), folder_(folder) {}

  void add(std::size_t index) {
    object_ = &scene_.objects[index];
    const gpu_scene::ObjectSource source = gpu_scene::objectSource(*object_, meshes_, index);
    for (const glm::dmat4& place : gpu_scene::placements(object_->worldFromObject, object_->instances)) {
      if (object_->kind == scene::Object::Kind::Sphere) {
        addSphere(place);
      }
      for (const gpu_scene::ObjectSource::Part& part : source.parts) {
        addMesh(source, part, place);
      }
    }
  }

  Json list = Json::array();

private:
  const Material& material(const geometry::Model* model, std::uint32_t ofFile) const {
    if (!object_->material.empty()) {
      const auto found = std::find_if(scene_.materials.begin(), scene_.materials.end(),
                                      [&](const Material& known) { return known.name == object_->material; });
      TYNDALL_CHECK(found != scene_.materials.end());
      return *found;
    }
    return ofFile == geometry::kNone ? kDefaultMaterial : model->materials[ofFile];
  }

  /// What all kinds of objects have.
  Json described(const Material& made) {
    Json json{{"name", object_->name}, {"material", materials_.index(made)}, {"medium", nullptr}};
    if (!object_->medium.empty()) {
      json["medium"] = media_.indexOf.at(object_->medium);
    }
    json["priority"] = object_->priority;
    return json;
  }

  void addSphere(const glm::dmat4& place) {
    Json json = described(material(nullptr, geometry::kNone));
    json["type"] = "sphere";
    json["centre"] = inJson(glm::dvec3(place * glm::dvec4(object_->centre, 1.0)));
    json["radius"] = object_->radius * std::cbrt(std::abs(glm::determinant(glm::dmat3(place))));
    list.push_back(std::move(json));
  }

  /// One entry for each material that the mesh's triangles have.
  void addMesh(const gpu_scene::ObjectSource& source, const gpu_scene::ObjectSource::Part& part,
               const glm::dmat4& place) {
    const Mesh& own = source.mesh(part.mesh);
    std::map<const Material*, std::vector<std::size_t>> trianglesOf;
    for (std::size_t i = 0; i < own.triangles.size(); ++i) {
      trianglesOf[&material(source.model, own.materials.empty() ? geometry::kNone : own.materials[i])].push_back(i);
    }
    for (const auto& [made, indices] : trianglesOf) {
      const bool filled = !object_->medium.empty() || made->model == MaterialId::Dielectric;
      const Mesh world = inWorld(own, place * part.objectFromMesh, filled && source.insideOut);
      std::vector<glm::uvec3> triangles(indices.size());
      std::transform(indices.begin(), indices.end(), triangles.begin(),
                     [&](std::size_t i) { return world.triangles[i]; });
      const std::string file = fmt::format("mesh_{}.ply", list.size());
      writePly(folder_ / file, world, triangles);
      Json json = described(*made);
      json["type"] = "mesh";
      json["file"] = file;
      json["normals"] = !world.normals.empty();
      list.push_back(std::move(json));
    }
  }

  const scene::Scene& scene_;
  const gpu_scene::MeshSet& meshes_;
  const WrittenMedia& media_;
  Materials& materials_;
  const fs::path& folder_;
  const scene::Object* object_ = nullptr;
};

} // namespace

Json writeObjects(const scene::Scene& scene, const gpu_scene::MeshSet& meshes, const WrittenMedia& media,
                  Materials& materials, const fs::path& folder) {
  ObjectWriter writer(scene, meshes, media, materials, folder);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    writer.add(i);
  }
  return std::move(writer.list);
}

} // namespace tyndall::peer_scene

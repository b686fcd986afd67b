// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/meshes.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <map>

namespace tyndall::gpu_scene {
namespace {

using geometry::Model;
using geometry::PunctualLight;

glm::dvec3 pointIn(const glm::dmat4& transform, const glm::dvec3& point) {
  return glm::dvec3(transform * glm::dvec4(point, 1.0));
}

scene::NamedLight lightFrom(const PunctualLight& light, const glm::dmat4& worldFromFile, const std::string& object) {
  scene::NamedLight named;
  named.name = fmt::format("{}/{}", object, light.name);
  const glm::dvec3 position = pointIn(worldFromFile, light.position);
  const glm::dvec3 direction = glm::normalize(glm::dmat3(worldFromFile) * light.direction);
  switch (light.kind) {
  case PunctualLight::Kind::Point:
    named.light = scene::PointLight{position, light.intensity};
    break;
  case PunctualLight::Kind::Spot:
    named.light = scene::SpotLight{position, direction, light.intensity, light.outerAngle, light.innerAngle};
    break;
  case PunctualLight::Kind::Directional:
    named.light = scene::SunLight{direction, light.intensity, 0.0};
    break;
  }
  return named;
}

Bounds3 modelBounds(const Model& model) {
  std::vector<Bounds3> meshes(model.meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (const glm::vec3& position : model.meshes[i].positions) {
      meshes[i].extend(glm::dvec3(position));
    }
  }
  Bounds3 bounds;
  for (const geometry::Node& node : model.nodes) {
    bounds.extend(transformed(node.worldFromObject, meshes[node.mesh]));
  }
  return bounds;
}

} // namespace

MeshSet loadMeshes(const scene::Scene& scene) {
  MeshSet set;
  std::map<std::string, std::size_t> loaded;
  for (const scene::Object& object : scene.objects) {
    set.uses.emplace_back();
    if (object.kind != scene::Object::Kind::Mesh) {
      continue;
    }
    const auto [entry, isNew] = loaded.try_emplace(object.file, set.models.size());
    if (isNew) {
      set.models.push_back(geometry::loadModel(object.file, scene.animation.seconds));
      for (const std::string& warning : set.models.back().warnings) {
        set.notes.push_back(fmt::format("{}: {}", object.file, warning));
      }
    }
    set.uses.back() = entry->second;
  }
  return set;
}

void addModelLights(scene::Scene& scene, const MeshSet& meshes) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const scene::Object& object = scene.objects[i];
    if (!meshes.uses[i] || !object.lights) {
      continue;
    }
    for (const glm::dmat4& place : placements(object.worldFromObject, object.instances)) {
      for (const PunctualLight& light : meshes.models[*meshes.uses[i]].lights) {
        scene.lights.push_back(lightFrom(light, place, object.name.empty() ? object.file : object.name));
      }
    }
  }
}

std::vector<glm::dmat4> placements(const glm::dmat4& worldFromOwn, const std::vector<glm::dmat4>& instances) {
  if (instances.empty()) {
    return {worldFromOwn};
  }
  std::vector<glm::dmat4> places(instances.size());
  std::transform(instances.begin(), instances.end(), places.begin(),
                 [&](const glm::dmat4& instance) { return instance * worldFromOwn; });
  return places;
}

Bounds3 localBounds(const scene::Object& object, const MeshSet& meshes, std::size_t index) {
  Bounds3 local;
  switch (object.kind) {
  case scene::Object::Kind::Mesh:
    return modelBounds(meshes.models[*meshes.uses[index]]);
  case scene::Object::Kind::Box:
    return object.box;
  case scene::Object::Kind::Sphere:
    return {object.centre - object.radius, object.centre + object.radius};
  case scene::Object::Kind::Quad:
    for (const glm::dvec3& corner : {object.origin, object.origin + object.edgeU, object.origin + object.edgeV,
                                     object.origin + object.edgeU + object.edgeV}) {
      local.extend(corner);
    }
    return local;
  }
  return local;
}

Bounds3 objectBounds(const scene::Scene& scene, const MeshSet& meshes) {
  Bounds3 bounds;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Bounds3 local = localBounds(scene.objects[i], meshes, i);
    for (const glm::dmat4& place : placements(scene.objects[i].worldFromObject, scene.objects[i].instances)) {
      bounds.extend(transformed(place, local));
    }
  }
  return bounds;
}

} // namespace tyndall::gpu_scene

// SPDX-License-Identifier: Apache-2.0
#include "geometry/load_gltf_parts.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall::geometry {
namespace {

glm::dmat4 parentFromNode(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    glm::dmat4 matrix;
    for (std::size_t i = 0; i < 16; ++i) { // column by column
      matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = node.matrix[i];
    }
    return matrix;
  }
  glm::dmat4 matrix(1.0);
  if (node.translation.size() == 3) {
    matrix = glm::translate(matrix, {node.translation[0], node.translation[1], node.translation[2]});
  }
  if (node.rotation.size() == 4) {
    const glm::dquat turn(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    matrix = glm::length(turn) > 0.0 ? matrix * glm::mat4_cast(glm::normalize(turn)) : matrix;
  }
  if (node.scale.size() == 3) {
    matrix = glm::scale(matrix, {node.scale[0], node.scale[1], node.scale[2]});
  }
  return matrix;
}

std::vector<int> rootsOf(const tinygltf::Model& source) {
  if (source.defaultScene >= 0 && static_cast<std::size_t>(source.defaultScene) < source.scenes.size()) {
    return source.scenes[static_cast<std::size_t>(source.defaultScene)].nodes;
  }
  if (!source.scenes.empty()) {
    return source.scenes.front().nodes;
  }
  std::vector<bool> isChild(source.nodes.size(), false);
  for (const tinygltf::Node& node : source.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < isChild.size()) {
        isChild[static_cast<std::size_t>(child)] = true;
      }
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < isChild.size(); ++i) {
    if (!isChild[i]) {
      roots.push_back(static_cast<int>(i));
    }
  }
  return roots;
}

/// Unit along an axis of a node; the axis itself where the node's scale is 0.
glm::dvec3 direction(const glm::dmat4& worldFromNode, const glm::dvec3& axis) {
  const glm::dvec3 turned = glm::dmat3(worldFromNode) * axis;
  const double length = glm::length(turned);
  return length > 0.0 && std::isfinite(length) ? turned / length : axis;
}

class SceneReader {
public:
  SceneReader(const tinygltf::Model& source, Model& model) : source_(source), model_(model) {}

  /// Each node is placed once: files where nodes lie in a circle or have two parents are against the standard.
  void walk() {
    struct Visit {
      int node;
      glm::dmat4 worldFromParent;
    };
    std::vector<Visit> ahead;
    const auto push = [&ahead](const std::vector<int>& nodes, const glm::dmat4& worldFromParent) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
        ahead.push_back({*node, worldFromParent});
      }
    };
    std::vector<bool> seen(source_.nodes.size(), false);
    push(rootsOf(source_), glm::dmat4(1.0));
    while (!ahead.empty()) {
      const Visit visit = ahead.back();
      ahead.pop_back();
      if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= seen.size()) {
        ++missing_;
        continue;
      }
      const auto index = static_cast<std::size_t>(visit.node);
      if (seen[index]) {
        ++again_;
        continue;
      }
      seen[index] = true;
      const glm::dmat4 worldFromNode = visit.worldFromParent * parentFromNode(source_.nodes[index]);
      place(source_.nodes[index], worldFromNode);
      push(source_.nodes[index].children, worldFromNode);
    }
  }

  void warn() {
    say(missing_, "references to nodes, meshes, cameras or lights that are not there were passed over.");
    say(again_, "nodes are their own ancestors or have two parents: only their first place was kept.");
    say(badLights_, "lights of unknown kind, or with values that are negative or not finite, were left out.");
    say(badCameras_, "cameras without a sound angle or height were left out.");
  }

private:
  void say(std::size_t count, const char* sentence) {
    if (count > 0) {
      model_.warnings.push_back(fmt::format("{} {}", count, sentence));
    }
  }

  void place(const tinygltf::Node& node, const glm::dmat4& worldFromNode) {
    if (node.mesh >= 0 && static_cast<std::size_t>(node.mesh) < source_.meshes.size()) {
      model_.nodes.push_back({static_cast<std::uint32_t>(node.mesh), worldFromNode});
    } else if (node.mesh >= 0) {
      ++missing_;
    }
    if (node.camera >= 0 && static_cast<std::size_t>(node.camera) < source_.cameras.size()) {
      placeCamera(source_.cameras[static_cast<std::size_t>(node.camera)], worldFromNode);
    } else if (node.camera >= 0) {
      ++missing_;
    }
    if (const auto extension = node.extensions.find("KHR_lights_punctual"); extension != node.extensions.end()) {
      const double light = numberOf(extension->second, "light", -1.0);
      if (light >= 0.0 && light < static_cast<double>(source_.lights.size())) {
        placeLight(source_.lights[static_cast<std::size_t>(light)], worldFromNode);
      } else {
        ++missing_;
      }
    }
  }

  void placeCamera(const tinygltf::Camera& from, const glm::dmat4& worldFromNode) {
    ModelCamera camera;
    camera.name = from.name;
    camera.perspective = from.type == "perspective";
    const glm::dvec3 back = direction(worldFromNode, {0.0, 0.0, 1.0});
    const glm::dvec3 up = direction(worldFromNode, {0.0, 1.0, 0.0});
    camera.worldFromCamera = {glm::dvec4(glm::cross(up, back), 0.0), glm::dvec4(up, 0.0), glm::dvec4(back, 0.0),
                              worldFromNode[3]};
    camera.verticalFov = glm::degrees(from.perspective.yfov);
    camera.height = 2.0 * std::abs(from.orthographic.ymag);
    const bool sound = camera.perspective ? camera.verticalFov > 0.0 && camera.verticalFov < 180.0
                                          : camera.height > 0.0 && std::isfinite(camera.height);
    const bool placed = std::isfinite(glm::dot(worldFromNode[3], worldFromNode[3]));
    if (sound && placed) {
      model_.cameras.push_back(camera);
    } else {
      ++badCameras_;
    }
  }

  void placeLight(const tinygltf::Light& from, const glm::dmat4& worldFromNode) {
    PunctualLight light;
    light.name = from.name;
    light.kind = from.type == "spot"          ? PunctualLight::Kind::Spot
                 : from.type == "directional" ? PunctualLight::Kind::Directional
                                              : PunctualLight::Kind::Point;
    light.position = glm::dvec3(worldFromNode[3]);
    light.direction = direction(worldFromNode, {0.0, 0.0, -1.0});
    light.intensity = glm::dvec3(from.intensity);
    if (from.color.size() == 3) {
      light.intensity *= glm::dvec3(from.color[0], from.color[1], from.color[2]);
    }
    light.outerAngle = glm::degrees(std::clamp(from.spot.outerConeAngle, 1e-4, glm::half_pi<double>()));
    light.innerAngle = std::clamp(glm::degrees(from.spot.innerConeAngle), 0.0, light.outerAngle);
    const bool known = from.type == "point" || from.type == "spot" || from.type == "directional";
    const double total = light.intensity.x + light.intensity.y + light.intensity.z;
    const bool positive = glm::all(glm::greaterThanEqual(light.intensity, glm::dvec3(0.0))) && std::isfinite(total);
    if (known && positive && std::isfinite(glm::dot(light.position, light.position))) {
      model_.lights.push_back(light);
    } else {
      ++badLights_;
    }
  }

  const tinygltf::Model& source_;
  Model& model_;
  std::size_t missing_ = 0;
  std::size_t again_ = 0;
  std::size_t badLights_ = 0;
  std::size_t badCameras_ = 0;
};

} // namespace

void readGltfScene(const tinygltf::Model& source, Model& model) {
  SceneReader reader(source, model);
  reader.walk();
  reader.warn();
}

} // namespace tyndall::geometry

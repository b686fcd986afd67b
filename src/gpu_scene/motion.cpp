// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/motion.h"

#include "gpu_scene/meshes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall::gpu_scene {
namespace {

using scene::Object;

bool sameObject(const Object& a, const Object& b) {
  return a.kind == b.kind && a.file == b.file && a.instances.size() == b.instances.size();
}

bool sameNodes(const std::vector<geometry::Node>& a, const std::vector<geometry::Node>& b) {
  return std::ranges::equal(a, b, {}, &geometry::Node::mesh, &geometry::Node::mesh);
}

bool sameSurfaces(const Pose& a, const Pose& b) {
  return std::ranges::equal(a.scene.objects, b.scene.objects, sameObject) &&
         std::ranges::equal(a.nodes, b.nodes, sameNodes);
}

/// From a space in which all objects of a kind are alike: what changes of an object's own numbers moves it too.
glm::dmat4 objectFromKind(const Object& object) {
  glm::dmat4 result(1.0);
  switch (object.kind) {
  case Object::Kind::Mesh:
    break;
  case Object::Kind::Quad: {
    const glm::dvec3 normal = glm::cross(object.edgeU, object.edgeV);
    result[0] = glm::dvec4(object.edgeU, 0.0);
    result[1] = glm::dvec4(object.edgeV, 0.0);
    result[2] = glm::dvec4(normal / std::sqrt(glm::length(normal)), 0.0); // as long as the edges
    result[3] = glm::dvec4(object.origin, 1.0);
    break;
  }
  case Object::Kind::Box:
    result = glm::scale(glm::translate(result, object.box.min), object.box.size());
    break;
  case Object::Kind::Sphere:
    result = glm::scale(glm::translate(result, object.centre), glm::dvec3(object.radius));
    break;
  }
  return result;
}

glm::dmat4 objectFromPart(const Pose& pose, std::size_t object, std::size_t node) {
  const std::vector<geometry::Node>& nodes = pose.nodes[object];
  return nodes.empty() ? objectFromKind(pose.scene.objects[object]) : nodes[node].worldFromObject;
}

std::vector<glm::dmat4> placesOf(const Pose& pose, std::size_t object) {
  return placements(pose.scene.objects[object].worldFromObject, pose.scene.objects[object].instances);
}

} // namespace

Pose poseOf(const scene::Scene& scene, const MeshSet& meshes) {
  Pose pose{scene, {}};
  for (const std::optional<std::size_t>& use : meshes.uses) {
    pose.nodes.push_back(use ? meshes.models[*use].nodes : std::vector<geometry::Node>());
  }
  return pose;
}

SurfaceMotion::SurfaceMotion(const Pose& now, const Pose& previous, const glm::dvec3& centre) {
  if (!sameSurfaces(now, previous)) {
    return;
  }
  for (std::size_t object = 0; object < now.scene.objects.size(); ++object) {
    addObject(now, previous, object, glm::translate(glm::dmat4(1.0), -centre));
  }
}

void SurfaceMotion::addObject(const Pose& now, const Pose& previous, std::size_t object,
                              const glm::dmat4& centredFromWorld) {
  const std::vector<glm::dmat4> places = placesOf(now, object);
  const std::vector<glm::dmat4> placesBefore = placesOf(previous, object);
  nodeCounts_.push_back(std::max<std::size_t>(1, now.nodes[object].size()));
  indices_.emplace_back();
  for (std::size_t copy = 0; copy < places.size(); ++copy) {
    for (std::size_t node = 0; node < nodeCounts_.back(); ++node) {
      const glm::dmat4 centredNow = centredFromWorld * places[copy] * objectFromPart(now, object, node);
      const glm::dmat4 centredThen = centredFromWorld * placesBefore[copy] * objectFromPart(previous, object, node);
      const bool moves = centredNow != centredThen;
      indices_.back().push_back(moves ? static_cast<std::uint32_t>(motions_.size()) : interop::kNoMotion);
      if (moves) {
        motions_.push_back({glm::mat4x3(glm::dmat4x3(centredThen * glm::inverse(centredNow)))});
      }
    }
  }
}

std::uint32_t SurfaceMotion::indexOf(std::size_t object, std::size_t copy, std::size_t node) const {
  return indices_.empty() ? interop::kNoMotion : indices_[object][copy * nodeCounts_[object] + node];
}

} // namespace tyndall::gpu_scene

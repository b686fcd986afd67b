// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/surface_sources.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace tyndall::gpu_scene {
namespace {

using geometry::Mesh;

void addQuad(Mesh& mesh, const glm::dvec3& origin, const glm::dvec3& edgeU, const glm::dvec3& edgeV) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec2 uv : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
    mesh.positions.emplace_back(origin + uv.x * edgeU + uv.y * edgeV);
    mesh.uvs.emplace_back(uv);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

/// Six quads that face outwards; each corner is written alike, so that neighbours share it.
Mesh boxMesh(const Bounds3& box) {
  Mesh mesh;
  const glm::dvec3 size = box.size();
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 u(0.0);
    glm::dvec3 v(0.0);
    u[(axis + 1) % 3] = size[(axis + 1) % 3];
    v[(axis + 2) % 3] = size[(axis + 2) % 3];
    glm::dvec3 far = box.min;
    far[axis] = box.max[axis];
    addQuad(mesh, far, u, v);
    addQuad(mesh, box.min, v, u);
  }
  // Snapped to the box's own planes: min + size may round away from max.
  for (glm::vec3& position : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool high = glm::dvec3(position)[axis] > box.centre()[axis];
      position[axis] = static_cast<float>(high ? box.max[axis] : box.min[axis]);
    }
  }
  return mesh;
}

/// Vertices are floats: about the object's own centre, since its place may be far from the origin.
template <class MakeMesh>
void addMade(ObjectSource& source, const glm::dvec3& centre, MakeMesh makeMesh) {
  source.made.push_back(makeMesh(centre));
  source.parts.push_back({0, glm::translate(glm::dmat4(1.0), centre)});
}

double signedVolume(const ObjectSource& source) {
  double volume = 0.0;
  for (const ObjectSource::Part& part : source.parts) {
    const Mesh& mesh = source.mesh(part.mesh);
    for (const glm::uvec3& triangle : mesh.triangles) {
      glm::dvec3 corners[3];
      for (int c = 0; c < 3; ++c) {
        corners[c] = glm::dvec3(part.objectFromMesh * glm::dvec4(glm::dvec3(mesh.positions[triangle[c]]), 1.0));
      }
      const double sign = glm::determinant(glm::dmat3(part.objectFromMesh)) < 0.0 ? -1.0 : 1.0;
      volume += sign * glm::dot(corners[0], glm::cross(corners[1], corners[2]));
    }
  }
  return volume / 6.0;
}

} // namespace

std::size_t ObjectSource::usesOf(std::uint32_t mesh) const {
  return static_cast<std::size_t>(
      std::count_if(parts.begin(), parts.end(), [mesh](const Part& part) { return part.mesh == mesh; }));
}

ObjectSource objectSource(const scene::Object& object, const MeshSet& meshes, std::size_t index) {
  ObjectSource source;
  switch (object.kind) {
  case scene::Object::Kind::Mesh:
    source.model = &meshes.models[*meshes.uses[index]];
    for (const geometry::Node& node : source.model->nodes) {
      source.parts.push_back({node.mesh, node.worldFromObject});
    }
    break;
  case scene::Object::Kind::Quad:
    addMade(source, object.origin + 0.5 * (object.edgeU + object.edgeV), [&](const glm::dvec3& centre) {
      Mesh mesh;
      addQuad(mesh, object.origin - centre, object.edgeU, object.edgeV);
      return mesh;
    });
    break;
  case scene::Object::Kind::Box:
    addMade(source, object.box.centre(), [&](const glm::dvec3& centre) {
      return boxMesh({object.box.min - centre, object.box.max - centre});
    });
    break;
  case scene::Object::Kind::Sphere:
    break; // a primitive of its own
  }
  source.insideOut = signedVolume(source) < 0.0;
  return source;
}

int crossing(const glm::dvec3& origin, const glm::dvec3 (&corners)[3]) {
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.5707963, 0.7320508, 0.3819660)); // along no plane of note
  const glm::dvec3 edge1 = corners[1] - corners[0];
  const glm::dvec3 edge2 = corners[2] - corners[0];
  const glm::dvec3 p = glm::cross(direction, edge2);
  const double determinant = glm::dot(edge1, p);
  if (determinant == 0.0) {
    return 0;
  }
  const glm::dvec3 toOrigin = origin - corners[0];
  const glm::dvec3 q = glm::cross(toOrigin, edge1);
  const double u = glm::dot(toOrigin, p) / determinant;
  const double v = glm::dot(direction, q) / determinant;
  const double t = glm::dot(edge2, q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 0.0) {
    return 0;
  }
  return determinant < 0.0 ? 1 : -1; // direction along the normal: determinant < 0, the ray leaves
}

} // namespace tyndall::gpu_scene

// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/surfaces.h"

#include "gpu_scene/surface_materials.h"
#include "gpu_scene/surface_sources.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <map>

namespace tyndall::gpu_scene {
namespace {

using geometry::BvhInput;
using geometry::Mesh;

/// Copies of fewer triangles than this in all are laid out in the world: a ray into an instance costs a transform.
constexpr std::size_t kInstancedTriangles = 4096;

interop::BvhPrimitive trianglePrimitive(const glm::dvec3 (&corners)[3], std::size_t index, bool opaque) {
  const auto id =
      static_cast<std::uint32_t>(index) | interop::kPrimitiveTriangle | (opaque ? interop::kPrimitiveOpaque : 0u);
  return {glm::vec3(corners[0]), glm::vec3(corners[1]), glm::vec3(corners[2]), id};
}

bool withoutArea(const interop::BvhPrimitive& triangle) {
  return glm::cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0) == glm::vec3(0.0f);
}

/// Lays the scene's objects out.
class SurfacePacker {
public:
  SurfacePacker(const scene::Scene& scene, const MeshSet& meshes, const std::vector<std::uint32_t>& mediumIndex,
                const glm::dvec3& centre, const SurfaceMotion& motions, PackedSurfaces& out)
      : scene_(scene), meshes_(meshes), centre_(centre), motions_(motions), out_(out),
        materials_(scene, meshes, mediumIndex, out) {}

  void run() {
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      addObject(i);
    }
    finishInstances();
    out_.bvh = geometry::buildBvh(world_);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const std::uint32_t root = geometry::appendBvh(out_.bvh, parts_[i]);
      for (const std::size_t instance : instancesOf_[i]) {
        out_.instances[instance].root = root;
      }
    }
    if (degenerate_ > 0) {
      out_.notes.push_back(fmt::format("{} triangles without area are left out", degenerate_));
    }
    materials_.finish();
  }

private:
  void addObject(std::size_t index) {
    const scene::Object& object = scene_.objects[index];
    const ObjectSource source = objectSource(object, meshes_, index);
    materials_.begin(index);
    winding_ = 0;
    const std::vector<glm::dmat4> places = placements(object.worldFromObject, object.instances);
    for (const glm::dmat4& place : places) {
      const auto copy = static_cast<std::size_t>(&place - places.data());
      motion_ = motions_.indexOf(index, copy, 0);
      for (const ObjectSource::Part& part : source.parts) {
        motion_ = motions_.indexOf(index, copy, static_cast<std::size_t>(&part - source.parts.data()));
        addPart(source, part, place, object.instances.size() > 1 || source.usesOf(part.mesh) > 1);
      }
      if (object.kind == scene::Object::Kind::Sphere) {
        addSphere(object, place);
      }
    }
    if (winding_ > 0 && materials_.interior() != interop::kNoInterior) {
      out_.cameraInteriors |= 1u << materials_.interior();
    }
  }

  void addPart(const ObjectSource& source, const ObjectSource::Part& part, const glm::dmat4& place, bool repeated) {
    const Mesh& mesh = source.mesh(part.mesh);
    const glm::dmat4 worldFromMesh = place * part.objectFromMesh;
    const bool emits = materials_.emits(mesh, source.model);
    const bool filled = materials_.interior() != interop::kNoInterior;
    if (repeated && !emits && !filled && mesh.triangles.size() >= kInstancedTriangles) {
      addInstance(source, part, worldFromMesh);
      return;
    }
    addTriangles(source, mesh, worldFromMesh, world_, glm::translate(glm::dmat4(1.0), -centre_) * worldFromMesh);
  }

  /// @param target where the triangles go. @param targetFromMesh their place there.
  void addTriangles(const ObjectSource& source, const Mesh& mesh, const glm::dmat4& worldFromMesh,
                    std::vector<BvhInput>& target, const glm::dmat4& targetFromMesh) {
    const auto firstVertex = static_cast<std::uint32_t>(out_.vertices.size());
    // Mirrored, or inside out where it encloses something: the front stays outside.
    const bool mirrored = glm::determinant(glm::dmat3(targetFromMesh)) < 0.0;
    const bool insideOut = materials_.interior() != interop::kNoInterior && source.insideOut;
    const bool turned = mirrored != insideOut;
    addVertices(mesh, targetFromMesh, insideOut ? -1.0 : 1.0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      glm::uvec3 order = mesh.triangles[i];
      if (turned) {
        std::swap(order.y, order.z);
      }
      glm::dvec3 corners[3];
      for (int c = 0; c < 3; ++c) {
        corners[c] = glm::dvec3(targetFromMesh * glm::dvec4(glm::dvec3(mesh.positions[order[c]]), 1.0));
      }
      const std::uint32_t material = materials_.device(mesh.materials.empty() ? geometry::kNone : mesh.materials[i]);
      const interop::BvhPrimitive primitive =
          trianglePrimitive(corners, out_.triangles.size(), materials_.opaque(material));
      if (withoutArea(primitive)) {
        ++degenerate_;
        continue;
      }
      interop::Triangle triangle{};
      for (int c = 0; c < 3; ++c) {
        triangle.vertices[c] = firstVertex + order[c];
      }
      triangle.material = material;
      triangle.emitter = addEmitter(primitive, material);
      triangle.motion = &target == &world_ ? motion_ : interop::kNoMotion; // its instances' own holds
      out_.triangles.push_back(triangle);
      target.push_back({primitive, {}});
      countWinding(worldFromMesh, mesh, order);
    }
  }

  /// @param side -1: normals are turned over.
  void addVertices(const Mesh& mesh, const glm::dmat4& targetFromMesh, double side) {
    const glm::dmat3 normalMatrix = side * glm::inverseTranspose(glm::dmat3(targetFromMesh));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      interop::Vertex vertex{glm::vec3(0.0f), glm::vec2(0.0f)};
      if (!mesh.normals.empty() && mesh.normals[i] != glm::vec3(0.0f)) {
        vertex.normal = glm::vec3(glm::normalize(normalMatrix * glm::dvec3(mesh.normals[i])));
      }
      if (!mesh.uvs.empty()) {
        vertex.uv = mesh.uvs[i];
      }
      out_.vertices.push_back(vertex);
    }
  }

  void addInstance(const ObjectSource& source, const ObjectSource::Part& part, const glm::dmat4& worldFromMesh) {
    const auto key = std::make_pair(&source.mesh(part.mesh), materials_.ownMaterial());
    const auto [entry, isNew] = partOf_.try_emplace(key, inputs_.size());
    if (isNew) {
      inputs_.emplace_back();
      instancesOf_.emplace_back();
      addTriangles(source, source.mesh(part.mesh), worldFromMesh, inputs_.back(), glm::dmat4(1.0));
    }
    instancesOf_[entry->second].push_back(out_.instances.size());
    const glm::dmat4 centredFromMesh = glm::translate(glm::dmat4(1.0), -centre_) * worldFromMesh;
    interop::Instance instance{};
    instance.worldFromObject = glm::mat4x3(glm::dmat4x3(centredFromMesh));
    instance.objectFromWorld = glm::mat4x3(glm::dmat4x3(glm::inverse(centredFromMesh)));
    instance.motion = motion_;
    out_.instances.push_back(instance);
  }

  /// Trees of the instanced meshes, and the instances as primitives of the world.
  void finishInstances() {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      parts_.push_back(geometry::buildBvh(inputs_[i]));
      for (const std::size_t index : instancesOf_[i]) {
        const glm::dmat4 worldFromObject =
            glm::dmat4(glm::dmat4x3(out_.instances[index].worldFromObject)); // as the device has it
        BvhInput input{};
        input.primitive.id = interop::kPrimitiveInstance | static_cast<std::uint32_t>(index);
        input.bounds = transformed(worldFromObject, parts_.back().bounds);
        world_.push_back(input);
      }
    }
  }

  void addSphere(const scene::Object& object, const glm::dmat4& place) {
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(place))));
    const glm::dvec3 centre = glm::dvec3(place * glm::dvec4(object.centre, 1.0));
    interop::Sphere sphere{};
    sphere.centre = glm::vec3(centre - centre_);
    sphere.radius = static_cast<float>(object.radius * scale);
    sphere.material = materials_.device(geometry::kNone);
    sphere.emitter = interop::kNoEmitter;
    sphere.motion = motion_;
    interop::BvhPrimitive primitive{sphere.centre, glm::vec3(sphere.radius, 0.0f, 0.0f), glm::vec3(0.0f), 0};
    primitive.id = interop::kPrimitiveSphere | static_cast<std::uint32_t>(out_.spheres.size()) |
                   (materials_.opaque(sphere.material) ? interop::kPrimitiveOpaque : 0u);
    sphere.emitter = addSphereEmitter(sphere);
    out_.spheres.push_back(sphere);
    world_.push_back({primitive, {}});
    winding_ += glm::length(scene_.camera.position - centre) < object.radius * scale ? 1 : 0;
  }

  std::uint32_t addEmitter(const interop::BvhPrimitive& triangle, std::uint32_t material) {
    if (materials_.emissionScale(material) <= 0.0f) {
      return interop::kNoEmitter;
    }
    interop::Emitter emitter{};
    emitter.kind = interop::kEmitterTriangle;
    emitter.position = triangle.v0;
    emitter.edge1 = triangle.v1 - triangle.v0;
    emitter.edge2 = triangle.v2 - triangle.v0;
    emitter.index = static_cast<std::uint32_t>(out_.triangles.size());
    return finishEmitter(emitter, material);
  }

  std::uint32_t addSphereEmitter(const interop::Sphere& sphere) {
    if (materials_.emissionScale(sphere.material) <= 0.0f) {
      return interop::kNoEmitter;
    }
    interop::Emitter emitter{};
    emitter.kind = interop::kEmitterSphere;
    emitter.position = sphere.centre;
    emitter.edge1 = glm::vec3(sphere.radius, 0.0f, 0.0f);
    emitter.index = static_cast<std::uint32_t>(out_.spheres.size());
    return finishEmitter(emitter, sphere.material);
  }

  std::uint32_t finishEmitter(interop::Emitter emitter, std::uint32_t material) {
    const interop::Material& made = out_.materials[material];
    const bool twoSided = (made.flags & interop::kMaterialTwoSided) != 0;
    emitter.flags = twoSided ? interop::kEmitterTwoSided : 0u;
    emitter.radiance = made.emission;
    out_.emitters.push_back(emitter);
    out_.emitterScales.push_back(materials_.emissionScale(material));
    return static_cast<std::uint32_t>(out_.emitters.size() - 1);
  }

  /// Adds the triangle's crossings of a ray from the camera: outward ones count 1, inward ones -1.
  void countWinding(const glm::dmat4& worldFromMesh, const Mesh& mesh, const glm::uvec3& order) {
    if (materials_.interior() == interop::kNoInterior) {
      return;
    }
    glm::dvec3 corners[3];
    for (int c = 0; c < 3; ++c) {
      corners[c] = glm::dvec3(worldFromMesh * glm::dvec4(glm::dvec3(mesh.positions[order[c]]), 1.0));
    }
    winding_ += crossing(scene_.camera.position, corners);
  }

  const scene::Scene& scene_;
  const MeshSet& meshes_;
  const glm::dvec3& centre_;
  const SurfaceMotion& motions_;
  PackedSurfaces& out_;
  SurfaceMaterials materials_;
  std::vector<BvhInput> world_;
  std::map<std::pair<const Mesh*, std::string>, std::size_t> partOf_;
  std::vector<std::vector<BvhInput>> inputs_;         ///< of each instanced mesh
  std::vector<std::vector<std::size_t>> instancesOf_; ///< of each instanced mesh
  std::vector<geometry::Bvh> parts_;
  std::size_t degenerate_ = 0;
  int winding_ = 0;
  std::uint32_t motion_ = interop::kNoMotion; ///< of the part at hand
};

} // namespace

PackedSurfaces packSurfaces(const scene::Scene& scene, const MeshSet& meshes,
                            const std::vector<std::uint32_t>& mediumIndex, const glm::dvec3& centre,
                            const Pose* previous) {
  const SurfaceMotion motions =
      previous != nullptr ? SurfaceMotion(poseOf(scene, meshes), *previous, centre) : SurfaceMotion();
  PackedSurfaces out;
  SurfacePacker(scene, meshes, mediumIndex, centre, motions, out).run();
  out.motions = motions.motions();
  return out;
}

} // namespace tyndall::gpu_scene

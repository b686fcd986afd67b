// SPDX-License-Identifier: Apache-2.0
#include "verify/test_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <string>

namespace tyndall::verify {

TestScene::TestScene(const glm::uvec2& size) { scene.film.size = size; }

void TestScene::orthographic(const glm::dvec3& position, const glm::dvec3& target, double height) {
  scene.camera.kind = scene::Camera::Kind::Orthographic;
  scene.camera.position = position;
  scene.camera.target = target;
  scene.camera.height = height;
}

void TestScene::perspective(const glm::dvec3& position, const glm::dvec3& target, double verticalFov) {
  scene.camera.kind = scene::Camera::Kind::Perspective;
  scene.camera.position = position;
  scene.camera.target = target;
  scene.camera.verticalFov = verticalFov;
}

scene::Medium& TestScene::box(const glm::dvec3& low, const glm::dvec3& high, double sigmaT, double albedo) {
  scene::Medium medium;
  medium.shape = scene::MediumShape::Box;
  medium.box = {low, high};
  medium.sigmaT = sigmaT;
  medium.albedo = glm::dvec3(albedo);
  scene.media.push_back(medium);
  volumes.uses.resize(scene.media.size());
  return scene.media.back();
}

scene::Medium& TestScene::sphere(const glm::dvec3& centre, double radius, double sigmaT, double albedo) {
  scene::Medium& medium = box({}, {}, sigmaT, albedo);
  medium.shape = scene::MediumShape::Sphere;
  medium.centre = centre;
  medium.radius = radius;
  return medium;
}

scene::Medium& TestScene::grid(const volume::BrickGrid& density, double densityScale, double albedo) {
  scene::Medium medium;
  medium.file = "hand-made";
  medium.grid = "density";
  medium.densityScale = densityScale;
  medium.albedo = glm::dvec3(albedo);
  scene.media.push_back(medium);
  volumes.uses.resize(scene.media.size());
  volumes.uses.back().density = volumes.grids.size();
  volumes.grids.push_back(density);
  return scene.media.back();
}

void TestScene::emissionGrid(const volume::BrickGrid& values, const scene::Emission& emission) {
  scene.media.back().emission = emission;
  scene.media.back().emission->grid = "emission";
  volumes.uses.back().emission = volumes.grids.size();
  volumes.grids.push_back(values);
}

void TestScene::point(const glm::dvec3& position, double intensity) {
  scene.lights.push_back({"point", scene::PointLight{position, glm::dvec3(intensity)}, true});
}

void TestScene::sun(const glm::dvec3& direction, double irradiance, double angularDiameter) {
  scene.lights.push_back(
      {"sun", scene::SunLight{glm::normalize(direction), glm::dvec3(irradiance), angularDiameter}, false});
}

void TestScene::constant(double radiance, bool visible) {
  scene.lights.push_back({"constant", scene::ConstantEnvironment{glm::dvec3(radiance)}, visible});
}

PathScene::PathScene(const glm::uvec2& size) : TestScene(size) { scene.render.depth = 0; }

geometry::Material& PathScene::material(const std::string& name, MaterialId model, double colour) {
  geometry::Material& made = scene.materials.emplace_back();
  made.name = name;
  made.model = model;
  made.colour = glm::dvec3(colour);
  return made;
}

geometry::Material& PathScene::lamp(const std::string& name, double radiance) {
  geometry::Material& made = material(name, MaterialId::Diffuse);
  made.emission = glm::dvec3(radiance);
  return made;
}

scene::Object& PathScene::object(const std::string& material, scene::Object::Kind kind) {
  scene::Object& made = scene.objects.emplace_back();
  made.kind = kind;
  made.material = material;
  volumes.meshes.uses.resize(scene.objects.size());
  return made;
}

scene::Object& PathScene::quad(const std::string& material, const glm::dvec3& origin, const glm::dvec3& edgeU,
                               const glm::dvec3& edgeV) {
  scene::Object& made = object(material, scene::Object::Kind::Quad);
  made.origin = origin;
  made.edgeU = edgeU;
  made.edgeV = edgeV;
  return made;
}

scene::Object& PathScene::ball(const std::string& material, const glm::dvec3& centre, double radius) {
  scene::Object& made = object(material, scene::Object::Kind::Sphere);
  made.centre = centre;
  made.radius = radius;
  return made;
}

scene::Object& PathScene::crate(const std::string& material, const glm::dvec3& low, const glm::dvec3& high) {
  scene::Object& made = object(material, scene::Object::Kind::Box);
  made.box = {low, high};
  return made;
}

scene::Object& PathScene::mesh(const std::string& material, const geometry::Mesh& mesh) {
  scene::Object& made = object(material, scene::Object::Kind::Mesh);
  volumes.meshes.uses.back() = volumes.meshes.models.size();
  geometry::Model& model = volumes.meshes.models.emplace_back();
  model.meshes.push_back(mesh);
  model.nodes.emplace_back();
  return made;
}

scene::Medium& PathScene::fill(double sigmaT, double albedo) {
  scene::Medium& medium = box({}, {}, sigmaT, albedo);
  medium.shape = scene::MediumShape::Objects;
  medium.name = "medium " + std::to_string(scene.media.size());
  scene.objects.back().medium = medium.name;
  return medium;
}

void PathScene::spot(const scene::SpotLight& light) { scene.lights.push_back({"spot", light, true}); }

scene::Phase henyeyGreenstein(double g) { return {PhaseId::HenyeyGreenstein, {g, 0.0, 0.0, 0.0}}; }

volume::BrickGrid gridOf(const glm::ivec3& size, const glm::ivec3& first, const glm::dmat4& worldFromIndex,
                         const VoxelFunction& value, volume::Storage storage) {
  std::vector<float> values;
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        values.push_back(static_cast<float>(value(first + glm::ivec3(x, y, z))));
      }
    }
  }
  return volume::gridFromDense(values, size, first, worldFromIndex, storage);
}

volume::BrickGrid constantGrid(int count, const glm::dvec3& low, const glm::dvec3& high, double value,
                               volume::Storage storage) {
  const glm::dvec3 voxel = (high - low) / double(count - 1);
  const glm::dmat4 worldFromIndex = glm::scale(glm::translate(glm::dmat4(1.0), low), voxel);
  return gridOf(
      glm::ivec3(count), glm::ivec3(0), worldFromIndex, [value](const glm::ivec3&) { return value; }, storage);
}

double puffDensity(const glm::dvec3& index) {
  const glm::dvec3 p = 2.0 * index / double(kPuffVoxels - 1) - 1.0;
  return std::max(0.0, 1.0 - glm::dot(p, p)) * (1.5 + std::sin(5.0 * p.x) * std::cos(4.0 * p.y + p.z));
}

volume::BrickGrid puffGrid(const glm::ivec3& first, volume::Storage storage) {
  const double voxel = 2.0 / (kPuffVoxels - 1);
  const glm::dmat4 worldFromIndex =
      glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0) - voxel * glm::dvec3(first)), glm::dvec3(voxel));
  return gridOf(
      glm::ivec3(kPuffVoxels), first, worldFromIndex,
      [first](const glm::ivec3& index) { return puffDensity(glm::dvec3(index - first)); }, storage);
}

std::vector<NamedMap> affineMaps() {
  const glm::dmat4 identity(1.0);
  const glm::dmat4 rotated = glm::rotate(identity, 0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
  glm::dmat4 sheared(1.0);
  sheared[1][0] = 0.4;
  sheared[2][1] = -0.3;
  const glm::dmat4 stretched = glm::scale(identity, glm::dvec3(1.0, 0.5, 1.7));
  return {{"identity", identity},
          {"translated", glm::translate(identity, glm::dvec3(-3.25, 7.5, 1.125))},
          {"rotated", rotated},
          {"sheared", sheared},
          {"non-uniform", stretched},
          {"mirrored", glm::scale(identity, glm::dvec3(-1.0, 1.0, 1.0))},
          {"all at once", glm::translate(identity, glm::dvec3(2.0, -1.0, 0.5)) * rotated * sheared * stretched}};
}

} // namespace tyndall::verify

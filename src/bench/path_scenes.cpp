// SPDX-License-Identifier: Apache-2.0
#include "bench/path_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::bench {
namespace {

using geometry::Material;
using geometry::Mesh;
using scene::Object;

constexpr double kFloorEdge = 20.0;
constexpr double kTotalIntensity = 1000.0; // W/sr of all lights together
constexpr double kQuadEdge = 0.05;
constexpr double kSunTilt = 0.5;

Material diffuse(const glm::dvec3& colour) {
  Material material;
  material.colour = colour;
  return material;
}

void addModel(BenchScene& scene, geometry::Model model) {
  Object object;
  object.file = "made";
  scene.scene.objects.push_back(object);
  scene.volumes.meshes.uses.push_back(scene.volumes.meshes.models.size());
  scene.volumes.meshes.models.push_back(std::move(model));
}

void addTriangle(Mesh& mesh, const glm::vec3 (&corners)[3], std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {corners[0], corners[1], corners[2]});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.materials.push_back(material);
}

void addQuad(Mesh& mesh, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v, std::uint32_t material) {
  addTriangle(mesh, {origin, origin + u, origin + u + v}, material);
  addTriangle(mesh, {origin, origin + u + v, origin + v}, material);
}

geometry::Model modelOf(Mesh mesh, std::vector<Material> materials) {
  geometry::Model model;
  model.meshes.push_back(std::move(mesh));
  model.nodes.emplace_back();
  model.materials = std::move(materials);
  return model;
}

enum WallMaterial : std::uint32_t { kWhite, kRed, kGreen, kLight };

std::uint32_t wallMaterial(const interop::BvhPrimitive& triangle, const RayScene& rays) {
  const auto all = [&](auto holds) { return holds(triangle.v0) && holds(triangle.v1) && holds(triangle.v2); };
  constexpr float kClose = 0.02f;
  if (all([&](const glm::vec3& v) {
        return glm::all(glm::greaterThan(v, rays.lightMin - kClose)) &&
               glm::all(glm::lessThan(v, rays.lightMax + kClose));
      })) {
    return kLight;
  }
  if (all([](const glm::vec3& v) { return v.x == -1.0f; })) {
    return kRed;
  }
  return all([](const glm::vec3& v) { return v.x == 1.0f; }) ? kGreen : kWhite;
}

/// Intensities [W/sr] towards a light's front.
std::vector<double> intensities(std::size_t count, std::mt19937& random) {
  std::lognormal_distribution<double> powers(0.0, 1.0);
  std::vector<double> values(count);
  double sum = 0.0;
  for (double& value : values) {
    value = powers(random);
    sum += value;
  }
  for (double& value : values) {
    value *= kTotalIntensity / sum;
  }
  return values;
}

glm::dvec3 lightPlace(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double x = kFloorEdge * (uniform(random) - 0.5);
  const double z = kFloorEdge * (uniform(random) - 0.5);
  return {x, 0.3 + 0.7 * uniform(random), z};
}

/// Each has a material of its own. They shine downwards: the camera above sees none of them directly, which would be
/// noise of the picture's sampling and not of the choice.
void addEmissiveQuads(BenchScene& scene, std::size_t count, std::mt19937& random) {
  constexpr float kTilt = 0.2f;
  std::normal_distribution<float> normal;
  Mesh mesh;
  std::vector<Material> materials;
  for (const double intensity : intensities(count, random)) {
    const glm::vec3 place(lightPlace(random));
    const glm::vec3 down = glm::normalize(glm::vec3(kTilt * normal(random), -1.0f, kTilt * normal(random)));
    const glm::vec3 u = glm::normalize(glm::cross(glm::vec3(0.0f, 0.0f, 1.0f), down));
    const glm::vec3 v = glm::cross(down, u);
    Material material = diffuse(glm::dvec3(0.0));
    material.emission = glm::dvec3(intensity / (kQuadEdge * kQuadEdge));
    addQuad(mesh, place, float(kQuadEdge) * u, float(kQuadEdge) * v, static_cast<std::uint32_t>(materials.size()));
    materials.push_back(material);
  }
  addModel(scene, modelOf(std::move(mesh), std::move(materials)));
}

} // namespace

BenchScene surfaceScene(const RayScene& rays, std::uint32_t size) {
  BenchScene result;
  scene::Scene& scene = result.scene;
  scene.film.size = glm::uvec2(size);
  scene.camera.position = glm::dvec3(rays.camera);
  scene.camera.target = scene.camera.position - glm::dvec3(0.0, 0.0, 1.0);
  scene.camera.verticalFov = glm::degrees(2.0 * std::atan(double(rays.tangent)));
  scene.render.depth = 0;
  Mesh mesh;
  bool lit = false;
  for (const geometry::BvhInput& input : rays.triangles) {
    const std::uint32_t material = wallMaterial(input.primitive, rays);
    addTriangle(mesh, {input.primitive.v0, input.primitive.v1, input.primitive.v2}, material);
    lit = lit || material == kLight;
  }
  if (!lit) {
    const glm::vec3 edge = rays.lightMax - rays.lightMin;
    addQuad(mesh, rays.lightMin, {edge.x, 0.0f, 0.0f}, {0.0f, 0.0f, edge.z}, kLight);
  }
  std::vector<Material> materials{diffuse(glm::dvec3(0.73)), diffuse({0.63, 0.06, 0.05}), diffuse({0.14, 0.45, 0.09}),
                                  diffuse(glm::dvec3(0.0))};
  materials[kLight].emission = glm::dvec3(15.0);
  addModel(result, modelOf(std::move(mesh), std::move(materials)));
  return result;
}

void addFog(BenchScene& scene, double sigmaT) {
  scene::Medium fog;
  fog.shape = scene::MediumShape::Box;
  fog.box = {glm::dvec3(-1.0), glm::dvec3(1.0)};
  fog.sigmaT = sigmaT;
  fog.albedo = glm::dvec3(0.9);
  scene.scene.media.push_back(fog);
  scene.volumes.uses.emplace_back();
}

BenchScene mistScene(std::uint32_t size) {
  BenchScene result;
  result.scene.film.size = glm::uvec2(size);
  result.scene.camera.position = glm::dvec3(0.0, 0.0, 4.0);
  result.scene.camera.verticalFov = 35.0;
  result.scene.render.depth = 0;
  addFog(result, 1.0);
  scene::SunLight sun;
  sun.direction = glm::normalize(glm::dvec3(-kSunTilt, -1.0, -kSunTilt));
  sun.angularDiameter = 0.0;
  result.scene.lights.push_back({"sun", sun, false});
  return result;
}

void addFarSurface(BenchScene& scene) {
  Mesh mesh;
  const glm::vec3 place(scene.scene.camera.target + 10.0 * (scene.scene.camera.position - scene.scene.camera.target));
  const float edge = 1e-4f * glm::length(place);
  addTriangle(mesh, {place, place + glm::vec3(edge, 0.0f, 0.0f), place + glm::vec3(0.0f, edge, 0.0f)}, 0);
  addModel(scene, modelOf(std::move(mesh), {diffuse(glm::dvec3(0.5))}));
}

void repeatMedium(BenchScene& scene, int copies) {
  const Bounds3 bounds = scene.volumes.grids.front().worldBounds();
  const double pitch = 1.2 * bounds.size().x;
  for (int i = 0; i < copies; ++i) {
    const glm::dvec3 shift(pitch * (double(i) - 0.5 * double(copies - 1)), 0.0, 0.0);
    scene.scene.media.front().instances.push_back(glm::translate(glm::dmat4(1.0), shift));
  }
  scene::Camera& camera = scene.scene.camera;
  camera.position = camera.target + 0.25 * double(copies) * (camera.position - camera.target);
}

const char* lightSceneName(LightScene kind) {
  return kind == LightScene::PointsOverFloor ? "points over a floor" : "squares in mist over a floor";
}

BenchScene lightsScene(LightScene kind, std::size_t count, std::uint32_t size) {
  BenchScene result;
  scene::Scene& scene = result.scene;
  scene.film.size = glm::uvec2(size);
  scene.camera.position = glm::dvec3(0.0, 9.0, 17.0);
  scene.camera.verticalFov = 45.0;
  scene.render.depth = 0;
  Object floor;
  floor.kind = Object::Kind::Quad;
  floor.origin = {-0.5 * kFloorEdge, 0.0, 0.5 * kFloorEdge};
  floor.edgeU = {kFloorEdge, 0.0, 0.0};
  floor.edgeV = {0.0, 0.0, -kFloorEdge};
  scene.objects.push_back(floor);
  result.volumes.meshes.uses.emplace_back();
  std::mt19937 random(7);
  if (kind == LightScene::QuadsInMist) {
    addEmissiveQuads(result, count, random);
    scene::Medium mist;
    mist.shape = scene::MediumShape::Box;
    mist.box = {{-0.5 * kFloorEdge, -0.1, -0.5 * kFloorEdge}, {0.5 * kFloorEdge, 2.0, 0.5 * kFloorEdge}};
    mist.sigmaT = 0.5 / kFloorEdge;
    mist.albedo = glm::dvec3(0.9);
    scene.media.push_back(mist);
    result.volumes.uses.emplace_back();
    return result;
  }
  for (const double intensity : intensities(count, random)) {
    scene.lights.push_back({"lamp", scene::PointLight{lightPlace(random), glm::dvec3(intensity)}, true});
  }
  return result;
}

} // namespace tyndall::bench

// SPDX-License-Identifier: Apache-2.0
#include "support/path_scenes.h"

#include <cmath>

namespace tyndall::test {

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

MomentOptions byPaths(MomentOptions options) {
  options.estimator.method = render::Method::Path;
  return options;
}

std::vector<MomentOptions> eachTechnique(const MomentOptions& options) {
  std::vector<MomentOptions> result;
  for (const std::uint32_t techniques : {interop::kTechniqueLight, interop::kTechniqueDirection,
                                         interop::kTechniqueLight | interop::kTechniqueDirection}) {
    result.push_back(byPaths(options));
    result.back().estimator.techniques = techniques;
  }
  return result;
}

std::string techniqueOf(const MomentOptions& options) {
  const char* const techniques[] = {"none", "light", "direction", "both"};
  const char* const selections[] = {"tree", "power", "uniform"};
  return std::string(techniques[options.estimator.techniques]) + ", selected by " +
         selections[options.estimator.lightSelection];
}

Verdict channelTest(const Moments& a, int channelA, const Moments& b, int channelB) {
  const film::SampleSummary first = a.image(channelA);
  const film::SampleSummary second = b.image(channelB);
  const film::TestResult test = film::welchTest(first, second);
  Verdict verdict;
  verdict.familyP = test.p;
  verdict.worstT = test.statistic;
  const double error = std::sqrt(first.variance / first.count + second.variance / second.count);
  const double scale = 0.5 * (std::abs(first.mean) + std::abs(second.mean));
  verdict.bias = scale > 0.0 ? (first.mean - second.mean) / scale : 0.0;
  verdict.resolution = scale > 0.0 ? error / scale : 0.0;
  return verdict;
}

Verdict channelTest(const Moments& a, const Moments& b, int channel) { return channelTest(a, channel, b, channel); }

} // namespace tyndall::test

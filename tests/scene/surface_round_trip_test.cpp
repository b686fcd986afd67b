// SPDX-License-Identifier: Apache-2.0
// Spot lights, lenses, depth, instances, materials and objects arrive, and read back to the last bit.
#include "scene/support.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace tyndall::scene {
namespace {

using test::everything;
using test::listed;
using test::parse;

TEST(SurfaceValues, CameraLightsAndMediaArrive) {
  const LoadResult result = parse(everything());
  ASSERT_TRUE(result.problems.empty()) << listed(result);
  const Scene& scene = result.scene;
  EXPECT_EQ(scene.camera.lensRadius, 0.0625);
  EXPECT_EQ(scene.camera.focusDistance, 9.75);
  EXPECT_EQ(scene.render.depth, 12u);
  const auto& beam = std::get<SpotLight>(scene.lights[5].light);
  EXPECT_EQ(beam.position, glm::dvec3(3, 2, 1));
  EXPECT_EQ(beam.direction, glm::dvec3(0, 0, -1));
  EXPECT_EQ(beam.intensity, glm::dvec3(5, 6, 7));
  EXPECT_EQ(beam.outerAngle, 15.0);
  EXPECT_EQ(beam.innerAngle, 12.5);
  EXPECT_EQ(scene.media[0].extinctionColour, glm::dvec3(1, 0.5, 0.25));
  EXPECT_EQ(scene.media[1].extinctionColour, glm::dvec3(1));
  ASSERT_EQ(scene.media[0].instances.size(), 2u);
  EXPECT_EQ(scene.media[0].instances[0], glm::dmat4(1.0));
  const glm::dvec4 image = scene.media[0].instances[1] * glm::dvec4(0, 0, 0, 1);
  EXPECT_LT(glm::length(image - glm::dvec4(std::sqrt(2.0), 0, -std::sqrt(2.0), 1)), 1e-14)
      << "moved, then halved, then turned about +y";
  EXPECT_TRUE(scene.media[1].instances.empty());
  EXPECT_EQ(scene.media[5].shape, MediumShape::Objects);
}

TEST(SurfaceValues, MaterialsArrive) {
  const std::vector<geometry::Material> materials = parse(everything()).scene.materials;
  ASSERT_EQ(materials.size(), 5u);
  EXPECT_EQ(materials[0].model, MaterialId::Null);
  EXPECT_EQ(materials[1].model, MaterialId::Diffuse);
  EXPECT_EQ(materials[1].name, "wall");
  EXPECT_EQ(materials[1].colour, glm::dvec3(0.7, 0.6, 0.5));
  EXPECT_EQ(materials[1].opacity, 0.75);
  EXPECT_EQ(materials[1].alpha, geometry::Alpha::Blend) << "rays pass what is not opaque";
  EXPECT_EQ(materials[1].emission, glm::dvec3(10, 20, 30));
  EXPECT_TRUE(materials[1].twoSided);
  EXPECT_EQ(materials[2].model, MaterialId::Conductor);
  EXPECT_EQ(materials[2].alpha, geometry::Alpha::Opaque);
  EXPECT_EQ(materials[2].roughness, 0.3);
  EXPECT_EQ(materials[2].eta, glm::dvec3(0.14, 0.37, 1.44));
  EXPECT_EQ(materials[2].k, glm::dvec3(3.98, 2.38, 1.6));
  EXPECT_EQ(materials[3].model, MaterialId::Dielectric);
  EXPECT_EQ(materials[3].ior, 1.33);
  EXPECT_EQ(materials[3].roughness, 0.05);
  EXPECT_EQ(materials[3].colour, glm::dvec3(1)) << "glass without a colour tints nothing";
  EXPECT_EQ(materials[4].model, MaterialId::MetalRough);
  EXPECT_EQ(materials[4].colour, glm::dvec3(0.2));
  EXPECT_EQ(materials[4].metallic, 0.6);
  EXPECT_EQ(materials[4].roughness, 0.4);
  EXPECT_EQ(materials[4].ior, 1.6);
}

TEST(SurfaceValues, ObjectsArrive) {
  const std::vector<Object> objects = parse(everything()).scene.objects;
  ASSERT_EQ(objects.size(), 4u);
  EXPECT_EQ(objects[0].kind, Object::Kind::Mesh);
  EXPECT_EQ(objects[0].name, "room");
  EXPECT_EQ(objects[0].file, (test::folder() / "room.glb").string());
  EXPECT_FALSE(objects[0].lights);
  const glm::dvec4 corner = objects[0].worldFromObject * glm::dvec4(1, 1, 1, 1);
  EXPECT_LT(glm::length(corner - glm::dvec4(-2, -2, 3, 1)), 1e-14) << "scaled, then moved, then turned about +z";
  ASSERT_EQ(objects[0].instances.size(), 2u);
  EXPECT_EQ(objects[0].instances[0], glm::translate(glm::dmat4(1.0), glm::dvec3(1, 0, 0)));
  EXPECT_TRUE(objects[0].material.empty());
  EXPECT_EQ(objects[1].kind, Object::Kind::Quad);
  EXPECT_EQ(objects[1].material, "wall");
  EXPECT_EQ(objects[1].origin, glm::dvec3(1, 2, 3));
  EXPECT_EQ(objects[1].edgeU, glm::dvec3(0, 1, 0));
  EXPECT_EQ(objects[1].edgeV, glm::dvec3(0, 0, 1));
  EXPECT_EQ(objects[2].kind, Object::Kind::Box);
  EXPECT_EQ(objects[2].box.min, glm::dvec3(-1, -2, -3));
  EXPECT_EQ(objects[2].box.max, glm::dvec3(1, 2, 3));
  EXPECT_EQ(objects[2].medium, "tea");
  EXPECT_EQ(objects[2].priority, 7u);
  EXPECT_EQ(objects[3].kind, Object::Kind::Sphere);
  EXPECT_EQ(objects[3].centre, glm::dvec3(0.5, 0.25, 0));
  EXPECT_EQ(objects[3].radius, 0.125);
}

TEST(SurfaceValues, DepthFollowsTheObjectsUnlessItIsGiven) {
  EXPECT_EQ(parse("{}").scene.depth(), 1u);
  EXPECT_EQ(parse(R"({"objects": [{"type": "quad"}]})").scene.depth(), 0u);
  EXPECT_EQ(parse(R"({"objects": [{"type": "quad"}], "render": {"depth": null}})").scene.depth(), 0u);
  EXPECT_EQ(parse(R"({"objects": [{"type": "quad"}], "render": {"depth": 3}})").scene.depth(), 3u);
  EXPECT_EQ(parse(R"({"render": {"depth": 0}})").scene.render.depth, 0u) << "unlimited, on purpose";
  for (const char* depth : {"null", "0", "1", "65536"}) {
    const LoadResult first = parse(everything(), {{"render.depth", depth}});
    ASSERT_TRUE(first.ok()) << listed(first);
    EXPECT_EQ(parse(first.canonical).scene.render.depth, first.scene.render.depth) << depth;
  }
}

TEST(SurfaceValues, ANarrowSpotNeedsNoInnerAngle) {
  const LoadResult result = parse(R"({"lights": [{"type": "spot", "outer_angle": 5}, {"type": "spot"}]})");
  ASSERT_TRUE(result.ok()) << listed(result);
  EXPECT_EQ(std::get<SpotLight>(result.scene.lights[0].light).innerAngle, 5.0);
  EXPECT_EQ(std::get<SpotLight>(result.scene.lights[1].light).innerAngle, SpotLight{}.innerAngle);
}

/// Numbers with all their bits set anyhow.
class Numbers {
public:
  double fraction() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  glm::dvec3 three() { return {fraction(), fraction(), fraction()}; }
  /// A rotation, a scale and a translation: spheres stay spheres.
  glm::dmat4 similarity() {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), fraction(), glm::normalize(three() + 0.01));
    return glm::scale(glm::translate(glm::dmat4(1.0), three()), glm::dvec3(0.1 + fraction())) * turned;
  }

private:
  std::mt19937 random_{11};
};

void scramble(Scene& scene, Numbers& numbers) {
  scene.camera.lensRadius = numbers.fraction();
  scene.camera.focusDistance = numbers.fraction();
  auto& beam = std::get<SpotLight>(scene.lights[5].light);
  beam = {numbers.three(), glm::normalize(numbers.three()), numbers.three(), 45.0 + numbers.fraction(),
          45.0 * numbers.fraction()};
  scene.media[0].extinctionColour = numbers.three();
  scene.media[0].instances = {numbers.similarity(), numbers.similarity()};
  for (geometry::Material& material : scene.materials) {
    material.colour = numbers.three();
    material.eta = numbers.three();
    material.k = numbers.three();
    material.emission = numbers.three();
    material.roughness = numbers.fraction();
    material.metallic = numbers.fraction();
    material.opacity = numbers.fraction();
    material.ior = 1.0 + numbers.fraction();
  }
  for (Object& object : scene.objects) {
    object.worldFromObject = numbers.similarity();
    object.instances = {numbers.similarity(), numbers.similarity(), numbers.similarity()};
    object.origin = numbers.three();
    object.edgeU = numbers.three();
    object.edgeV = numbers.three();
    object.box = {-numbers.three(), numbers.three()};
    object.centre = numbers.three();
    object.radius = numbers.fraction();
  }
}

void expectSameMaterial(const geometry::Material& read, const geometry::Material& written) {
  const auto has = [&](std::initializer_list<MaterialId> models) {
    return std::find(models.begin(), models.end(), written.model) != models.end();
  };
  EXPECT_EQ(read.model, written.model);
  if (has({MaterialId::Null})) {
    return;
  }
  EXPECT_EQ(read.colour, written.colour);
  EXPECT_EQ(read.emission, written.emission);
  EXPECT_EQ(read.opacity, written.opacity);
  EXPECT_EQ(read.twoSided, written.twoSided);
  if (has({MaterialId::Conductor})) {
    EXPECT_EQ(read.eta, written.eta);
    EXPECT_EQ(read.k, written.k);
  }
  if (has({MaterialId::Conductor, MaterialId::Dielectric, MaterialId::MetalRough})) {
    EXPECT_EQ(read.roughness, written.roughness);
  }
  if (has({MaterialId::Dielectric, MaterialId::MetalRough})) {
    EXPECT_EQ(read.ior, written.ior);
  }
  if (has({MaterialId::MetalRough})) {
    EXPECT_EQ(read.metallic, written.metallic);
  }
}

void expectSameObject(const Object& read, const Object& written) {
  EXPECT_EQ(read.kind, written.kind);
  EXPECT_EQ(read.worldFromObject, written.worldFromObject);
  EXPECT_EQ(read.instances, written.instances);
  EXPECT_EQ(read.material, written.material);
  EXPECT_EQ(read.medium, written.medium);
  EXPECT_EQ(read.priority, written.priority);
  switch (written.kind) {
  case Object::Kind::Mesh:
    EXPECT_EQ(read.file, written.file);
    EXPECT_EQ(read.lights, written.lights);
    break;
  case Object::Kind::Quad:
    EXPECT_EQ(read.origin, written.origin);
    EXPECT_EQ(read.edgeU, written.edgeU);
    EXPECT_EQ(read.edgeV, written.edgeV);
    break;
  case Object::Kind::Box:
    EXPECT_EQ(read.box.min, written.box.min);
    EXPECT_EQ(read.box.max, written.box.max);
    break;
  case Object::Kind::Sphere:
    EXPECT_EQ(read.centre, written.centre);
    EXPECT_EQ(read.radius, written.radius);
    break;
  }
}

TEST(SurfaceRoundTrip, EveryFieldSurvivesToTheLastBit) {
  Scene scene = parse(everything()).scene;
  scene.animation = {}; // its tracks would move what is scrambled
  Numbers numbers;
  for (int round = 0; round < 50; ++round) {
    scramble(scene, numbers);
    const LoadResult result = parse(toJson(scene));
    ASSERT_TRUE(result.ok()) << listed(result);
    const Scene& read = result.scene;
    EXPECT_EQ(read.camera.lensRadius, scene.camera.lensRadius);
    EXPECT_EQ(read.camera.focusDistance, scene.camera.focusDistance);
    const auto& beam = std::get<SpotLight>(read.lights[5].light);
    const auto& written = std::get<SpotLight>(scene.lights[5].light);
    EXPECT_EQ(beam.position, written.position);
    EXPECT_EQ(beam.direction, written.direction);
    EXPECT_EQ(beam.intensity, written.intensity);
    EXPECT_EQ(beam.outerAngle, written.outerAngle);
    EXPECT_EQ(beam.innerAngle, written.innerAngle);
    EXPECT_EQ(read.media[0].extinctionColour, scene.media[0].extinctionColour);
    EXPECT_EQ(read.media[0].instances, scene.media[0].instances);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
      expectSameMaterial(read.materials[i], scene.materials[i]);
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      expectSameObject(read.objects[i], scene.objects[i]);
    }
  }
}

TEST(SurfaceRoundTrip, CanonicalTellsEveryValueApart) {
  const std::string canonical = parse(everything()).canonical;
  const std::vector<Override> changes{
      {"camera.lens_radius", "0.5"},         {"camera.focus_distance", "5"},  {"render.depth", "null"},
      {"lights.beam.inner_angle", "3"},      {"media.smoke.instances", "[]"}, {"media.smoke.extinction_colour", "1"},
      {"materials.wall.two_sided", "false"}, {"materials.gold.k", "1"},       {"materials.paint.metallic", "0"},
      {"objects.room.lights", "true"},       {"objects.cup.priority", "8"},   {"objects.ball.material", "glass"},
      {"objects.ball.instances", "[[], []]"}};
  for (const Override& change : changes) {
    const LoadResult changed = parse(everything(), {change});
    EXPECT_TRUE(changed.ok()) << listed(changed);
    EXPECT_NE(changed.canonical, canonical) << change.path;
  }
}

} // namespace
} // namespace tyndall::scene

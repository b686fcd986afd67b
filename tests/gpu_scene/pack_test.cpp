// SPDX-License-Identifier: Apache-2.0
// Packing: scene values to device structs, without a device.
#include "gpu_scene/lights.h"
#include "gpu_scene/media.h"
#include "gpu_scene/raster.h"
#include "volume/load.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::gpu_scene {
namespace {

scene::NamedLight named(scene::Light light) { return {"light", std::move(light), true}; }

scene::Scene lit(std::vector<scene::Light> lights) {
  scene::Scene scene;
  for (scene::Light& light : lights) {
    scene.lights.push_back(named(std::move(light)));
  }
  return scene;
}

Bounds3 unitBounds() { return {glm::dvec3(-1.0), glm::dvec3(1.0)}; }

glm::dvec3 apply(const glm::mat4x3& map, const glm::dvec3& point) {
  return glm::dvec3(map * glm::vec4(glm::vec3(point), 1.0f));
}

TEST(PackCamera, CornersOfThePictureAreWhereTheyShouldBe) {
  scene::Camera camera;
  camera.position = {10.0, 0.0, 5.0};
  camera.target = {10.0, 0.0, 0.0};
  camera.verticalFov = 90.0;
  const interop::Camera packed = packCamera(camera, {200, 100}, {10.0, 0.0, 0.0});
  EXPECT_NEAR(glm::distance(packed.origin, glm::vec3(0.0f, 0.0f, 5.0f)), 0.0f, 1e-6f);
  // Top left: half an image up and, at twice the width, a whole one to the left.
  EXPECT_NEAR(glm::distance(packed.corner, glm::vec3(-2.0f, 1.0f, -1.0f)), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::distance(packed.corner + packed.rasterX + packed.rasterY, glm::vec3(2.0f, -1.0f, -1.0f)), 0.0f,
              1e-6f);
}

/// Largest distance in the picture, in its heights and widths, between where rays leave it and where the camera `seer`
/// sees points along them.
float rasterError(const scene::Camera& camera, const scene::Camera& seer) {
  const glm::uvec2 size(200, 100);
  const glm::dvec3 centre(10.0, -1.0, 0.0);
  const interop::Camera packed = packCamera(camera, size, centre);
  const glm::mat4x3 raster = rasterFromWorld(seer, size, centre);
  const bool perspective = camera.kind == scene::Camera::Kind::Perspective;
  float worst = 0.0f;
  for (const glm::vec2 place : {glm::vec2(0.0f), glm::vec2(0.9f, 0.3f), glm::vec2(0.4f, 1.0f)}) {
    for (const float distance : {0.1f, 4.0f}) {
      const glm::vec3 offset = place.x * packed.rasterX + place.y * packed.rasterY;
      const glm::vec3 point = perspective ? packed.origin + distance * (packed.corner + offset)
                                          : packed.origin + offset + distance * packed.corner;
      const glm::vec3 seen = raster * glm::vec4(point, 1.0f);
      EXPECT_GT(seen.z, 0.0f);
      worst = std::max(worst, glm::distance(glm::vec2(seen) / seen.z, place));
    }
  }
  return worst;
}

/// 1e-4: a hundredth of a pixel of this picture. Another camera's map is seen.
TEST(Raster, PointsAreSeenWhereTheirRaysLeave) {
  scene::Camera camera;
  camera.position = {11.0, 2.0, 5.0};
  camera.target = {10.0, 0.5, 0.0};
  for (const scene::Camera::Kind kind : {scene::Camera::Kind::Perspective, scene::Camera::Kind::Orthographic}) {
    camera.kind = kind;
    EXPECT_LT(rasterError(camera, camera), 1e-4f);
    scene::Camera moved = camera;
    moved.position.x += 0.01;
    EXPECT_GT(rasterError(camera, moved), 1e-4f) << "the planted camera was not seen";
  }
}

TEST(PackGrid, VoxelSpaceIsIndexSpaceFromTheFirstVoxelOn) {
  const glm::dmat4 worldFromIndex =
      glm::translate(glm::dmat4(1.0), glm::dvec3(1e5, 0.0, 0.0)) * glm::scale(glm::dmat4(1.0), glm::dvec3(0.5));
  const volume::BrickGrid grid =
      volume::gridFromDense(std::vector<float>(27, 1.0f), glm::ivec3(3), {-1, 4, 20}, worldFromIndex);
  const glm::dvec3 centre(1e5, 0.0, 0.0);
  const interop::Grid packed = packGrid(grid, glm::dmat4(1.0), centre);
  const glm::dvec3 index(0.25, 5.5, 21.0);
  const glm::dvec3 world(worldFromIndex * glm::dvec4(index, 1.0));
  EXPECT_NEAR(glm::distance(apply(packed.voxelFromWorld, world - centre), index - glm::dvec3(grid.firstVoxel)), 0.0,
              1e-5);
  EXPECT_EQ(packed.boundsMin, glm::vec3(grid.indexBounds().min - glm::dvec3(grid.firstVoxel)));
  EXPECT_EQ(packed.brickCount, grid.brickCount);
}

TEST(PackLights, ProbabilitiesAreThoseOfADistribution) {
  const scene::Scene scene =
      lit({scene::PointLight{{2.0, 0.0, 0.0}, glm::dvec3(3.0)}, scene::PointLight{{0.0, 9.0, 0.0}, glm::dvec3(1e-9)},
           scene::SunLight{}, scene::SunLight{{1.0, 0.0, 0.0}, glm::dvec3(1e12), 0.0}, scene::ConstantEnvironment{}});
  const PackedLights lights = packLights(scene, unitBounds(), glm::dvec3(0.0));
  double points = 0.0;
  double equiangular = 0.0;
  double all = 0.0;
  for (const interop::PointLight& light : lights.points) {
    EXPECT_GT(light.selectPdf, 0.0f);
    EXPECT_GT(light.equiangularPdf, 0.0f);
    points += double(light.selectPdf);
    equiangular += double(light.equiangularPdf);
  }
  all = points;
  for (const interop::DistantLight& light : lights.distant) {
    EXPECT_GT(light.selectPdf, 0.0f);
    all += double(light.selectPdf);
  }
  EXPECT_NEAR(all, 1.0, 1e-5);
  EXPECT_NEAR(equiangular, 1.0, 1e-5);
  EXPECT_NEAR(points, double(lights.pointShare), 1e-6);
  EXPECT_TRUE(lights.deltas);
  EXPECT_TRUE(lights.areas);
}

TEST(PackLights, BlackOnesAreLeftOut) {
  const scene::Scene scene =
      lit({scene::PointLight{{0.0, 0.0, 0.0}, glm::dvec3(0.0)}, scene::SunLight{{0.0, -1.0, 0.0}, glm::dvec3(0.0), 0.5},
           scene::ConstantEnvironment{glm::dvec3(0.0)}});
  const PackedLights lights = packLights(scene, unitBounds(), glm::dvec3(0.0));
  EXPECT_TRUE(lights.points.empty());
  EXPECT_TRUE(lights.distant.empty());
  EXPECT_FALSE(lights.background);
}

TEST(PackLights, DiscOfASunHasItsIrradiance) {
  for (const double diameter : {0.01, 0.53, 10.0, 120.0}) {
    const PackedLights lights =
        packLights(lit({scene::SunLight{{0.0, -1.0, 0.0}, glm::dvec3(7.0), diameter}}), unitBounds(), glm::dvec3(0.0));
    const interop::DistantLight& sun = lights.distant.front();
    // Irradiance on the plane across the axis: 2 pi L times the integral of cosines from cos(half angle) to 1.
    const double m = double(sun.oneMinusCos);
    EXPECT_NEAR(double(sun.radiance.x) * std::numbers::pi * m * (2.0 - m) / 7.0, 1.0, 1e-6) << diameter;
  }
}

TEST(PackMedia, HomogeneousOnesComeFirstAndEmptyGridsNotAtAll) {
  scene::Scene scene;
  VolumeSet volumes;
  volumes.grids.push_back(volume::gridFromDense({1.0f}, glm::ivec3(1), glm::ivec3(0), glm::dmat4(1.0)));
  volumes.grids.push_back(volume::BrickGrid{});
  scene::Medium grid;
  grid.file = "grid.vdb";
  scene::Medium empty = grid;
  scene::Medium box;
  box.shape = scene::MediumShape::Box;
  box.sigmaT = 0.25;
  box.box = unitBounds();
  scene.media = {grid, empty, box};
  volumes.uses = {{0, {}}, {1, {}}, {}};
  const PackedMedia packed = packMedia(scene, volumes, glm::dvec3(0.0));
  ASSERT_EQ(packed.media.size(), 2u);
  EXPECT_EQ(packed.homogeneousCount, 1u);
  EXPECT_EQ(packed.media[0].sigmaT, 0.25f);
  EXPECT_EQ(packed.media[1].densityGrid, 0u);
}

TEST(PackMedia, EmissionMaximaCoverTheStrongestValue) {
  scene::Scene scene;
  VolumeSet volumes;
  volumes.grids.push_back(volume::gridFromDense({300.0f, 2500.0f}, {2, 1, 1}, glm::ivec3(0), glm::dmat4(1.0)));
  scene::Medium fire;
  fire.file = "fire.vdb";
  fire.grid = "none";
  fire.emission.emplace();
  fire.emission->kind = scene::Emission::Kind::Blackbody;
  fire.emission->grid = "temperature";
  scene.media = {fire};
  volumes.uses = {{{}, 0}};
  const PackedMedia packed = packMedia(scene, volumes, glm::dvec3(0.0));
  ASSERT_EQ(packed.placements.size(), 1u);
  EXPECT_EQ(packed.media[0].densityGrid, interop::kNoGrid);
  EXPECT_GT(packed.placements[0].coarseMaxima[0], 0.0f);
  EXPECT_EQ(packed.emissive, std::vector<std::uint32_t>{0});
}

// Fails if corners are uploaded as given: at 1e5 units a float resolves 0.008.
TEST(PackMedia, ShapesFarFromTheOriginKeepTheirSize) {
  scene::Scene scene;
  scene::Medium medium;
  medium.shape = scene::MediumShape::Box;
  medium.box = {glm::dvec3(1e5 - 0.001), glm::dvec3(1e5 + 0.001)};
  scene.media.push_back(medium);
  VolumeSet volumes;
  volumes.uses.resize(1);
  const PackedMedia packed = packMedia(scene, volumes, medium.box.centre());
  ASSERT_EQ(packed.media.size(), 1u);
  EXPECT_NEAR(packed.media[0].shapeMax.x - packed.media[0].shapeMin.x, 0.002f, 1e-7f);
  EXPECT_NEAR(glm::length(apply(packed.media[0].mediumFromWorld, glm::dvec3(0.0))), 0.0, 1e-6);
}

// A volume set may hold a temperature grid for a medium that does not glow.
TEST(PackMedia, TemperatureWithoutEmissionIsLeftOut) {
  scene::Scene scene;
  scene::Medium medium;
  medium.file = "cold.vdb";
  scene.media.push_back(medium);
  VolumeSet volumes;
  volumes.grids.push_back(
      volume::gridFromDense(std::vector<float>(27, 1.0f), glm::ivec3(3), glm::ivec3(0), glm::dmat4(1.0)));
  volumes.uses.push_back({std::size_t{0}, std::size_t{0}});
  const PackedMedia packed = packMedia(scene, volumes, glm::dvec3(0.0));
  ASSERT_EQ(packed.media.size(), 1u);
  EXPECT_EQ(packed.media[0].emissionGrid, interop::kNoGrid);
  EXPECT_TRUE(packed.emissive.empty());
}

// Float directions would lose up to half of the samples of such a disc at its rim.
TEST(PackLights, SunsTooSmallForFloatDirectionsLightFromOneDirection) {
  scene::SunLight sun;
  sun.angularDiameter = 0.001;
  EXPECT_EQ(packLights(lit({sun}), unitBounds(), glm::dvec3(0.0)).distant[0].kind, interop::kDistantDelta);
  sun.angularDiameter = 0.53;
  EXPECT_EQ(packLights(lit({sun}), unitBounds(), glm::dvec3(0.0)).distant[0].kind, interop::kDistantDisc);
}

} // namespace
} // namespace tyndall::gpu_scene

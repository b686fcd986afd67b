// SPDX-License-Identifier: Apache-2.0
#include "bench/scenes.h"

#include "volume/depth.h"
#include "volume/generate.h"
#include "volume/load.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

constexpr unsigned kDepthLines = 4096;

/// The volume, no light. `distance` of the camera in radii of the volume.
BenchScene bareScene(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size, double distance) {
  const Bounds3 bounds = grid.worldBounds();
  const double radius = 0.5 * glm::length(bounds.size());
  BenchScene result;
  scene::Scene& scene = result.scene;
  scene.film.size = glm::uvec2(size);
  scene.camera.target = bounds.centre();
  scene.camera.position = bounds.centre() + glm::dvec3(0.0, 0.0, distance * radius);
  scene.camera.verticalFov = 30.0;
  scene::Medium medium;
  medium.file = "measured";
  medium.grid = grid.name;
  medium.albedo = glm::dvec3(0.9);
  medium.densityScale = opticalDepth / volume::medianOpticalDepth(grid, kDepthLines);
  medium.phase.id = PhaseId::HenyeyGreenstein;
  medium.phase.parameters[0] = 0.3;
  scene.media.push_back(medium);
  result.volumes.grids.push_back(grid);
  result.volumes.uses.push_back({std::size_t{0}, std::nullopt});
  return result;
}

} // namespace

BenchScene sunScene(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size) {
  BenchScene result = bareScene(grid, opticalDepth, size, 3.0);
  scene::SunLight sun;
  sun.direction = glm::normalize(glm::dvec3(-0.5, -0.7, -0.5));
  sun.angularDiameter = 0.0;
  result.scene.lights.push_back({"sun", sun, false});
  return result;
}

BenchScene foggyPointScene(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size) {
  constexpr double kDistance = 3.6;
  BenchScene result = bareScene(grid, opticalDepth, size, kDistance);
  const Bounds3 bounds = grid.worldBounds();
  const double radius = 0.5 * glm::length(bounds.size());
  scene::Medium fog;
  fog.shape = scene::MediumShape::Box;
  fog.box = {bounds.centre() - 2.0 * radius, bounds.centre() + 2.0 * radius};
  fog.sigmaT = 0.2 / (2.0 * radius);
  fog.albedo = glm::dvec3(0.9);
  fog.phase = result.scene.media.front().phase;
  result.scene.media.push_back(fog);
  result.volumes.uses.emplace_back();
  // In the plane through the centre that faces the camera, just clear of the volume and still in the picture.
  const double halfHeight = kDistance * radius * std::tan(0.5 * glm::radians(result.scene.camera.verticalFov));
  const glm::dvec2 offset(-std::min(0.5 * bounds.size().x + 0.12 * radius, 0.9 * halfHeight), 0.3 * radius);
  result.scene.lights.push_back(
      {"lamp", scene::PointLight{bounds.centre() + glm::dvec3(offset, 0.0), glm::dvec3(radius * radius)}, true});
  result.lightPixel = 0.5 * double(size) * (glm::dvec2(1.0) + glm::dvec2(offset.x, -offset.y) / halfHeight);
  return result;
}

BenchScene skyScene(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size) {
  BenchScene result = bareScene(grid, opticalDepth, size, 3.0);
  scene::SkyEnvironment sky;
  sky.sunDirection = glm::normalize(glm::dvec3(-0.5, -0.7, -0.5));
  result.scene.lights.push_back({"sky", sky, false});
  return result;
}

volume::BrickGrid cloudOfEdge(int edge) {
  const volume::GeneratedVolume cloud = volume::makeCloud();
  const glm::dvec3 scale = glm::dvec3(cloud.size - 1) / double(edge - 1);
  std::vector<float> values(std::size_t(edge) * std::size_t(edge) * std::size_t(edge));
  const auto at = [&](int x, int y, int z) {
    return cloud.density[std::size_t(x) +
                         std::size_t(cloud.size.x) * (std::size_t(y) + std::size_t(cloud.size.y) * std::size_t(z))];
  };
  std::size_t i = 0;
  for (int z = 0; z < edge; ++z) {
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x) {
        const glm::dvec3 place = glm::dvec3(x, y, z) * scale;
        const glm::ivec3 c = glm::min(glm::ivec3(place), cloud.size - 2);
        const glm::vec3 f(place - glm::dvec3(c));
        const auto row = [&](int dy, int dz) {
          return glm::mix(at(c.x, c.y + dy, c.z + dz), at(c.x + 1, c.y + dy, c.z + dz), f.x);
        };
        values[i++] = glm::mix(glm::mix(row(0, 0), row(1, 0), f.y), glm::mix(row(0, 1), row(1, 1), f.y), f.z);
      }
    }
  }
  volume::BrickGrid grid =
      volume::gridFromDense(values, glm::ivec3(edge), glm::ivec3(0), glm::dmat4(1.0), volume::Storage::Half);
  grid.name = "density";
  return grid;
}

} // namespace tyndall::bench

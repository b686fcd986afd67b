// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling_scenes.h"

#include "base/file.h"
#include "bench/ray_scenes.h"
#include "peer_scene/ply.h"
#include "scene/load.h"
#include "volume/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <numeric>
#include <random>

namespace tyndall::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kUsualEdge = 64;
constexpr double kUsualDepth = 5.0;
constexpr double kFloorEdge = 20.0;
constexpr int kBumpyBalls = 12; ///< of bumpySpheres, over two triangles

fs::path writeScene(const scene::Scene& scene, const fs::path& file) {
  writeFileAtomically(
      file, [&](const fs::path& temporary) { std::ofstream(temporary) << scene::toJson(scene, file.parent_path()); });
  return file;
}

/// Triangles without what they had beside their corners.
geometry::Mesh meshOf(const std::vector<geometry::BvhInput>& triangles) {
  geometry::Mesh mesh;
  for (const geometry::BvhInput& each : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {each.primitive.v0, each.primitive.v1, each.primitive.v2});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

/// Triangles at random places 0.3 to 1 above the floor that shine down, where the camera sees none of them from the
/// front. Their areas are log-normal, and in all do not depend on the count.
geometry::Mesh lampMesh(std::size_t count) {
  constexpr double kTotalArea = 0.1;
  std::mt19937 random(7);
  std::lognormal_distribution<double> areas(0.0, 1.0);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  std::vector<double> shares(count);
  std::ranges::generate(shares, [&] { return areas(random); });
  const double whole = std::accumulate(shares.begin(), shares.end(), 0.0);
  geometry::Mesh mesh;
  for (const double share : shares) {
    const double x = kFloorEdge * uniform(random);
    const double z = kFloorEdge * uniform(random);
    const glm::vec3 corner(x, 0.65 + 0.7 * uniform(random), z);
    const float leg = static_cast<float>(std::sqrt(2.0 * kTotalArea * share / whole));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {corner, corner + glm::vec3(leg, 0.0f, 0.0f), corner + glm::vec3(0.0f, 0.0f, leg)});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

double same(double) { return 1.0; }
double itself(double value) { return value; }

/// Edges squared.
std::vector<double> squares(std::initializer_list<double> edges) {
  std::vector<double> values;
  std::ranges::transform(edges, std::back_inserter(values), [](double edge) { return edge * edge; });
  return values;
}

ScalingPlan voxelPlan(const std::string& method) {
  const bool march = method == "march";
  return {.name = "voxels-" + method,
          .title = "Voxels: a ball in sparse index space, " + method,
          .axis = "voxels along an edge",
          .theory = march ? "with the edge" : "the same",
          .values = {64, 128, 256, 512, 1024},
          .arguments = {"--estimator", method},
          .cost = march ? itself : same,
          .size = [](double edge) { return edge * edge * edge; },
          .make = [](double edge,
                     const fs::path& folder) { return ScalingRun{writeBallScene(int(edge), kUsualDepth, folder)}; }};
}

ScalingPlan depthPlan(const std::string& method) {
  const bool march = method == "march";
  return {.name = "depth-" + method,
          .title = "Optical depth of a ball, " + method,
          .axis = "optical depth",
          .theory = march ? "the same" : "1 + depth",
          .values = {0.01, 0.1, 1, 10, 100, 1000},
          .arguments = {"--estimator", method},
          .anchor = 1.0, // from where on the medium gets opaque
          .cost = [march](double depth) { return march ? 1.0 : 1.0 + depth; },
          .size = same,
          .make = [](double depth,
                     const fs::path& folder) { return ScalingRun{writeBallScene(kUsualEdge, depth, folder)}; }};
}

ScalingPlan lightPlan() {
  return {.name = "lights",
          .title = "Shining triangles over a floor",
          .axis = "lights",
          .theory = "1 + log2",
          .values = {1, 10, 100, 1e3, 1e4, 1e5},
          .cost = [](double lights) { return 1.0 + std::log2(lights); },
          .size = itself,
          .make = [](double lights,
                     const fs::path& folder) { return ScalingRun{writeLightsScene(std::size_t(lights), folder)}; }};
}

ScalingPlan trianglePlan() {
  return {.name = "triangles",
          .title = "Triangles of bumpy balls",
          .axis = "triangles",
          .theory = "log2",
          .values = {trianglesOf(3), trianglesOf(7), trianglesOf(21), trianglesOf(65), trianglesOf(204)},
          .cost = [](double triangles) { return std::log2(triangles); },
          .size = itself,
          .make =
              [](double triangles, const fs::path& folder) {
                const double rings = 0.5 + std::sqrt(0.25 + (triangles - 2.0) / (2.0 * kBumpyBalls));
                return ScalingRun{writeTrianglesScene(int(std::lround(rings)), folder)};
              }};
}

ScalingPlan pixelPlan() {
  return {.name = "pixels",
          .title = "Pixels of a picture of a ball, march",
          .axis = "pixels",
          .theory = "the same",
          .values = squares({16, 32, 64, 128, 256}),
          .arguments = {"--estimator", "march"},
          .cost = same,
          .size = itself,
          .make = [](double pixels, const fs::path& folder) {
            const glm::uvec2 size(static_cast<unsigned>(std::lround(std::sqrt(pixels))));
            return ScalingRun{writeBallScene(kUsualEdge, kUsualDepth, folder), size};
          }};
}

ScalingPlan threadPlan(unsigned cores) {
  std::vector<double> counts;
  for (unsigned threads = 1; threads <= cores; threads *= 2) {
    counts.push_back(threads);
  }
  return {
      .name = "threads",
      .title = "Threads of the CPU device: a ball, tracking",
      .axis = "threads",
      .theory = "1 / threads",
      .values = counts,
      .arguments = {"--estimator", "tracking"},
      .wallClock = true,
      .cost = [](double threads) { return 1.0 / threads; },
      .size = same,
      .make =
          [](double threads, const fs::path& folder) {
            constexpr unsigned kEdge = 64;
            return ScalingRun{writeBallScene(kUsualEdge, kUsualDepth, folder), glm::uvec2(kEdge), unsigned(threads)};
          }};
}

} // namespace

std::vector<ScalingPlan> scalingPlans(unsigned cores) {
  return {voxelPlan("march"), voxelPlan("tracking"), depthPlan("march"), depthPlan("tracking"),
          lightPlan(),        trianglePlan(),        pixelPlan(),        threadPlan(cores)};
}

fs::path writeBallScene(int edge, double opticalDepth, const fs::path& folder) {
  const fs::path grid = folder / fmt::format("ball-{}.vdb", edge);
  if (!fs::exists(grid)) {
    volume::writeBall(grid, edge);
  }
  scene::Scene scene;
  constexpr double kDistance = 1.5;
  scene.camera.position = {0.0, 0.0, kDistance};
  scene.camera.verticalFov = glm::degrees(2.0 * std::asin(volume::kBallRadius / kDistance));
  scene::Medium ball;
  ball.name = "ball";
  ball.file = grid.string();
  ball.densityScale = opticalDepth / (2.0 * volume::kBallRadius * volume::kBallMeanDensity);
  ball.albedo = glm::dvec3(0.9);
  scene.media.push_back(ball);
  scene::SunLight sun;
  sun.direction = glm::normalize(glm::dvec3(-1.0, -1.0, -1.0));
  sun.angularDiameter = 0.0;
  scene.lights.push_back({"sun", sun, false});
  scene.render.depth = 1;
  return writeScene(scene, folder / fmt::format("ball-{}-{:g}.json", edge, opticalDepth));
}

fs::path writeLightsScene(std::size_t count, const fs::path& folder) {
  const geometry::Mesh mesh = lampMesh(count);
  const fs::path file = folder / fmt::format("lamps-{}.ply", count);
  peer_scene::writePly(file, mesh, mesh.triangles);
  scene::Scene scene;
  scene.camera.position = {0.0, 9.0, 17.0};
  scene.camera.verticalFov = 45.0;
  scene.render.depth = 1;
  scene::Object floor;
  floor.name = "floor";
  floor.kind = scene::Object::Kind::Quad;
  floor.origin = {-0.5 * kFloorEdge, 0.0, 0.5 * kFloorEdge};
  floor.edgeU = {kFloorEdge, 0.0, 0.0};
  floor.edgeV = {0.0, 0.0, -kFloorEdge};
  scene.objects.push_back(floor);
  scene::Object lamps;
  lamps.name = "lamps";
  lamps.file = file.string();
  lamps.material = "lamp";
  scene.objects.push_back(lamps);
  geometry::Material shining;
  shining.name = "lamp";
  shining.emission = glm::dvec3(1.0);
  scene.materials.push_back(shining);
  return writeScene(scene, folder / fmt::format("lights-{}.json", count));
}

double trianglesOf(int rings) { return 2.0 * kBumpyBalls * rings * (rings - 1.0) + 2.0; }

fs::path writeTrianglesScene(int rings, const fs::path& folder) {
  const RayScene rays = bumpySpheres(rings);
  const geometry::Mesh mesh = meshOf(rays.triangles);
  const fs::path file = folder / fmt::format("balls-{}.ply", rings);
  peer_scene::writePly(file, mesh, mesh.triangles);
  scene::Scene scene;
  scene.camera.position = glm::dvec3(rays.camera);
  scene.camera.target = scene.camera.position - glm::dvec3(0.0, 0.0, 1.0);
  scene.camera.verticalFov = glm::degrees(2.0 * std::atan(double(rays.tangent)));
  scene.render.depth = 3;
  scene::Object balls;
  balls.name = "balls";
  balls.file = file.string();
  scene.objects.push_back(balls);
  geometry::Material shining;
  shining.name = "lamp";
  shining.emission = glm::dvec3(15.0);
  scene.materials.push_back(shining);
  scene::Object lamp; // faces down
  lamp.name = "lamp";
  lamp.kind = scene::Object::Kind::Quad;
  lamp.origin = glm::dvec3(rays.lightMin);
  lamp.edgeU = {double(rays.lightMax.x - rays.lightMin.x), 0.0, 0.0};
  lamp.edgeV = {0.0, 0.0, double(rays.lightMax.z - rays.lightMin.z)};
  lamp.material = "lamp";
  scene.objects.push_back(lamp);
  return writeScene(scene, folder / fmt::format("triangles-{}.json", rings));
}

} // namespace tyndall::bench

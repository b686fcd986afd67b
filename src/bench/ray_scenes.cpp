// SPDX-License-Identifier: Apache-2.0
#include "bench/ray_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace tyndall::bench {
namespace {

void addTriangle(RayScene& scene, const glm::vec3& v0, const glm::vec3& v1, const glm::vec3& v2) {
  const auto index = static_cast<std::uint32_t>(scene.triangles.size());
  scene.triangles.push_back({{v0, v1, v2, interop::kPrimitiveTriangle | interop::kPrimitiveOpaque | index}, {}});
}

void addQuad(RayScene& scene, const glm::vec3& origin, const glm::vec3& edge1, const glm::vec3& edge2) {
  addTriangle(scene, origin, origin + edge1, origin + edge1 + edge2);
  addTriangle(scene, origin, origin + edge1 + edge2, origin + edge2);
}

/// A block on the ground, turned about +y.
void addBlock(RayScene& scene, const glm::vec3& centre, const glm::vec3& halfSize, float angle) {
  const glm::vec3 x = halfSize.x * glm::vec3(std::cos(angle), 0.0f, -std::sin(angle));
  const glm::vec3 y(0.0f, halfSize.y, 0.0f);
  const glm::vec3 z = halfSize.z * glm::vec3(std::sin(angle), 0.0f, std::cos(angle));
  for (const float side : {-1.0f, 1.0f}) {
    addQuad(scene, centre + side * x - y - z, 2.0f * y, 2.0f * z);
    addQuad(scene, centre + side * y - z - x, 2.0f * z, 2.0f * x);
    addQuad(scene, centre + side * z - x - y, 2.0f * x, 2.0f * y);
  }
}

/// Where longitude and latitude, in parts of `rings`, meet a sphere with bumps.
glm::vec3 bumpyPoint(int longitude, int latitude, int rings) {
  const double phi = 2.0 * std::numbers::pi * double(longitude % rings) / rings;
  const double theta = std::numbers::pi * double(latitude) / rings;
  const double radius = 0.8 + 0.06 * std::sin(9.0 * phi) * std::pow(std::sin(theta), 2.0) * std::cos(11.0 * theta);
  return glm::vec3(radius *
                   glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
}

} // namespace

RayScene boxScene() {
  RayScene scene{.name = "box, 36 triangles", .triangles = {}, .camera = {0.0f, 0.0f, 3.4f}};
  addQuad(scene, {-1.0f, -1.0f, -1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 2.0f}); // floor
  addQuad(scene, {-1.0f, 1.0f, -1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 2.0f});
  addQuad(scene, {-1.0f, -1.0f, -1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}); // back
  addQuad(scene, {-1.0f, -1.0f, -1.0f}, {0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 2.0f});
  addQuad(scene, {1.0f, -1.0f, -1.0f}, {0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 2.0f});
  addQuad(scene, {-0.25f, 0.99f, -0.25f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.5f}); // the light
  addBlock(scene, {-0.35f, -0.4f, -0.3f}, {0.3f, 0.6f, 0.3f}, 0.3f);
  addBlock(scene, {0.35f, -0.7f, 0.3f}, {0.3f, 0.3f, 0.3f}, -0.3f);
  scene.lightMin = {-0.25f, 0.98f, -0.25f};
  scene.lightMax = {0.25f, 0.98f, 0.25f};
  return scene;
}

RayScene bumpySpheres(int rings) {
  RayScene scene{.name = {}, .triangles = {}, .camera = {0.0f, 0.0f, 9.0f}};
  addQuad(scene, {-20.0f, -3.0f, -20.0f}, {40.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 40.0f});
  for (int ball = 0; ball < 12; ++ball) {
    const glm::vec3 centre(2.0f * float(ball % 4) - 3.0f, 2.0f * float(ball / 4) - 2.0f, ball % 2 == 0 ? -0.5f : 0.5f);
    const auto point = [&](int i, int j) { return centre + bumpyPoint(i, j, rings); };
    for (int i = 0; i < rings; ++i) {
      for (int j = 0; j < rings; ++j) {
        if (j > 0) { // at the poles one of two triangles has no area
          addTriangle(scene, point(i, j), point(i + 1, j + 1), point(i + 1, j));
        }
        if (j + 1 < rings) {
          addTriangle(scene, point(i, j), point(i, j + 1), point(i + 1, j + 1));
        }
      }
    }
  }
  scene.name = fmt::format("spheres, {} triangles", scene.triangles.size());
  scene.lightMin = {-2.0f, 6.0f, -2.0f};
  scene.lightMax = {2.0f, 6.0f, 2.0f};
  return scene;
}

} // namespace tyndall::bench

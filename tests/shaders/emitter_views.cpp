// SPDX-License-Identifier: Apache-2.0
#include "shaders/emitter_views.h"

#include <array>
#include <cmath>
#include <numbers>

namespace tyndall::test {

std::vector<View> triangles() {
  const interop::Emitter lamp = makeEmitter(interop::kEmitterTriangle, glm::vec3(1.0f, 2.0f, 3.0f), 2.0f,
                                            glm::vec3(1.0f, 0.3f, 0.0f), glm::vec3(-0.2f, 1.5f, 0.4f));
  const glm::vec3 middle = lamp.position + (lamp.edge1 + lamp.edge2) / 3.0f;
  const glm::vec3 normal = glm::normalize(glm::cross(lamp.edge1, lamp.edge2));
  const glm::vec3 along = glm::normalize(lamp.edge1);
  std::vector<View> views{{"near", lamp, middle + 0.3f * normal},
                          {"across", lamp, middle + 2.0f * normal + 1.0f * along},
                          {"far", lamp, middle + 1e4f * normal, 1e-3}, // a float there is 1e-3 of the triangle
                          {"grazing", lamp, middle + 0.02f * normal + 3.0f * along, 1e-4}};
  views.push_back({"both sides", lamp, middle - 0.7f * normal});
  views.back().emitter.flags = interop::kEmitterTwoSided;
  return views;
}

std::vector<View> spheres() {
  const auto sphere = [](float radius) {
    return makeEmitter(interop::kEmitterSphere, glm::vec3(0.5f, -1.0f, 2.0f), 2.0f, glm::vec3(radius, 0.0f, 0.0f));
  };
  const glm::vec3 w(2.0f / 7.0f, 3.0f / 7.0f, -6.0f / 7.0f);
  const glm::vec3 centre = sphere(1.0f).position;
  return {{"outside", sphere(1.0f), centre + 3.0f * w},
          {"at the surface", sphere(1.0f), centre + 1.001f * w, 2e-4}, // of 1e-3, floats know 1e-4
          {"far", sphere(1.0f), centre + 1000.0f * w},
          {"small", sphere(1e-2f), centre + 4.0f * w}};
}

double triangleSolidAngle(const View& view) {
  const glm::dvec3 base = glm::dvec3(view.emitter.position) - glm::dvec3(view.point);
  const std::array<glm::dvec3, 3> r{base, base + glm::dvec3(view.emitter.edge1), base + glm::dvec3(view.emitter.edge2)};
  const std::array<double, 3> l{glm::length(r[0]), glm::length(r[1]), glm::length(r[2])};
  const double triple = glm::dot(r[0], glm::cross(r[1], r[2]));
  const double sum =
      l[0] * l[1] * l[2] + glm::dot(r[0], r[1]) * l[2] + glm::dot(r[1], r[2]) * l[0] + glm::dot(r[2], r[0]) * l[1];
  return std::abs(2.0 * std::atan2(triple, sum));
}

double sphereSolidAngle(const View& view) {
  const double distance = glm::length(glm::dvec3(view.emitter.position) - glm::dvec3(view.point));
  const double sine = static_cast<double>(view.emitter.edge1.x) / distance;
  return 2.0 * std::numbers::pi * sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
}

double lambertIrradiance(const View& view, const glm::dvec3& normal) {
  const glm::dvec3 base = glm::dvec3(view.emitter.position) - glm::dvec3(view.point);
  const std::array<glm::dvec3, 3> r{base, base + glm::dvec3(view.emitter.edge1), base + glm::dvec3(view.emitter.edge2)};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 a = r[i];
    const glm::dvec3 b = r[(i + 1) % 3];
    const glm::dvec3 edge = glm::cross(a, b);
    sum += 0.5 * std::atan2(glm::length(edge), glm::dot(a, b)) * glm::dot(normal, glm::normalize(edge));
  }
  return std::abs(sum);
}

} // namespace tyndall::test

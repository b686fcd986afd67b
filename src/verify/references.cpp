// SPDX-License-Identifier: Apache-2.0
#include "verify/references.h"

#include <cmath>
#include <numbers>

namespace tyndall::verify {

using std::numbers::pi;

TestScene airlight(const AirlightRow& row, double verticalFov) {
  TestScene test({16, 16});
  test.perspective({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, verticalFov);
  const double side = 2.0 * row.tMax;
  test.box({-side, -side, 0.0}, {side, side, row.tMax}, row.sigmaT, row.albedo).phase = henyeyGreenstein(row.g);
  test.point({row.h, 0.0, row.d});
  return test;
}

TestScene litBox() {
  TestScene test({16, 16});
  test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 2.0);
  test.sun({0.0, -1.0, 0.0}, 3.0);
  return test;
}

std::vector<double> litBoxReference(const glm::uvec2& size, double sigmaT, double albedo, double irradiance) {
  std::vector<double> reference;
  const double dy = 2.0 / size.y;
  const double u = 0.5 * sigmaT * dy;
  for (std::uint32_t row = 0; row < size.y; ++row) {
    const double y = 1.0 - (row + 0.5) * dy;
    const double value = albedo / (4.0 * pi) * irradiance * std::exp(-sigmaT * (1.0 - y)) * -std::expm1(-2.0 * sigmaT) *
                         std::sinh(u) / u;
    reference.insert(reference.end(), size.x, value);
  }
  return reference;
}

void addWhiteMedia(PathScene& test) {
  test.sphere({0.2, 0.1, 0.0}, 0.9, 0.8).phase = henyeyGreenstein(0.8);
  test.sphere({-0.3, 0.0, 0.2}, 0.6, 2.0).phase = {PhaseId::Rayleigh, {}};
  test.box({-0.9, -0.9, -0.4}, {0.1, 0.3, 0.9}, 0.7).phase = {PhaseId::Draine, {0.5, 20.0, 0.0, 0.0}};
  test.box({-0.2, -0.8, -0.9}, {0.9, 0.8, 0.2}, 0.5).phase = {PhaseId::TwoLobe, {0.8, -0.3, 0.6, 0.0}};
  test.sphere({0.3, 0.4, 0.3}, 0.5, 0.6).phase = {PhaseId::Mie, {12.0, 0.0, 0.0, 0.0}};
  test.grid(puffGrid(), 2.0).phase = henyeyGreenstein(-0.3);
}

PathScene whiteRoom() {
  PathScene test({8, 8});
  test.perspective({0.0, 0.0, 1.4}, {0.2, 0.1, 0.0}, 80.0);
  geometry::Material& wall = test.lamp("wall", 1.0);
  wall.colour = glm::dvec3(0.5);
  wall.twoSided = true; // faces of boxes look outwards
  test.crate("wall", glm::dvec3(-1.5), glm::dvec3(1.5));
  addWhiteMedia(test);
  return test;
}

PathScene halfSpace(const HalfSpace& row, bool asGrid) {
  PathScene test({8, 8});
  const glm::dvec3 out(std::sqrt(1.0 - row.out * row.out), 0.0, row.out);
  test.orthographic(50.0 * out, {0.0, 0.0, 0.0}, 0.1);
  test.sun({0.0, -std::sqrt(1.0 - row.in * row.in), -row.in});
  const glm::dvec3 low(-1000.0, -1000.0, -40.0);
  const glm::dvec3 high(1000.0, 1000.0, 0.0);
  scene::Medium& medium = asGrid ? test.grid(constantGrid(9, low, high, 1.0), 1.0) : test.box(low, high, 1.0);
  medium.albedo = row.albedo;
  return test;
}

} // namespace tyndall::verify

// SPDX-License-Identifier: Apache-2.0
// Samples of one emitter, on the device.
#include "shaders/emitter_probe_io.h"
#include "shaders/emitter_views.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/emitter_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace tyndall::test {
namespace {

using interop::Emitter;
using interop::EmitterHit;

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kCount = 1u << 18;
enum Mode : std::uint32_t { Samples, Hits };
enum Planted : std::uint32_t { None, AreaDensity, SkewedTriangle, WrongCone };

std::vector<EmitterHit> run(const Emitter& emitter, const glm::vec3& point, const std::vector<EmitterHit>& hits,
                            Planted planted = None) {
  const EmittersOnDevice emitters(makeEmitterScene("one", {emitter}));
  const bool sampling = hits.empty();
  const std::uint32_t count = sampling ? kCount : static_cast<std::uint32_t>(hits.size());
  const auto in = ProbeRunner::upload(sampling ? std::vector<EmitterHit>(1) : hits);
  const auto out = ProbeRunner::results<EmitterHit>(count);
  const ProbeRunner probe(k_emitter_probe_spirv, {{0, sampling ? Samples : Hits}, {1, planted}});
  probe.run(interop::EmitterProbe{emitters.ptr(), point, in.ptr(), out.ptr(), count}, count);
  return ProbeRunner::download(out);
}

std::vector<EmitterHit> samplesOf(const Emitter& emitter, const glm::vec3& point, Planted planted = None) {
  return run(emitter, point, {}, planted);
}

glm::dvec3 hitOf(const View& view, const EmitterHit& hit) {
  return glm::dvec3(view.point) + static_cast<double>(hit.distance) * glm::dvec3(hit.direction);
}

/// z-score of the mean of value(sample) / pdf against a closed form.
double estimateZ(const std::vector<EmitterHit>& samples, double expected, double tolerance,
                 const std::function<double(const EmitterHit&)>& value) {
  std::vector<double> terms;
  for (const EmitterHit& sample : samples) {
    terms.push_back(sample.pdf > 0.0f ? value(sample) / static_cast<double>(sample.pdf) : 0.0);
  }
  return estimateMean(terms).zScore(expected, tolerance * expected);
}

double solidAngleZ(const View& view, double expected, Planted planted = None) {
  return estimateZ(samplesOf(view.emitter, view.point, planted), expected, 10.0 * view.tolerance,
                   [](const EmitterHit&) { return 1.0; });
}

TEST(EmitterSamples, OneOverPdfHasTheSolidAngleAsMean) {
  for (const View& view : triangles()) {
    EXPECT_LT(solidAngleZ(view, triangleSolidAngle(view)), kMaxZ) << "triangle, " << view.name;
  }
  for (const View& view : spheres()) {
    EXPECT_LT(solidAngleZ(view, sphereSolidAngle(view)), kMaxZ) << "sphere, " << view.name;
  }
  const View across = triangles()[1];
  EXPECT_GT(solidAngleZ(across, triangleSolidAngle(across), AreaDensity), kMaxZ);
  EXPECT_GT(solidAngleZ(across, triangleSolidAngle(across), SkewedTriangle), kMaxZ);
  EXPECT_GT(solidAngleZ(spheres()[0], sphereSolidAngle(spheres()[0]), WrongCone), kMaxZ);
}

double irradianceZ(const View& view, const glm::dvec3& normal, double perRadiance, Planted planted = None) {
  const double radiance = static_cast<double>(view.emitter.radiance.x);
  return estimateZ(samplesOf(view.emitter, view.point, planted), radiance * perRadiance, 10.0 * view.tolerance,
                   [&](const EmitterHit& hit) {
                     return static_cast<double>(hit.radiance.x) *
                            std::max(0.0, glm::dot(normal, glm::dvec3(hit.direction)));
                   });
}

TEST(EmitterSamples, IrradianceHasItsClosedForm) {
  for (const View& view : triangles()) {
    const glm::dvec3 middle =
        glm::dvec3(view.emitter.position) + glm::dvec3(view.emitter.edge1 + view.emitter.edge2) / 3.0;
    const glm::dvec3 normal = glm::normalize(middle - glm::dvec3(view.point));
    if (view.name != "near" && view.name != "both sides") { // there corners lie below the plane
      EXPECT_LT(irradianceZ(view, normal, lambertIrradiance(view, normal)), kMaxZ) << view.name;
    }
  }
  for (const View& view : spheres()) {
    const glm::dvec3 offset = glm::dvec3(view.emitter.position) - glm::dvec3(view.point);
    const glm::dvec3 towards = glm::normalize(offset);
    const glm::dvec3 tilted =
        glm::normalize(towards + 0.4 * glm::normalize(glm::cross(towards, glm::dvec3(1.0, 0.0, 0.0))));
    const double ratio = static_cast<double>(view.emitter.edge1.x) / glm::length(offset);
    EXPECT_LT(irradianceZ(view, towards, kPi * ratio * ratio), kMaxZ) << view.name;
    if (view.name != "at the surface") {
      EXPECT_LT(irradianceZ(view, tilted, kPi * ratio * ratio * glm::dot(tilted, towards)), kMaxZ)
          << view.name << ", tilted";
    }
  }
  const View across = triangles()[1];
  const glm::dvec3 normal = glm::normalize(glm::dvec3(across.emitter.position) - glm::dvec3(across.point));
  EXPECT_GT(irradianceZ(across, normal, lambertIrradiance(across, normal), AreaDensity), kMaxZ);
}

/// Worst relative error of the densities, both ways, against a formula in double; of the normals and of the distance of
/// the hit to the surface, per distance.
struct Errors {
  double pdf = 0.0;
  double normal = 0.0;
  double surface = 0.0;
};

Errors triangleErrors(const View& view, Planted planted = None) {
  Errors worst;
  const glm::dvec3 v0(view.emitter.position);
  const glm::dvec3 edge1(view.emitter.edge1);
  const glm::dvec3 edge2(view.emitter.edge2);
  const glm::dvec3 doubleArea = glm::cross(edge1, edge2);
  for (const EmitterHit& hit : samplesOf(view.emitter, view.point, planted)) {
    const glm::dvec3 place =
        v0 + static_cast<double>(hit.barycentric.x) * edge1 + static_cast<double>(hit.barycentric.y) * edge2;
    const glm::dvec3 offset = place - glm::dvec3(view.point);
    const double distance = glm::length(offset);
    const double pdf = std::pow(distance, 3.0) / (0.5 * std::abs(glm::dot(doubleArea, offset)));
    worst.pdf = std::max({worst.pdf, std::abs(double(hit.pdf) / pdf - 1.0), std::abs(double(hit.again) / pdf - 1.0)});
    worst.normal = std::max(worst.normal, glm::length(glm::dvec3(hit.normal) - glm::normalize(doubleArea)));
    worst.surface = std::max(worst.surface, glm::length(hitOf(view, hit) - place) / distance);
  }
  return worst;
}

Errors sphereErrors(const View& view, Planted planted = None) {
  Errors worst;
  const double pdf = 1.0 / sphereSolidAngle(view);
  for (const EmitterHit& hit : samplesOf(view.emitter, view.point, planted)) {
    const glm::dvec3 fromCentre = hitOf(view, hit) - glm::dvec3(view.emitter.position);
    const double radius = static_cast<double>(view.emitter.edge1.x);
    worst.pdf = std::max({worst.pdf, std::abs(double(hit.pdf) / pdf - 1.0), std::abs(double(hit.again) / pdf - 1.0)});
    worst.normal = std::max(worst.normal, glm::length(glm::dvec3(hit.normal) - fromCentre / radius));
    worst.surface = std::max(worst.surface, std::abs(glm::length(fromCentre) - radius) / glm::length(fromCentre));
  }
  return worst;
}

TEST(EmitterSamples, DensitiesNormalsAndDistancesAreExact) {
  for (const View& view : triangles()) {
    const Errors errors = triangleErrors(view);
    EXPECT_LT(errors.pdf, view.tolerance) << view.name;
    EXPECT_LT(errors.normal, 1e-6) << view.name;
    EXPECT_LT(errors.surface, 1e-6) << view.name;
  }
  for (const View& view : spheres()) {
    const Errors errors = sphereErrors(view);
    const double distance =
        glm::length(glm::dvec3(view.emitter.position) - glm::dvec3(view.point)) / double(view.emitter.edge1.x);
    EXPECT_LT(errors.pdf, std::max(view.tolerance, 2e-6)) << view.name;
    // A direction is rounded by 1e-7, which the distance in radii multiplies, at the horizon by its square root.
    EXPECT_LT(errors.normal, 1e-3 * std::sqrt(distance) + 1e-6 * distance) << view.name;
    EXPECT_LT(errors.surface, 1e-6 * distance) << view.name;
  }
  EXPECT_GT(triangleErrors(triangles()[1], AreaDensity).pdf, triangles()[1].tolerance);
  EXPECT_GT(sphereErrors(spheres()[0], AreaDensity).pdf, 2e-6);
}

/// P-value of samples being uniform: on the triangle's area, in equal parts of (1 - s)^2 and of t / s, s = u + v.
double trianglePValue(const View& view, Planted planted = None) {
  std::vector<std::uint64_t> counts(256);
  for (const EmitterHit& hit : samplesOf(view.emitter, view.point, planted)) {
    const double sum = static_cast<double>(hit.barycentric.x) + static_cast<double>(hit.barycentric.y);
    const auto row = static_cast<std::size_t>(std::min(15.0, 16.0 * sum * sum));
    const auto column = static_cast<std::size_t>(std::min(15.0, 16.0 * static_cast<double>(hit.barycentric.y) / sum));
    ++counts[16 * row + column];
  }
  return chiSquaredPValue(counts, std::vector<double>(256, 1.0 / 256.0));
}

/// The same in the cone of a sphere, in equal parts of 1 - cos and of the azimuth.
double spherePValue(const View& view, Planted planted = None) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(view.emitter.position) - glm::dvec3(view.point));
  const glm::dvec3 tangent = glm::normalize(glm::cross(axis, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 bitangent = glm::cross(axis, tangent);
  const double widest = sphereSolidAngle(view) / (2.0 * kPi);
  std::vector<std::uint64_t> counts(256);
  for (const EmitterHit& hit : samplesOf(view.emitter, view.point, planted)) {
    const glm::dvec3 w = glm::normalize(glm::dvec3(hit.direction));
    const double oneMinusCos = 0.5 * glm::dot(w - axis, w - axis);
    const double turns = std::atan2(glm::dot(w, bitangent), glm::dot(w, tangent)) / (2.0 * kPi) + 0.5;
    const auto ring = static_cast<std::size_t>(std::min(15.0, 16.0 * oneMinusCos / widest));
    ++counts[16 * ring + static_cast<std::size_t>(std::min(15.0, 16.0 * turns))];
  }
  return chiSquaredPValue(counts, std::vector<double>(256, 1.0 / 256.0));
}

TEST(EmitterSamples, AreUniform) {
  for (const View& view : triangles()) {
    EXPECT_GT(trianglePValue(view), kMinPValue) << view.name;
  }
  for (const View& view : spheres()) {
    EXPECT_GT(spherePValue(view), kMinPValue) << view.name;
  }
  EXPECT_LT(trianglePValue(triangles()[0], SkewedTriangle), kMinPValue);
  EXPECT_LT(spherePValue(spheres()[0], WrongCone), kMinPValue);
}

TEST(EmitterSamples, FromInsideASphere) {
  Emitter sphere = makeEmitter(interop::kEmitterSphere, glm::vec3(1.0f), 3.0f, glm::vec3(2.0f, 0.0f, 0.0f));
  const View view{"inside", sphere, glm::vec3(1.3f, 0.2f, 2.1f), 1e-5};
  for (const EmitterHit& hit : samplesOf(sphere, view.point)) {
    ASSERT_EQ(hit.pdf, 0.0f); // its outside alone shines
  }
  View both = view;
  both.emitter.flags = interop::kEmitterTwoSided;
  EXPECT_LT(solidAngleZ(both, 4.0 * kPi), kMaxZ);
  EXPECT_LT(irradianceZ(both, glm::dvec3(0.0, 0.6, 0.8), kPi), kMaxZ); // half of all directions are filled
  EXPECT_GT(solidAngleZ(both, 4.0 * kPi, AreaDensity), kMaxZ);
  for (const EmitterHit& hit : samplesOf(both.emitter, both.point)) {
    ASSERT_NEAR(hit.again / hit.pdf, 1.0f, 1e-5f);
    ASSERT_NEAR(glm::length(hitOf(both, hit) - glm::dvec3(1.0)), 2.0, 2e-6);
  }
}

TEST(EmitterSamples, NothingComesFromDarkSides) {
  View behind = triangles()[0];
  behind.point = behind.emitter.position - 0.5f * glm::cross(behind.emitter.edge1, behind.emitter.edge2);
  for (const EmitterHit& hit : samplesOf(behind.emitter, behind.point)) {
    ASSERT_EQ(hit.pdf, 0.0f);
    ASSERT_EQ(hit.again, 0.0f);
  }
  // The far side of a sphere, seen from outside through its near side.
  const View view = spheres()[0];
  const glm::vec3 w = glm::normalize(view.emitter.position - view.point);
  EmitterHit near{};
  near.direction = w;
  near.distance = 2.0f;
  near.normal = -w;
  EmitterHit far = near;
  far.distance = 4.0f;
  far.normal = w;
  const std::vector<EmitterHit> answers = run(view.emitter, view.point, {near, far});
  EXPECT_GT(answers[0].again, 0.0f);
  EXPECT_EQ(answers[1].again, 0.0f);
}

TEST(EmitterSamples, PointsAndSpots) {
  const glm::vec3 at(3.0f, 4.0f, 12.0f);
  const EmitterHit point = samplesOf(makeEmitter(interop::kEmitterPoint, at, 338.0f), glm::vec3(0.0f))[0];
  EXPECT_NEAR(point.radiance.x, 2.0f, 1e-6f);
  EXPECT_NEAR(point.distance, 13.0f, 1e-6f);
  EXPECT_NEAR(glm::length(point.direction - at / 13.0f), 0.0f, 1e-6f);
  EXPECT_TRUE(point.delta == 1u && point.pdf == 1.0f && point.again == 0.0f);
  // A spot above the origin, shining down: 1 - cos of the half-angles 0.3 and 0.1.
  const Emitter spot = makeEmitter(interop::kEmitterSpot, glm::vec3(0.0f, 2.0f, 0.0f), 8.0f,
                                   glm::vec3(0.0f, -1.0f, 0.0f), glm::vec3(0.3f, 0.1f, 0.0f));
  Emitter sharp = spot;
  sharp.edge2.y = 0.3f;
  for (const double oneMinusCos : {0.0, 0.09, 0.11, 0.15, 0.2, 0.29, 0.31, 1.0, 2.0}) {
    const double cosine = 1.0 - oneMinusCos;
    const glm::dvec3 place(2.0 * std::sqrt(1.0 - cosine * cosine), 2.0 - 2.0 * cosine, 0.0);
    const double x = std::clamp((0.3 - oneMinusCos) / 0.2, 0.0, 1.0);
    const EmitterHit hit = samplesOf(spot, glm::vec3(place))[0];
    EXPECT_NEAR(hit.pdf > 0.0f ? double(hit.radiance.x) : 0.0, 2.0 * x * x * (3.0 - 2.0 * x), 1e-5) << oneMinusCos;
    EXPECT_EQ(samplesOf(sharp, glm::vec3(place))[0].pdf > 0.0f, oneMinusCos < 0.3) << oneMinusCos;
  }
}

TEST(EmitterSamples, ExtremeSizesAndDistancesStayFinite) {
  for (const float size : {1e-6f, 1e-3f, 1.0f, 1e6f}) {
    for (const float distance : {1e-6f, 1e-2f, 1.0f, 1e6f}) {
      const Emitter triangle = makeEmitter(interop::kEmitterTriangle, glm::vec3(0.0f, 0.0f, distance), 1.0f,
                                           glm::vec3(0.0f, size, 0.0f), glm::vec3(size, 0.0f, 0.0f));
      const Emitter sphere = makeEmitter(interop::kEmitterSphere, glm::vec3(0.0f, 0.0f, distance + size), 1.0f,
                                         glm::vec3(size, 0.0f, 0.0f));
      for (const Emitter& emitter : {triangle, sphere}) {
        std::uint64_t lit = 0;
        for (const EmitterHit& hit : samplesOf(emitter, glm::vec3(0.0f))) {
          ASSERT_TRUE(std::isfinite(hit.pdf) && std::isfinite(hit.distance) && hit.distance >= 0.0f);
          ASSERT_NEAR(glm::length(hit.direction), 1.0f, 1e-5f);
          ASSERT_NEAR(glm::length(hit.normal), 1.0f, 1e-5f);
          ASSERT_NEAR(hit.again, hit.pdf, 1e-3f * hit.pdf) << emitter.kind << " " << size << " " << distance;
          lit += hit.pdf > 0.0f ? 1 : 0;
        }
        // A sphere that begins less than a rounding away holds the point.
        const bool outside = emitter.kind == interop::kEmitterTriangle || emitter.position.z > size;
        EXPECT_EQ(lit, outside ? kCount : 0u) << emitter.kind << " " << size << " " << distance;
      }
    }
  }
}

} // namespace
} // namespace tyndall::test

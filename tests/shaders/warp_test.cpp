// SPDX-License-Identifier: Apache-2.0
#include "shaders/sphere_bins.h"
#include "support/probe.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/warp_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

enum Shape : std::uint32_t { Sphere, Cone, Disc, Cosine };
constexpr std::uint32_t kCount = 1u << 18;

std::vector<glm::vec4> sampled(Shape shape, const glm::vec3& axis, double oneMinusCosMax, bool planted) {
  struct Push {
    glm::vec3 axis;
    float oneMinusCosMax;
    std::uint32_t count;
    interop::Ptr<glm::vec4> outputs;
  };
  const ProbeRunner probe(k_warp_probe_spirv, {{0, shape}, {1, gpu::specBits(planted)}});
  const auto out = ProbeRunner::results<glm::vec4>(kCount);
  probe.run(Push{axis, static_cast<float>(oneMinusCosMax), kCount, out.ptr()}, kCount);
  return ProbeRunner::download(out);
}

std::vector<glm::dvec3> directions(const std::vector<glm::vec4>& samples) {
  std::vector<glm::dvec3> result;
  for (const glm::vec4& sample : samples) {
    result.emplace_back(sample);
  }
  return result;
}

double spherePValue(bool planted) {
  const auto density = [](double, double) { return 0.25 / std::numbers::pi; };
  return SphereBins(density, 64, 16).pValue({0.0, 0.0, 1.0}, directions(sampled(Sphere, glm::vec3(0.0f), 1.0, planted)));
}

TEST(Warp, SphereIsUniform) {
  EXPECT_GT(spherePValue(false), kMinPValue);
  EXPECT_LT(spherePValue(true), kMinPValue);
  EXPECT_FLOAT_EQ(sampled(Sphere, glm::vec3(0.0f), 1.0, false)[0].w, static_cast<float>(0.25 / std::numbers::pi));
}

/// Chi-squared over areas of equal solid angle in a cone. `rings` fewer for cones as narrow as floats resolve.
double conePValue(double diameterDegrees, int rings, bool planted) {
  const double halfAngle = 0.5 * diameterDegrees * std::numbers::pi / 180.0;
  const double oneMinusCosMax = 2.0 * std::pow(std::sin(0.5 * halfAngle), 2.0);
  const glm::vec3 axis(glm::normalize(glm::dvec3(-0.4, 0.7, 0.2)));
  // The axis as rounded is not quite unit: the angle is taken to its direction.
  const glm::dvec3 exactAxis = glm::normalize(glm::dvec3(axis));
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(rings));
  for (const glm::dvec3& w : directions(sampled(Cone, axis, oneMinusCosMax, planted))) {
    const double fraction = polarPlace(exactAxis, glm::normalize(w)).x / oneMinusCosMax;
    ++counts[static_cast<std::size_t>(std::min(fraction, 0.999999) * rings)];
  }
  return chiSquaredPValue(counts, std::vector<double>(static_cast<std::size_t>(rings), 1.0 / rings));
}

TEST(Warp, ConeIsUniformAndInside) {
  for (const double diameter : {0.53, 10.0, 180.0, 350.0}) {
    EXPECT_GT(conePValue(diameter, 32, false), kMinPValue) << diameter;
  }
  EXPECT_LT(conePValue(10.0, 32, true), kMinPValue);
}

TEST(Warp, NarrowestConeKeepsItsSize) {
  // 1e-4 degrees across is 15 float steps: the mean square of the angle is what such a disc must keep.
  const double halfAngle = 0.5e-4 * std::numbers::pi / 180.0;
  const glm::vec3 axis(glm::normalize(glm::dvec3(-0.4, 0.7, 0.2)));
  const glm::dvec3 exactAxis = glm::normalize(glm::dvec3(axis));
  const auto meanPlace = [&](bool planted) {
    double sum = 0.0;
    for (const glm::dvec3& w : directions(sampled(Cone, axis, 0.5 * halfAngle * halfAngle, planted))) {
      sum += polarPlace(exactAxis, glm::normalize(w)).x / kCount;
    }
    return sum / (0.25 * halfAngle * halfAngle);
  };
  EXPECT_NEAR(meanPlace(false), 1.0, 0.02);
  EXPECT_GT(std::abs(meanPlace(true) - 1.0), 0.02);
}

TEST(Warp, ConePdfIsOneOverTheSolidAngle) {
  const double oneMinusCosMax = 0.25;
  EXPECT_NEAR(static_cast<double>(sampled(Cone, {0.0f, 0.0f, 1.0f}, oneMinusCosMax, false)[0].w) * 2.0 * std::numbers::pi * oneMinusCosMax, 1.0, 1e-6);
}

double discPValue(bool planted) {
  std::vector<std::uint64_t> counts(16 * 16);
  for (const glm::vec4& sample : sampled(Disc, glm::vec3(0.0f), 1.0, planted)) {
    const glm::dvec2 p(sample);
    const int ring = std::min(static_cast<int>(glm::dot(p, p) * 16.0), 15);
    const int sector = std::min(static_cast<int>((std::atan2(p.y, p.x) / (2.0 * std::numbers::pi) + 0.5) * 16.0), 15);
    ++counts[static_cast<std::size_t>(ring * 16 + sector)];
  }
  return chiSquaredPValue(counts, std::vector<double>(256, 1.0 / 256.0));
}

TEST(Warp, DiscIsUniform) {
  EXPECT_GT(discPValue(false), kMinPValue);
  EXPECT_LT(discPValue(true), kMinPValue);
}

double cosinePValue(bool planted) {
  const auto density = [](double oneMinusCos, double onePlusCos) { return std::max(0.0, 0.5 * (onePlusCos - oneMinusCos)) / std::numbers::pi; };
  return SphereBins(density, 64, 16).pValue({0.0, 0.0, 1.0}, directions(sampled(Cosine, glm::vec3(0.0f), 1.0, planted)));
}

TEST(Warp, HemisphereFollowsTheCosine) {
  EXPECT_GT(cosinePValue(false), kMinPValue);
  EXPECT_LT(cosinePValue(true), kMinPValue);
  for (const glm::vec4& sample : sampled(Cosine, glm::vec3(0.0f), 1.0, false)) {
    ASSERT_NEAR(glm::length(glm::dvec3(sample)), 1.0, 1e-6);
    ASSERT_FLOAT_EQ(sample.w, sample.z / static_cast<float>(std::numbers::pi));
  }
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
#include "support/probe.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/equiangular_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tyndall::test {
namespace {

enum Planted : std::uint32_t { None, Textbook, NoJacobian };

struct Case {
  std::string name;
  glm::vec3 centre;        ///< of a ray from `origin` along a slanted direction, in its own frame (x along it)
  float tMin = 0.0f;
  float tMax = 10.0f;
  std::uint32_t count = 1u << 18;
  int bins = 64;
};

constexpr float kUnbounded = 1e30f;

// Where D is at its lower bound, 1e-5 of the ray, one float step of t is 1 % of the peak: fewer bins and samples.
const std::vector<Case> kCases{
    {"beside the middle", {5.0f, 1.0f, 0.0f}},
    {"beside the start", {0.0f, 0.3f, 0.0f}},
    {"beside the end", {10.0f, 0.01f, 0.0f}},
    {"behind", {-3.0f, 0.5f, 0.0f}},
    {"just behind", {-0.001f, 0.0005f, 0.0f}},
    {"behind, on the line", {-2.0f, 0.0f, 0.0f}},
    {"beyond", {25.0f, 2.0f, 0.0f}},
    {"far beyond", {2e4f, 300.0f, 0.0f}, 2.0f, 9.0f},
    {"far beside", {5.0f, 1e5f, 0.0f}},
    {"very far beside", {5.0f, 1e7f, 0.0f}},
    {"near the ray", {4.0f, 0.01f, 0.0f}},
    {"on the ray", {5.0f, 0.0f, 0.0f}, 0.0f, 10.0f, 1u << 14, 8},
    {"short ray", {3e-5f, 1e-5f, 0.0f}, 0.0f, 1e-4f},
    {"long ray", {2e5f, 1e3f, 0.0f}, 10.0f, 1e6f},
    {"unbounded, beside", {5.0f, 1.0f, 0.0f}, 0.0f, kUnbounded},
    {"unbounded, behind", {-5.0f, 1.0f, 0.0f}, 1.0f, kUnbounded},
    {"unbounded, near the ray", {5.0f, 0.01f, 0.0f}, 0.0f, kUnbounded},
    {"unbounded, at the start", {0.0f, 0.5f, 0.0f}, 0.0f, kUnbounded},
};

const glm::dvec3 kDirection = glm::normalize(glm::dvec3(0.6, -0.3, 0.74));

struct Verdict {
  double pValue;
  double outside;         ///< fraction of samples outside the interval or not finite
  double worstPdfError;   ///< relative
  double distanceError;   ///< of D, relative to the ray or the centre's distance
};

Verdict judge(const Case& test, Planted planted) {
  struct Push {
    glm::vec3 origin;
    glm::vec3 direction;
    glm::vec3 centre;
    float tMin;
    float tMax;
    std::uint32_t count;
    interop::Ptr<glm::vec4> outputs;
  };
  const glm::dvec3 side = glm::normalize(glm::cross(kDirection, glm::dvec3(0.0, 1.0, 0.0)));
  const glm::dvec3 local(test.centre);
  const glm::vec3 centre(local.x * kDirection + local.y * side);
  const ProbeRunner probe(k_equiangular_probe_spirv, {{0, planted}});
  const auto out = ProbeRunner::results<glm::vec4>(test.count);
  probe.run(Push{glm::vec3(0.0f), glm::vec3(kDirection), centre, test.tMin, test.tMax, test.count, out.ptr()}, test.count);
  const std::vector<glm::vec4> samples = ProbeRunner::download(out);

  // D and delta as the device has them: float rounding moves the centre, which biases nothing.
  const double distance = static_cast<double>(samples[0].z);
  const double delta = static_cast<double>(samples[0].w);
  const bool unbounded = test.tMax >= kUnbounded;
  const double a = static_cast<double>(test.tMin) - delta;
  const double b = static_cast<double>(test.tMax) - delta;
  const double theta = unbounded ? std::atan2(distance, a) : std::atan2(distance * (b - a), distance * distance + a * b);
  Verdict verdict{};
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(test.bins));
  for (const glm::vec4& sample : samples) {
    const double t = static_cast<double>(sample.x);
    if (!(sample.x >= test.tMin && sample.x <= test.tMax)) {
      verdict.outside += 1.0 / test.count;
      continue;
    }
    // [Kulla12]: the angle from tMin is uniform.
    const double offset = t - delta;
    const double angle = std::atan2(distance * (offset - a), distance * distance + a * offset);
    ++counts[static_cast<std::size_t>(std::clamp(angle / theta, 0.0, 0.999999) * test.bins)];
    const double pdf = distance / (theta * (distance * distance + offset * offset));
    // t - delta in float may differ by one rounding of t.
    const double slack = 2.0 * std::abs(offset) / (distance * distance + offset * offset) * 1.2e-7 * std::max(std::abs(t), std::abs(delta));
    verdict.worstPdfError = std::max(verdict.worstPdfError, std::abs(static_cast<double>(sample.y) / pdf - 1.0) - slack);
  }
  verdict.pValue = chiSquaredPValue(counts, std::vector<double>(counts.size(), 1.0 / test.bins));
  const double scale = unbounded ? std::abs(a) : static_cast<double>(test.tMax - test.tMin);
  const double expected = std::max(local.y, 1e-5 * scale);
  verdict.distanceError = std::abs(distance - expected) / std::max(expected, glm::length(local));
  return verdict;
}

TEST(Equiangular, SamplesFollowThePdfAndStayInside) {
  for (const Case& test : kCases) {
    const Verdict verdict = judge(test, None);
    EXPECT_GT(verdict.pValue, kMinPValue) << test.name;
    EXPECT_EQ(verdict.outside, 0.0) << test.name;
    EXPECT_LT(verdict.worstPdfError, 3e-6) << test.name;
    EXPECT_LT(verdict.distanceError, 1e-6) << test.name;
  }
}

TEST(Equiangular, CheckersSeePlantedBugs) {
  EXPECT_GT(judge(kCases[7], Textbook).outside, 0.01);
  EXPECT_GT(judge(kCases[0], NoJacobian).worstPdfError, 3e-6);
}

} // namespace
} // namespace tyndall::test

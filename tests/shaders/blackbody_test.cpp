// SPDX-License-Identifier: Apache-2.0
#include "light/blackbody.h"

#include "support/probe.h"

// Needs <cstdint> before it.
#include "kernels/blackbody_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tyndall::test {
namespace {

std::vector<glm::vec3> radiances(const std::vector<float>& kelvins, const std::vector<glm::vec3>& table) {
  struct Push {
    interop::Ptr<glm::vec3> table;
    interop::Ptr<float> kelvins;
    interop::Ptr<glm::vec3> outputs;
    std::uint32_t count;
  };
  const auto in = ProbeRunner::upload(table);
  const auto temperatures = ProbeRunner::upload(kelvins);
  const auto out = ProbeRunner::results<glm::vec3>(kelvins.size());
  const auto count = static_cast<std::uint32_t>(kelvins.size());
  ProbeRunner(k_blackbody_probe_spirv).run(Push{in.ptr(), temperatures.ptr(), out.ptr(), count}, count);
  return ProbeRunner::download(out);
}

/// Largest error over 500 to 20000 K, relative to the brightest channel.
double worstError(const std::vector<glm::vec3>& table) {
  std::vector<float> kelvins;
  for (float kelvin = 500.0f; kelvin <= 20000.0f; kelvin *= 1.0003f) {
    kelvins.push_back(kelvin);
  }
  const std::vector<glm::vec3> values = radiances(kelvins, table);
  double worst = 0.0;
  for (std::size_t i = 0; i < kelvins.size(); ++i) {
    const glm::dvec3 expected = light::blackbodyRadiance(static_cast<double>(kelvins[i]));
    const glm::dvec3 error = glm::abs(glm::dvec3(values[i]) - expected) / std::max({expected.r, expected.g, expected.b});
    worst = std::max({worst, error.r, error.g, error.b});
  }
  return worst;
}

TEST(BlackbodyTable, IsWithinOneInAThousand) {
  EXPECT_LT(worstError(light::blackbodyTable()), 1e-3);
  std::vector<glm::vec3> shifted = light::blackbodyTable();
  std::rotate(shifted.begin(), shifted.begin() + 1, shifted.end() - 1);
  EXPECT_GT(worstError(shifted), 1e-3); // planted: off by one entry
}

TEST(BlackbodyTable, IsContinuousAndPositiveBeyondItsEnds) {
  const std::vector<glm::vec3> table = light::blackbodyTable();
  const std::vector<glm::vec3> values = radiances({499.99f, 500.01f, 19999.0f, 20001.0f, 40000.0f, 300.0f, 1.0f, 1e-20f, 0.0f, -10.0f}, table);
  EXPECT_NEAR(values[0].r / values[1].r, 1.0f, 0.01f);
  EXPECT_NEAR(values[2].b / values[3].b, 1.0f, 0.001f);
  EXPECT_GT(values[4].b, 1.5f * values[3].b);
  EXPECT_LT(values[5].r, 1e-6f * values[1].r); // room temperature does not glow
  for (std::size_t i = 6; i < values.size(); ++i) {
    EXPECT_EQ(values[i], glm::vec3(0.0f)) << i;
  }
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
#include "support/probe.h"

// Needs <cstdint> before it.
#include "kernels/numerics_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace tyndall::test {
namespace {

enum Function : std::uint32_t { Log1p, Expm1, Sine, Cosine, Atan2, IsFinite, OneMinusExp };

std::vector<float> evaluate(Function function, const std::vector<glm::vec2>& inputs, bool plain) {
  return ProbeRunner(k_numerics_probe_spirv, {{0, function}, {1, gpu::specBits(plain)}}).map<float>(inputs);
}

using Oracle = std::function<double(double x, double y)>;

/// Largest error; relative, or absolute where `absolute`.
double worstError(Function function, const std::vector<glm::vec2>& inputs, const Oracle& oracle, bool plain, bool absolute = false) {
  const std::vector<float> values = evaluate(function, inputs, plain);
  double worst = 0.0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double expected = oracle(static_cast<double>(inputs[i].x), static_cast<double>(inputs[i].y));
    const double error = std::abs(static_cast<double>(values[i]) - expected);
    const double relative = expected == 0.0 ? error : error / std::abs(expected);
    worst = std::max(worst, absolute ? error : relative);
    if (!std::isfinite(values[i])) {
      return std::numeric_limits<double>::infinity();
    }
  }
  return worst;
}

/// Both signs of magnitudes from 1e-30 to `largest`, uniform in the logarithm.
std::vector<glm::vec2> logarithmic(double smallest, double largest, int count) {
  std::vector<glm::vec2> inputs;
  for (int i = 0; i < count; ++i) {
    const double magnitude = smallest * std::pow(largest / smallest, (i + 0.5) / count);
    inputs.emplace_back(static_cast<float>(magnitude), 0.0f);
    inputs.emplace_back(static_cast<float>(-magnitude), 0.0f);
  }
  return inputs;
}

std::vector<glm::vec2> log1pInputs() {
  std::vector<glm::vec2> inputs = logarithmic(1e-30, 0.99, 100000);
  for (int i = 0; i < 100000; ++i) {
    inputs.emplace_back(-static_cast<float>(i + 1) / 100002.0f, 0.0f);
    inputs.emplace_back(static_cast<float>(std::pow(10.0, 38.0 * i / 1e5)), 0.0f);
  }
  inputs.emplace_back(-0.99999994f, 0.0f);
  return inputs;
}

TEST(Numerics, Log1pIsAccurateEverywhere) {
  const Oracle oracle = [](double x, double) { return std::log1p(x); };
  EXPECT_LT(worstError(Log1p, log1pInputs(), oracle, false), 1e-6);
  EXPECT_GT(worstError(Log1p, log1pInputs(), oracle, true), 1e-6); // planted: a plain logarithm
  EXPECT_EQ(evaluate(Log1p, {glm::vec2(-1.0f, 0.0f)}, false)[0], -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(evaluate(Log1p, {glm::vec2(-1.5f, 0.0f)}, false)[0]));
}

TEST(Numerics, Expm1IsAccurateEverywhere) {
  std::vector<glm::vec2> inputs = logarithmic(1e-30, 88.0, 200000);
  for (int i = 0; i < 200000; ++i) {
    inputs.emplace_back(-100.0f + static_cast<float>(i) * 9.4e-4f, 0.0f);
  }
  EXPECT_LT(worstError(Expm1, inputs, [](double x, double) { return std::expm1(x); }, false), 1e-6);
  EXPECT_GT(worstError(Expm1, inputs, [](double x, double) { return std::expm1(x); }, true), 1e-6);
  EXPECT_LT(worstError(OneMinusExp, logarithmic(1e-30, 80.0, 1000), [](double x, double) { return -std::expm1(-x); }, false), 1e-6);
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> limits = evaluate(Expm1, {glm::vec2(infinity, 0.0f), glm::vec2(-infinity, 0.0f), glm::vec2(NAN, 0.0f)}, false);
  EXPECT_EQ(limits[0], infinity);
  EXPECT_EQ(limits[1], -1.0f);
  EXPECT_TRUE(std::isnan(limits[2]));
}

TEST(Numerics, SineAndCosineOfTurns) {
  std::vector<glm::vec2> inputs = logarithmic(1e-12, 0.999, 100000);
  for (int i = 0; i < 100000; ++i) {
    inputs.emplace_back(static_cast<float>(i) * 1e-3f - 50.0f, 0.0f);
  }
  const Oracle sine = [](double x, double) { return std::sin(2.0 * std::numbers::pi * x); };
  const Oracle cosine = [](double x, double) { return std::cos(2.0 * std::numbers::pi * x); };
  EXPECT_LT(worstError(Sine, inputs, sine, false, true), 2e-7);
  EXPECT_LT(worstError(Cosine, inputs, cosine, false, true), 2e-7);
  EXPECT_LT(worstError(Sine, logarithmic(1e-12, 0.1, 10000), sine, false), 4e-7);
  EXPECT_GT(worstError(Sine, inputs, sine, true, true), 2e-7);
}

TEST(Numerics, ArctangentOfAllQuadrants) {
  std::vector<glm::vec2> inputs;
  for (int i = 0; i < 100000; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / 100000.0;
    const double radius = std::pow(10.0, (i % 60) - 30.0);
    inputs.emplace_back(glm::dvec2(std::cos(angle), std::sin(angle)) * radius);
    const double slope = std::pow(10.0, -(i % 12));
    inputs.emplace_back(i % 2 == 0 ? -1.0f : 1.0f, static_cast<float>(i % 3 == 0 ? -slope : slope));
  }
  const Oracle oracle = [](double x, double y) { return std::atan2(y, x); };
  EXPECT_LT(worstError(Atan2, inputs, oracle, false), 4e-7);
  EXPECT_GT(worstError(Atan2, inputs, oracle, true), 4e-7);
  EXPECT_EQ(evaluate(Atan2, {glm::vec2(0.0f)}, false)[0], 0.0f);
}

TEST(Numerics, IsFiniteSeesNanAndInfinity) {
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<glm::vec2> inputs{glm::vec2(0.0f), glm::vec2(3e38f), glm::vec2(-1e-44f), glm::vec2(infinity), glm::vec2(-infinity), glm::vec2(NAN)};
  EXPECT_EQ(evaluate(IsFinite, inputs, false), (std::vector<float>{1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f}));
  EXPECT_NE(evaluate(IsFinite, inputs, true), (std::vector<float>{1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f})); // x == x
}

} // namespace
} // namespace tyndall::test

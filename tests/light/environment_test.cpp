// SPDX-License-Identifier: Apache-2.0
#include "light/environment.h"

#include "math/colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace tyndall::light {
namespace {

double sumOfProbabilities(const EnvironmentTable& table) {
  double sum = 0.0;
  for (const interop::AliasEntry& entry : table.cells) {
    sum += static_cast<double>(entry.probability);
  }
  return sum;
}

TEST(Environment, ConstantMapHasPowerFourPi) {
  for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(4, 2), glm::uvec2(257, 129), glm::uvec2(1500, 700)}) {
    const std::vector<glm::vec3> texels(std::size_t(size.x) * size.y, glm::vec3(0.5f));
    const EnvironmentTable table = makeEnvironment(texels, size, 2.0);
    EXPECT_NEAR(table.power, 4.0 * std::numbers::pi, 1e-9);
    EXPECT_NEAR(sumOfProbabilities(table), 1.0, 1e-5);
    EXPECT_LE(table.cellCount.x, 1024u);
    EXPECT_LE(table.cellCount.y, 512u);
    EXPECT_EQ(table.texels.front(), glm::vec3(1.0f));
  }
}

TEST(Environment, CellsOfALargeMapFollowTheSolidAngle) {
  const glm::uvec2 size(1500, 700);
  const EnvironmentTable table = makeEnvironment(std::vector<glm::vec3>(std::size_t(size.x) * size.y, glm::vec3(1.0f)), size, 1.0);
  ASSERT_EQ(table.cellCount, glm::uvec2(1024, 512));
  for (const unsigned row : {0u, 100u, 255u, 256u, 511u}) {
    const double step = std::numbers::pi / 512.0;
    const double expected = 0.5 * (std::cos(row * step) - std::cos((row + 1) * step)) / 1024.0;
    // Texels that straddle a border share their solid angle by area: exact but for the cosine within a texel.
    EXPECT_NEAR(static_cast<double>(table.cells[row * 1024 + 500].probability) / expected, 1.0, row == 0u || row == 511u ? 0.3 : 0.01);
  }
}

TEST(Environment, NeighboursOfABrightTexelCanBeSampled) {
  const glm::uvec2 size(16, 8);
  std::vector<glm::vec3> texels(16 * 8, glm::vec3(0.0f));
  texels[3 * 16 + 15] = glm::vec3(0.0f, 0.0f, 7.0f); // bilinear: reaches the first column
  const EnvironmentTable table = makeEnvironment(texels, size, 1.0);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool lit = std::abs(y - 3) <= 1 && (x == 14 || x == 15 || x == 0);
      EXPECT_EQ(table.cells[static_cast<std::size_t>(y * 16 + x)].probability > 0.0f, lit) << x << ' ' << y;
    }
  }
}

TEST(Environment, BadTexelsAreCountedAndBlackOnes) {
  std::vector<glm::vec3> texels(8, glm::vec3(0.0f));
  EXPECT_EQ(makeEnvironment(texels, {4, 2}, 1.0).power, 0.0);
  EXPECT_EQ(makeEnvironment(texels, {4, 2}, 1.0).badTexels, 0u);
  texels[1] = glm::vec3(-1.0f, 2.0f, 0.0f);
  texels[2].x = std::numeric_limits<float>::quiet_NaN();
  texels[3].y = std::numeric_limits<float>::infinity();
  const EnvironmentTable table = makeEnvironment(texels, {4, 2}, 1.0);
  EXPECT_EQ(table.badTexels, 3u);
  EXPECT_EQ(table.texels[1], glm::vec3(0.0f, 2.0f, 0.0f));
  EXPECT_TRUE(std::isfinite(table.power));
}

} // namespace
} // namespace tyndall::light

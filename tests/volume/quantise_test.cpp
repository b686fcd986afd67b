// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "volume/load.h"
#include "volume/quantise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tyndall::volume {
namespace {

constexpr glm::ivec3 kSize(24, 16, 40);

/// A smooth blob with an empty half, times `peak`.
std::vector<float> blob(double peak) {
  std::vector<float> values;
  for (int z = 0; z < kSize.z; ++z) {
    for (int y = 0; y < kSize.y; ++y) {
      for (int x = 0; x < kSize.x; ++x) {
        const glm::dvec3 from = (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(kSize) - glm::dvec3(0.5, 0.5, 0.3);
        values.push_back(float(peak * std::max(0.0, 1.0 - 3.0 * glm::length(from))));
      }
    }
  }
  return values;
}

BrickGrid exactGrid(const std::vector<float>& values) {
  return gridFromDense(values, kSize, glm::ivec3(-3), glm::dmat4(1.0), Storage::Float);
}

Storage automatic(const std::vector<float>& values, double tolerance, double depthTolerance) {
  LoadOptions options;
  options.tolerance = tolerance;
  options.opticalDepthTolerance = depthTolerance;
  return quantised(exactGrid(values), options).storage;
}

TEST(Quantise, ErrorsStayWithinHalfAStep) {
  for (const double peak : {1.0, 1e-30, 3.0e38, 60000.0}) {
    const std::vector<float> values = blob(peak);
    const BrickGrid grid = gridFromDense(values, kSize, glm::ivec3(-3), glm::dmat4(1.0), Storage::Unorm8);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const glm::ivec3 at(int(i) % kSize.x, int(i) / kSize.x % kSize.y, int(i) / (kSize.x * kSize.y));
      ASSERT_NEAR(double(grid.voxel(at - 3)), double(values[i]), peak * (0.5 / 255.0 + 1e-6));
      if (values[i] == 0.0f) {
        ASSERT_EQ(grid.voxel(at - 3), 0.0f);
      }
    }
    EXPECT_LE(grid.report.quantisationError, 0.5 / 255.0 + 1e-6);
    EXPECT_GT(grid.report.quantisationError, 0.0);
  }
}

TEST(Quantise, ReportedErrorIsTheWorstVoxel) {
  const std::vector<float> values = blob(2.0);
  const BrickGrid exact = exactGrid(values);
  for (const Storage storage : {Storage::Unorm8, Storage::Half}) {
    const BrickGrid coded = encoded(exact, storage);
    double worst = 0.0;
    double largest = 0.0;
    double worstLine = 0.0;
    for (int y = 0; y < kSize.y; ++y) {
      for (int x = 0; x < kSize.x; ++x) {
        double sums[2] = {0.0, 0.0};
        for (int z = 0; z < kSize.z; ++z) {
          const double was = double(exact.voxel(glm::ivec3(x, y, z) - 3));
          const double is = double(coded.voxel(glm::ivec3(x, y, z) - 3));
          worst = std::max(worst, std::abs(was - is));
          largest = std::max(largest, was);
          sums[0] += was;
          sums[1] += is;
        }
        worstLine = sums[0] > 1.0 ? std::max(worstLine, std::abs(sums[1] / sums[0] - 1.0)) : worstLine;
      }
    }
    const QuantisationError error = ErrorReference(exact).errorOf(coded);
    EXPECT_DOUBLE_EQ(error.voxel, worst / largest);
    EXPECT_GE(error.opticalDepth, worstLine * (1.0 - 1e-9)); // the worst of three axes
  }
}

TEST(Quantise, FloatIsExact) {
  const std::vector<float> values = blob(1.0);
  const BrickGrid grid = exactGrid(values);
  EXPECT_EQ(grid.report.quantisationError, 0.0);
  EXPECT_EQ(grid.report.opticalDepthError, 0.0);
}

TEST(Quantise, PicksTheNarrowestWithinTheTolerances) {
  const std::vector<float> values = blob(1.0);
  EXPECT_EQ(automatic(values, 1.0 / 400.0, 0.5), Storage::Unorm8);
  EXPECT_EQ(automatic(values, 1e-3, 0.5), Storage::Half);
  EXPECT_EQ(automatic(values, 1.0 / 400.0, 1e-3), Storage::Half);
  EXPECT_EQ(automatic(values, 1e-6, 0.5), Storage::Float);
  EXPECT_EQ(automatic(values, 1.0, 1e-9), Storage::Float);
}

TEST(Quantise, HalfIsNotChosenBeyondItsRange) {
  EXPECT_EQ(automatic(blob(1e6), 1e-3, 0.5), Storage::Float);
  EXPECT_EQ(automatic(blob(1e-12), 1e-3, 0.5), Storage::Float); // would underflow
  try {
    encoded(exactGrid(blob(1e6)), Storage::Half);
    FAIL() << "a value beyond half must be refused";
  } catch (const Error& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("\"float\""));
  }
}

TEST(Quantise, SurvivesExtremeValues) {
  const float huge = std::numeric_limits<float>::max();
  const float tiny = std::numeric_limits<float>::denorm_min();
  const std::vector<float> values{0.0f, huge, tiny, 1.0f, huge, 0.0f, 1e38f, tiny};
  for (const Storage storage : {Storage::Unorm8, Storage::Float}) {
    const BrickGrid grid = gridFromDense(values, glm::ivec3(2), glm::ivec3(0), glm::dmat4(1.0), storage);
    for (const Range& range : grid.ranges) {
      EXPECT_TRUE(std::isfinite(range.min) && std::isfinite(range.max) && std::isfinite(range.mean));
    }
    EXPECT_TRUE(std::isfinite(grid.value(glm::dvec3(0.5))));
    EXPECT_EQ(grid.voxel({0, 0, 0}), 0.0f);
  }
}

} // namespace
} // namespace tyndall::volume

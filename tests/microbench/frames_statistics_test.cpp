// SPDX-License-Identifier: Apache-2.0
#include "microbench/frames_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tyndall::microbench {
namespace {

/// 1000 pixels of radiance 2 that are all off by 0.2, but for the worst five: these are left out, however bad they are.
TEST(FrameError, IsThatOfAllButTheWorstPixels) {
  const std::vector<double> reference(1000, 2.0);
  std::vector<double> picture(1000, 2.2);
  std::fill_n(picture.begin() + 100, 5, 1e6);
  const double expected = 0.04 / (4.0 + 0.02 * 0.02);
  EXPECT_NEAR(frameError({picture, picture}, reference), expected, 1e-12);
  picture[0] = 1e6;
  EXPECT_GT(frameError({picture}, reference), 1e3) << "a sixth bad pixel was not seen";
}

/// Windows of three frames: one good frame is no recovery, three that are good on average are.
TEST(Recovery, ComesWithTheFirstWindowAtTheSteadyLevel) {
  const std::vector<double> steady(8, 1.0);
  EXPECT_EQ(framesToRecover(std::vector<double>{9, 9, 1, 9, 1.3, 1.2, 1.2, 1.3}, steady), 4u);
  EXPECT_EQ(framesToRecover(std::vector<double>{1, 1, 1, 9, 9, 9, 9, 9}, steady), 0u);
  EXPECT_EQ(framesToRecover(std::vector<double>{9, 9, 9, 9, 9, 9, 1, 1}, steady), std::nullopt);
}

} // namespace
} // namespace tyndall::microbench

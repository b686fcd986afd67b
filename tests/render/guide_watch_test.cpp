// SPDX-License-Identifier: Apache-2.0
// The trial that decides whether guiding pays, on sums with a known noise.
#include "render/guide_watch.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace tyndall::test {
namespace {

using render::GuideWatch;
using Trial = GuideWatch::Trial;

constexpr std::size_t kPixels = 64 * 256;

/// Half batches whose pixels have `mean` and the relative standard deviation `noise`.
std::vector<interop::PixelSums> half(double mean, double noise, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<interop::PixelSums> sums(kPixels);
  for (interop::PixelSums& pixel : sums) {
    for (int channel = 0; channel < 3; ++channel) {
      pixel.moments[channel] = 0.0f;
    }
    const float value = static_cast<float>(mean * (1.0 + noise * normal(random)));
    pixel.moments[0] = value;
    pixel.moments[1] = value;
    pixel.moments[2] = value;
  }
  return sums;
}

GuideWatch trial(double guidedNoise, double guidedSeconds, double plainNoise, double plainSeconds) {
  GuideWatch watch;
  watch.take(Trial::Guided, half(2.0, guidedNoise, 1), half(2.0, guidedNoise, 2), guidedSeconds);
  watch.take(Trial::Plain, half(2.0, plainNoise, 3), half(2.0, plainNoise, 4), plainSeconds);
  return watch;
}

// 16384 pixels: each variance is known to about 1.1 %, their ratio to 1.6 %; 8 % is five times that.
TEST(GuideWatch, GainIsTheRatioOfRelativeVarianceTimesTime) {
  EXPECT_NEAR(*trial(0.1, 1.0, 0.3, 1.0).gain(), 9.0, 0.08 * 9.0);
  EXPECT_NEAR(*trial(0.1, 3.0, 0.3, 1.0).gain(), 3.0, 0.08 * 3.0);
  EXPECT_NEAR(*trial(0.3, 2.0, 0.3, 1.0).gain(), 0.5, 0.08 * 0.5);
  EXPECT_NEAR(*trial(0.3, 2.0, 0.3, 4.0).gain(), 2.0, 0.08 * 2.0);
}

// Bright places must not decide alone: the gain is that of relative noise, the same at any brightness.
TEST(GuideWatch, BrightAndDarkPlacesCountAlike) {
  GuideWatch watch;
  for (const double mean : {1e-3, 1e3}) {
    const double guided = mean < 1.0 ? 0.1 : 0.2;
    watch.take(Trial::Guided, half(mean, guided, 5), half(mean, guided, 6), 1.0);
  }
  for (const double mean : {1e-3, 1e3}) {
    watch.take(Trial::Plain, half(mean, 0.2, 7), half(mean, 0.2, 8), 1.0);
  }
  EXPECT_NEAR(*watch.gain(), 0.08 / 0.05, 0.08 * 1.6);
}

TEST(GuideWatch, ABlackPictureAndAMissingTrialDecideNothing) {
  GuideWatch watch;
  EXPECT_FALSE(watch.gain().has_value());
  watch.take(Trial::Guided, half(0.0, 0.0, 1), half(0.0, 0.0, 1), 1.0);
  EXPECT_FALSE(watch.gain().has_value());
  watch.take(Trial::Plain, half(0.0, 0.0, 1), half(0.0, 0.0, 1), 1.0);
  EXPECT_EQ(*watch.gain(), 1.0);
}

// Learns, tries guiding, tries going without, and then does what has won.
TEST(GuideTrial, FollowsItsPlan) {
  render::GuideTrial trial(true);
  EXPECT_FALSE(trial.watched({16, 16})) << "one that goes on from a later batch has learnt nothing";
  trial.begin({0, 1});
  EXPECT_TRUE(trial.guided({0, 16}) && !trial.watched({0, 16}));
  EXPECT_TRUE(trial.guided({16, 16}) && trial.watched({16, 16}));
  EXPECT_TRUE(!trial.guided({32, 16}) && trial.watched({32, 16}));
  EXPECT_FALSE(trial.watched({16, 4})) << "a part of a batch says too little";
  trial.take({16, 16}, half(2.0, 0.3, 1), half(2.0, 0.3, 2), 1.0);
  EXPECT_TRUE(trial.guided({48, 16})) << "nothing is known yet";
  trial.take({32, 16}, half(2.0, 0.1, 3), half(2.0, 0.1, 4), 1.0);
  EXPECT_FALSE(trial.guided({48, 16}));
  EXPECT_TRUE(render::GuideTrial(false).guided({48, 16}));
  EXPECT_FALSE(render::GuideTrial(false).watched({16, 16}));
}

} // namespace
} // namespace tyndall::test

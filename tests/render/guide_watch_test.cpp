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

// A thirty-second of the samples learn, half as many try guiding, as many going without, and then what has won is done.
TEST(GuideTrial, FollowsItsPlan) {
  render::GuideTrial trial(true, 600);
  EXPECT_FALSE(trial.watched({16, 8})) << "one that goes on from later samples has learnt nothing";
  trial.begin({0, 1});
  EXPECT_TRUE(trial.guided({8, 8}) && !trial.watched({8, 8}));
  EXPECT_TRUE(trial.guided({16, 8}) && trial.watched({16, 8}));
  EXPECT_TRUE(!trial.guided({24, 8}) && trial.watched({24, 8}));
  EXPECT_FALSE(trial.watched({16, 4})) << "a part of a trial says too little";
  trial.take({16, 8}, half(2.0, 0.3, 1), half(2.0, 0.3, 2), 1.0);
  EXPECT_TRUE(trial.guided({32, 16})) << "nothing is known yet";
  trial.take({24, 8}, half(2.0, 0.1, 3), half(2.0, 0.1, 4), 1.0);
  EXPECT_FALSE(trial.guided({32, 16}));
  trial.begin({0, 1});
  EXPECT_TRUE(trial.guided({32, 16})) << "another picture has trials of its own";
}

/// How samples 0 to 15 are cut.
std::vector<std::uint32_t> pieces(std::uint32_t planned) {
  render::GuideTrial trial(true, planned);
  trial.begin({0, 16});
  std::vector<std::uint32_t> counts;
  for (render::SampleRange left{0, 16}; left.count > 0;) {
    counts.push_back(trial.leading(left).count);
    left = {left.first + counts.back(), left.count - counts.back()};
  }
  return counts;
}

TEST(GuideTrial, CostsAPartOfThePicture) {
  using Counts = std::vector<std::uint32_t>;
  EXPECT_EQ(pieces(64), (Counts{4, 2, 2, 8}));
  EXPECT_EQ(pieces(128), (Counts{4, 2, 2, 8}));
  EXPECT_EQ(pieces(320), (Counts{8, 4, 4}));
  EXPECT_EQ(pieces(1u << 30), (Counts{16})) << "the longest trials are batches";
  EXPECT_EQ(pieces(63), (Counts{16})) << "too short for two halves each";
  EXPECT_EQ(render::GuideTrial(false, 64).leading({0, 16}).count, 16);
  EXPECT_TRUE(render::GuideTrial(false, 64).guided({6, 2})) << "who does not watch stays guided";
}

} // namespace
} // namespace tyndall::test

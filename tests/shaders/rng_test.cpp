// SPDX-License-Identifier: Apache-2.0
#include "support/probe.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/rng_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace tyndall::test {
namespace {

enum Mode : std::uint32_t { Words, Floats };
enum Planted : std::uint32_t { None, SampleForgotten, Float24 };

struct Push {
  interop::Ptr<std::uint32_t> words;
  interop::Ptr<float> floats;
  std::uint32_t count;
  std::uint32_t draws;
  std::uint32_t width;
  std::uint32_t firstWord;
};

constexpr std::uint32_t kWidth = 24;
constexpr std::uint32_t kStreams = kWidth * kWidth * kWidth * 8;
constexpr std::uint32_t kDraws = 16;

/// The first kDraws words of each stream of a box of pixels, samples and seeds.
std::vector<std::uint32_t> words(Planted planted) {
  const ProbeRunner probe(k_rng_probe_spirv, {{0, Words}, {1, planted}});
  const auto out = ProbeRunner::results<std::uint32_t>(std::size_t(kStreams) * kDraws);
  const auto none = ProbeRunner::results<float>(1);
  probe.run(Push{out.ptr(), none.ptr(), kStreams, kDraws, kWidth, 0}, kStreams);
  return ProbeRunner::download(out);
}

std::vector<float> floats(std::uint32_t firstWord, std::uint32_t count, Planted planted) {
  const ProbeRunner probe(k_rng_probe_spirv, {{0, Floats}, {1, planted}});
  const auto out = ProbeRunner::results<float>(count);
  const auto none = ProbeRunner::results<std::uint32_t>(1);
  probe.run(Push{none.ptr(), out.ptr(), count, 0, 1, firstWord}, count);
  return ProbeRunner::download(out);
}

double equidistribution(const std::vector<std::uint32_t>& values, std::size_t stride, int shift) {
  std::vector<std::uint64_t> counts(256);
  for (std::size_t i = 0; i + stride < values.size(); i += stride) {
    ++counts[(values[i] >> shift) & 255u];
  }
  return chiSquaredPValue(counts, std::vector<double>(256, 1.0 / 256.0));
}

/// Of the pairs of one word and the word `lag` after it, by their top four bits.
double pairIndependence(const std::vector<std::uint32_t>& values, std::size_t lag) {
  std::vector<std::uint64_t> counts(256);
  for (std::size_t i = 0; i + lag < values.size(); i += 2 * lag) {
    for (std::size_t j = i; j < std::min(i + lag, values.size() - lag); ++j) {
      ++counts[(values[j] >> 28) * 16 + (values[j + lag] >> 28)];
    }
  }
  return chiSquaredPValue(counts, std::vector<double>(256, 1.0 / 256.0));
}

std::size_t distinctStreams(const std::vector<std::uint32_t>& values) {
  std::vector<std::array<std::uint32_t, 4>> firsts;
  for (std::size_t i = 0; i < values.size(); i += kDraws) {
    firsts.push_back({values[i], values[i + 1], values[i + 2], values[i + 3]});
  }
  std::sort(firsts.begin(), firsts.end());
  return static_cast<std::size_t>(std::unique(firsts.begin(), firsts.end()) - firsts.begin());
}

TEST(Rng, StreamsAreDistinct) {
  EXPECT_EQ(distinctStreams(words(None)), kStreams);
  EXPECT_LT(distinctStreams(words(SampleForgotten)), kStreams);
}

TEST(Rng, WordsAreEquidistributedAndIndependentOfTheirNeighbours) {
  const std::vector<std::uint32_t> values = words(None);
  for (const int shift : {0, 8, 16, 24}) {
    EXPECT_GT(equidistribution(values, 1, shift), kMinPValue) << shift;
    EXPECT_GT(equidistribution(values, kDraws, shift), kMinPValue) << "first words, " << shift;
  }
  // Next word of the stream, then the same word of the next pixel, row, sample and seed.
  for (const std::size_t lag : {1u, kDraws, kDraws * kWidth, kDraws * kWidth * kWidth, kDraws * kWidth * kWidth * kWidth}) {
    EXPECT_GT(pairIndependence(values, lag), kMinPValue) << lag;
  }
  EXPECT_LT(pairIndependence(words(SampleForgotten), kDraws * kWidth * kWidth), kMinPValue);
}

TEST(Rng, FloatsKeepTheirSmallValues) {
  const auto below = [](const std::vector<float>& values, double bound) {
    return std::count_if(values.begin(), values.end(), [&](float xi) { return static_cast<double>(xi) < bound; });
  };
  const std::vector<float> low = floats(0, 1u << 16, None);
  // P(xi < 1e-8) is the share of the 2^32 words that become less: all of those are among the first 2^16.
  EXPECT_EQ(below(low, 1e-8), 43); // 43 / 2^32 = 1.001e-8
  EXPECT_EQ(below(low, 1e-6), 4295);
  EXPECT_GT(low.front(), 0.0f);
  EXPECT_TRUE(std::is_sorted(low.begin(), low.end()));
  EXPECT_NE(below(floats(0, 1u << 16, Float24), 1e-8), 43);
  const std::vector<float> high = floats(0xffff0000u, 1u << 16, None);
  EXPECT_LT(*std::max_element(high.begin(), high.end()), 1.0f);
  EXPECT_TRUE(std::is_sorted(high.begin(), high.end()));
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// Texture lookups against their definition in double.
#include "shaders/material_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::test {
namespace {

using interop::TextureAnswer;
using interop::TextureQuery;
using interop::TextureUse;

/// The share of queries whose answer is off by more than float coordinates explain, of `shown` against `meant`.
double wrongShare(const Image& shown, const TextureUse& shownUse, const Image& meant, const TextureUse& meantUse) {
  const std::vector<TextureQuery> queries = randomPlaces(shownUse, 3.0, 20000);
  const std::vector<TextureAnswer> answers = askTextures(queries, interop::kProbeLookup, {shown});
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const glm::dvec4 expected = oracleLookup(meant, meantUse, glm::dvec2(queries[i].uv));
    const glm::dvec4 got(answers[i].colour, answers[i].opacity);
    // Coordinates of 8 are off by 5e-7, times the texels in a side.
    const double allowed = 1e-6 + 1e-6 * static_cast<double>(std::max(meant.size.x, meant.size.y));
    const glm::dvec4 error = glm::abs(got - expected);
    wrong += std::max({error.x, error.y, error.z, error.w}) < allowed ? 0 : 1;
  }
  return static_cast<double>(wrong) / static_cast<double>(queries.size());
}

TEST(Textures, LookupsAreTheDefinition) {
  for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(2, 3), glm::uvec2(64, 17)}) {
    for (const std::uint32_t wrapU : {interop::kWrapRepeat, interop::kWrapClamp, interop::kWrapMirror}) {
      for (const std::uint32_t wrapV : {interop::kWrapRepeat, interop::kWrapClamp, interop::kWrapMirror}) {
        Image image = randomImage(size, 7);
        image.wrapU = wrapU;
        image.wrapV = wrapV;
        for (const bool srgb : {false, true}) {
          image.srgb = srgb;
          EXPECT_EQ(wrongShare(image, kPlain, image, kPlain), 0.0)
              << size.x << ' ' << wrapU << ' ' << wrapV << ' ' << srgb;
          EXPECT_EQ(wrongShare(image, kTurned, image, kTurned), 0.0)
              << size.x << ' ' << wrapU << ' ' << wrapV << ' ' << srgb;
        }
        image.nearest = true;
        // On the border of two texels rounding decides.
        EXPECT_LT(wrongShare(image, kTurned, image, kTurned), 1e-3) << size.x << ' ' << wrapU << ' ' << wrapV;
      }
    }
  }
}

TEST(Textures, LookupCheckerSeesPlantedBugs) {
  const Image image = randomImage({16, 9}, 7);
  Image other = image;
  other.wrapU = interop::kWrapMirror;
  EXPECT_GT(wrongShare(other, kPlain, image, kPlain), 0.1);
  other = image;
  other.wrapV = interop::kWrapClamp;
  EXPECT_GT(wrongShare(other, kPlain, image, kPlain), 0.1);
  other = image;
  other.srgb = true;
  EXPECT_GT(wrongShare(other, kPlain, image, kPlain), 0.1);
  other = image;
  other.nearest = true;
  EXPECT_GT(wrongShare(other, kPlain, image, kPlain), 0.1);
  TextureUse shifted = kPlain;
  shifted.rowU.z = 0.001f;
  EXPECT_GT(wrongShare(image, shifted, image, kPlain), 0.1);
  EXPECT_GT(wrongShare(image, {0, kPlain.rowV, kPlain.rowU}, image, kPlain), 0.1);
}

TEST(Textures, SrgbIsDecodedToSixDigits) {
  Image image{.size = {256, 1}, .srgb = true, .nearest = true};
  std::vector<TextureQuery> queries(256);
  for (std::uint32_t i = 0; i < 256; ++i) {
    image.texels.push_back(packedTexel({i, i, i, i}));
    queries[i].use = kPlain;
    queries[i].uv = {(static_cast<float>(i) + 0.5f) / 256.0f, 0.5f};
  }
  const std::vector<TextureAnswer> answers = askTextures(queries, interop::kProbeLookup, {image});
  for (std::size_t i = 1; i < 256; ++i) {
    const double encoded = static_cast<double>(i) / 255.0;
    EXPECT_NEAR(static_cast<double>(answers[i].colour.y) / srgbToLinear(encoded), 1.0, 1e-6) << i;
    EXPECT_NEAR(static_cast<double>(answers[i].opacity), encoded, 1e-7) << i;
    EXPECT_GT(std::abs(std::pow(encoded, 2.2) / srgbToLinear(encoded) - 1.0), i == 255 ? -1.0 : 1e-6)
        << i; // could be told from a power
  }
  EXPECT_EQ(answers[0].colour, glm::vec3(0.0f));
}

/// Texels have bytes 100 to 200, what lies beside them in memory has not: every answer must be of the texture.
TEST(Textures, CoordinatesOfAnySizeStayInside) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> hard{0.0f,  -0.0f, 1.0f,   -1.0f, 1e-30f, -1e-30f,   -1e-9f,     0.99999994f,   8388607.5f,
                                -1e7f, 1e10f, -1e20f, 3e38f, -3e38f, kInfinity, -kInfinity, std::nanf(""), 2.0f};
  const auto outside = [&](std::uint32_t lowest) {
    std::size_t count = 0;
    for (std::uint32_t wrap = 0; wrap < 3; ++wrap) {
      for (const bool nearest : {false, true}) {
        Image image = randomImage({5, 3}, 2, lowest, 200);
        image.wrapU = image.wrapV = wrap;
        image.nearest = nearest;
        std::vector<TextureQuery> queries;
        for (const float u : hard) {
          for (const float v : hard) {
            queries.push_back(lookupQuery(kPlain, {u, v}));
            queries.push_back(lookupQuery(kTurned, {u, v}));
          }
        }
        for (const TextureAnswer& answer : askTextures(queries, interop::kProbeLookup, {image})) {
          const glm::vec4 value(answer.colour, answer.opacity);
          for (int c = 0; c < 4; ++c) {
            count += value[c] > 99.9f / 255.0f && value[c] < 200.1f / 255.0f ? 0 : 1;
          }
        }
      }
    }
    return count;
  };
  EXPECT_EQ(outside(100), 0u);
  EXPECT_GT(outside(0), 0u); // the checker counts
}

} // namespace
} // namespace tyndall::test

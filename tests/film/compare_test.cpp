// SPDX-License-Identifier: Apache-2.0
#include "film/compare.h"

#include "film/difference.h"
#include "film_fixture.h"

#include <cmath>
#include <limits>

namespace tyndall::film {
namespace {

constexpr float kNoise = 0.05f;

Image flatImage(glm::uvec2 size, float value) {
  Image image{size, {{0, 0}, size}, {}, {}, {}};
  for (const char* name : {"R", "G", "B", "A"}) {
    image.channels[name].assign(image.window.pixelCount(), value);
  }
  return image;
}

/// Value 1 with normal noise, whose deviation the stderr layer states.
Image noisyImage(unsigned seed) {
  Image image = flatImage({64, 64}, 1.0f);
  std::mt19937 generator(seed);
  std::normal_distribution<float> noise(1.0f, kNoise);
  for (const char* name : {"R", "G", "B"}) {
    for (float& pixel : image.channels[name]) {
      pixel = noise(generator);
    }
    image.channels[std::string("stderr.") + name].assign(64 * 64, kNoise);
  }
  return image;
}

Comparison compareTo(const Image& image, const Image& reference) {
  return compare({"image.exr", image}, {"reference.exr", reference});
}

TEST(Compare, MeasuresFollowTheirDefinitions) {
  Image reference = flatImage({2, 1}, 1.0f);
  reference.channels["R"] = {2.0f, 0.0f};
  reference.channels["A"] = {1.0f, 0.005f};  // the second pixel is not covered
  Image image = reference;
  image.channels["R"] = {2.5f, 0.25f};
  const Comparison result = compareTo(image, reference);
  EXPECT_EQ(result.pixels, 2u);
  EXPECT_EQ(result.coveredPixels, 1u);
  EXPECT_DOUBLE_EQ(result.mse, (0.25 + 0.0625) / 6.0);
  const double eps = 0.01;  // the mean of the reference's six values is 1
  EXPECT_DOUBLE_EQ(result.relMse, (0.25 / (4.0 + eps * eps) + 0.0625 / (eps * eps)) / 6.0);
  EXPECT_DOUBLE_EQ(result.rRmse, std::sqrt(0.25 / 6.0));
  EXPECT_DOUBLE_EQ(result.maxDifference, 0.5);
  EXPECT_DOUBLE_EQ(result.bias[0].relative, 0.375);
  EXPECT_EQ(result.bias[1].relative, 0.0);
  EXPECT_FALSE(result.tiles.has_value());
}

TEST(Compare, TheTransmittanceLayerDecidesCoverBeforeAlpha) {
  Image reference = flatImage({2, 1}, 1.0f);
  reference.channels["transmittance.Y"] = {1.0f, 0.5f};
  EXPECT_EQ(compareTo(reference, reference).coveredPixels, 1u);
}

TEST(Compare, EqualPicturesPassEvenWhenBlack) {
  const Image black = flatImage({4, 4}, 0.0f);
  const Comparison result = compareTo(black, black);
  EXPECT_EQ(result.relMse, 0.0);
  EXPECT_EQ(result.rRmse, 0.0);
  EXPECT_TRUE(failures(result, {.maxRrmse = 0.0, .maxBias = 0.0}).empty());
}

TEST(Compare, FalseAlarmsOfTheTileTestAreAsRareAsStated) {
  int alarms = 0;
  constexpr int kReplicates = 400;
  for (int i = 0; i < kReplicates; ++i) {
    alarms += compareTo(noisyImage(2 * i), noisyImage(2 * i + 1)).tiles->familyP < 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(double(alarms) / kReplicates, 0.1, 0.075);  // 5 standard errors
}

TEST(Compare, HonestNoisePasses) {
  const Comparison result = compareTo(noisyImage(1), noisyImage(2));
  EXPECT_TRUE(failures(result, {}).empty()) << formatTable(result);
  EXPECT_NEAR(*result.bias[0].standardError, std::sqrt(2.0) * double(kNoise) / 64.0, 1e-6);
}

TEST(Compare, ABiasOfAHalfPercentIsFoundInTheMean) {
  Image image = noisyImage(1);
  for (float& pixel : image.channels["G"]) {
    pixel *= 1.007f;
  }
  const Comparison result = compareTo(image, noisyImage(2));
  EXPECT_GT(result.bias[1].z, 4.5);
  EXPECT_EQ(failures(result, {}).size(), 1u) << formatTable(result);
}

TEST(Compare, AFaultInOneTileIsFoundAndPlaced) {
  Image image = noisyImage(1);
  for (unsigned y = 32; y < 48; ++y) {
    for (unsigned x = 16; x < 32; ++x) {
      image.channels["B"][y * 64 + x] -= 0.04f;
    }
  }
  const Comparison result = compareTo(image, noisyImage(2));
  EXPECT_EQ(result.tiles->worstTile, glm::uvec2(16, 32));
  EXPECT_EQ(result.tiles->worstChannel, 2);
  EXPECT_LT(result.tiles->familyP, 1e-4);
  EXPECT_EQ(result.tiles->tests, 48u);
  EXPECT_FALSE(failures(result, {}).empty());
}

TEST(Compare, AnImageWithoutErrorLayerCountsAsExact) {
  const Comparison result = compareTo(noisyImage(1), flatImage({64, 64}, 1.0f));
  EXPECT_NEAR(*result.bias[2].standardError, double(kNoise) / 64.0, 1e-6);
  EXPECT_LT(std::abs(result.bias[2].z), 5.0);
}

TEST(Compare, NonFinitePixelsAreCountedLeftOutAndFail) {
  Image image = flatImage({4, 4}, 1.0f);
  image.channels["R"][3] = std::numeric_limits<float>::quiet_NaN();
  const Comparison result = compareTo(image, flatImage({4, 4}, 1.0f));
  EXPECT_EQ(result.nonFiniteImage, 1u);
  EXPECT_EQ(result.pixels, 15u);
  EXPECT_EQ(result.mse, 0.0);
  EXPECT_EQ(failures(result, {}).size(), 1u);
  const Image allBad = flatImage({2, 2}, std::numeric_limits<float>::infinity());
  EXPECT_FALSE(failures(compareTo(allBad, allBad), {}).empty());
}

TEST(Compare, LimitsFailWhenExceeded) {
  const Comparison result = compareTo(flatImage({4, 4}, 1.02f), flatImage({4, 4}, 1.0f));
  EXPECT_TRUE(failures(result, {.maxRrmse = 0.021, .maxBias = 0.021}).empty());
  EXPECT_EQ(failures(result, {.maxRrmse = 0.019}).size(), 1u);
  EXPECT_EQ(failures(result, {.maxBias = 0.019}).size(), 3u);
}

TEST(Compare, UnequalShapesAndMissingColourAreNamed) {
  EXPECT_NE(errorOf([] { compareTo(flatImage({4, 4}, 1.0f), flatImage({5, 4}, 1.0f)); }).find("5x4"),
            std::string::npos);
  Image crop = flatImage({2, 2}, 1.0f);
  crop.displaySize = {4, 4};
  EXPECT_NE(errorOf([&] { compareTo(crop, flatImage({4, 4}, 1.0f)); }).find("equal crops"), std::string::npos);
  Image grey = flatImage({4, 4}, 1.0f);
  grey.channels.erase("B");
  EXPECT_TRUE(errorOf([&] { compareTo(flatImage({4, 4}, 1.0f), grey); }).starts_with("reference.exr"));
}

TEST(Compare, TheTableNamesEveryFigure) {
  const std::string table = formatTable(compareTo(noisyImage(1), noisyImage(2)));
  for (const char* name : {"MSE", "relMSE", "rRMSE", "bias G", "tiles", "non-finite", "max difference"}) {
    EXPECT_NE(table.find(name), std::string::npos) << name << " not in\n" << table;
  }
}

TEST(Difference, FullScaleIsTheDifferenceAndTheFileAppears) {
  const TemporaryFolder folder;
  const Image a = flatImage({8, 8}, 1.5f);
  const Image b = flatImage({8, 8}, 1.0f);
  EXPECT_DOUBLE_EQ(writeDifferencePng(folder / "d.png", {"a", a}, {"b", b}).full, 0.5);
  EXPECT_TRUE(bytesOf(folder / "d.png").starts_with("\x89PNG"));
  EXPECT_EQ(writeDifferencePng(folder / "d.png", {"a", a}, {"a", a}).full, 0.0);
}

} // namespace
} // namespace tyndall::film

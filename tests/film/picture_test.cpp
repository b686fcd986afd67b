// SPDX-License-Identifier: Apache-2.0
#include "film/picture.h"

#include "film/png.h"
#include "film_fixture.h"
#include "math/colour.h"

#include <png.h>


#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::film {
namespace {

/// 3x1 pixels of two batches; pixel x: colour means x, 2x, 3x; transmittance 0.25.
Film handMadeFilm() {
  Film film({3, 1}, {{0, 0}, {3, 1}});
  for (std::size_t x = 0; x < 3; ++x) {
    for (std::uint32_t batch = 0; batch < 2; ++batch) {
      const float sum = 16.0f * float(x);
      const float opacity = x == 0 ? 0.0f : 8.0f;
      film.add(x, batch, 16,
               {{sum, 2.0f * sum, 3.0f * sum, 4.0f}, {1.6f, 3.2f, 4.8f, 10.0f * opacity, opacity, sum, sum, sum}});
    }
  }
  film.metadata["seed"] = "5";
  return film;
}

Image uniformImage(glm::uvec2 size, float value) {
  Image image{size, {{0, 0}, size}, {}, {}, {}};
  for (const char* name : {"R", "G", "B"}) {
    image.channels[name].assign(image.window.pixelCount(), value);
  }
  return image;
}

/// Colours that do not pack.
Image makeNoise(glm::uvec2 size) {
  Image image = uniformImage(size, 0.0f);
  std::mt19937 generator(4);
  std::lognormal_distribution<float> bright(-3.0f, 2.5f);
  for (auto& [name, pixels] : image.channels) {
    std::ranges::generate(pixels, [&] { return bright(generator); });
  }
  return image;
}

std::vector<std::uint8_t> decodePng(const std::filesystem::path& path) {
  png_image picture{};
  picture.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&picture, path.c_str()), 0) << picture.message;
  picture.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(picture));
  EXPECT_NE(png_image_finish_read(&picture, nullptr, bytes.data(), 0, nullptr), 0) << picture.message;
  return bytes;
}

TEST(Picture, ColourAndAlphaComeFromTheMeans) {
  const Image image = makeImage(handMadeFilm(), {});
  EXPECT_EQ(image.channels.size(), 4u);
  EXPECT_EQ(image.channels.at("G")[2], 4.0f);
  EXPECT_EQ(image.channels.at("A")[1], 0.75f);
  EXPECT_EQ(image.metadata.at("seed"), "5");
}

TEST(Picture, AnOpaqueBackgroundHasAlphaOneAndATransparentOneItsLayer) {
  const Image opaque = makeImage(handMadeFilm(), {.opaqueBackground = true});
  EXPECT_EQ(opaque.channels.at("A")[1], 1.0f);
  EXPECT_FALSE(opaque.channels.contains("background.R"));
  const Image transparent = makeImage(handMadeFilm(), {.transparent = true, .opaqueBackground = true});
  EXPECT_EQ(transparent.channels.at("A")[1], 0.75f);
  EXPECT_FLOAT_EQ(transparent.channels.at("background.B")[1], 0.3f);
}

TEST(Picture, EveryAovByName) {
  Film film = handMadeFilm();
  film.add(1, 2, 16, {{64.0f, 0.0f, 0.0f, 0.0f}, {}});
  const Image image = makeImage(film, {.aovs = aovNames()});
  EXPECT_FLOAT_EQ(image.channels.at("stderr.R")[1], float(std::sqrt(film.varianceOfMean(1, R))));
  EXPECT_GT(image.channels.at("stderr.R")[1], 0.0f);
  EXPECT_EQ(image.channels.at("transmittance.Y")[0], 0.25f);
  EXPECT_EQ(image.channels.at("depth.Z")[0], kFarDepth);
  EXPECT_FLOAT_EQ(image.channels.at("depth.Z")[2], 10.0f);
  EXPECT_EQ(image.uintChannels.at("samples.Y"), (std::vector<std::uint32_t>{32, 48, 32}));
  EXPECT_EQ(image.channels.at("albedo.B")[2], 2.0f);
}

TEST(Picture, AnUnknownAovNamesTheNearestAndAll) {
  const std::string message = errorOf([] { makeImage(handMadeFilm(), {.aovs = {"dept"}}); });
  EXPECT_NE(message.find("did you mean depth"), std::string::npos) << message;
  EXPECT_NE(message.find("transmittance"), std::string::npos) << message;
}

TEST(Filmic, RisesFromZeroThroughMiddleGreyToWhite) {
  EXPECT_EQ(filmic(0.0), 0.0);
  EXPECT_NEAR(filmic(0.18), 0.18, 1e-12);
  EXPECT_NEAR(filmic(16.0), 1.0, 1e-12);
  for (double x = 1e-6; x < 1e6; x *= 1.1) {
    EXPECT_GT(filmic(1.1 * x), filmic(x));
  }
}

TEST(Filmic, EveryChannelRisesWithExposureAndTheOrderOfChannelsStays) {
  const glm::dvec3 flame(1.0, 0.4, 0.05);
  glm::dvec3 before(0.0);
  for (double gain = 1e-4; gain < 1e4; gain *= 1.05) {
    const glm::dvec3 shown = displayColour(gain * flame, View::Filmic);
    EXPECT_TRUE(glm::all(glm::greaterThan(shown, before))) << gain;
    EXPECT_GT(shown.r, shown.g);
    EXPECT_GT(shown.g, shown.b);
    // The line to white keeps the hue: (G - B) / (R - B) stays.
    EXPECT_NEAR((shown.g - shown.b) / (shown.r - shown.b), 0.35 / 0.95, 1e-9);
    before = shown;
  }
}

TEST(Png, StandardViewRoundTripsSrgbCodes) {
  const TemporaryFolder folder;
  for (const float value : {0.0f, 0.001f, 0.18f, 0.5f, 1.0f}) {
    writePng(folder / "a.png", uniformImage({8, 8}, value), {});
    const double expected = 255.0 * srgbFromLinear(double(value));
    double mean = 0.0;
    for (const std::uint8_t code : decodePng(folder / "a.png")) {
      EXPECT_LT(std::abs(code - expected), 1.0);
      mean += code / 192.0;
    }
    EXPECT_NEAR(mean, expected, 1.0 / 64.0);  // the dither keeps the mean to its own step
  }
}

TEST(Png, ExposureBackgroundAndClippingAreApplied) {
  const TemporaryFolder folder;
  Image image = uniformImage({10, 10}, 0.25f);
  EXPECT_EQ(writePng(folder / "a.png", image, {.exposure = 2.0}).clippedShare, 0.0);
  EXPECT_EQ(decodePng(folder / "a.png").front(), 255);
  image.channels["R"][7] = 0.26f;
  EXPECT_DOUBLE_EQ(writePng(folder / "a.png", image, {.exposure = 2.0}).clippedShare, 0.01);
  EXPECT_EQ(writePng(folder / "a.png", image, {.exposure = 2.0, .view = View::Filmic}).clippedShare, 0.0);
  for (const char* name : {"background.R", "background.G", "background.B"}) {
    image.channels[name].assign(100, 0.75f);
  }
  writePng(folder / "a.png", image, {});
  EXPECT_EQ(decodePng(folder / "a.png").front(), 255);
}

TEST(Png, NegativeAndNonFinitePixelsAreSafeAndCounted) {
  const TemporaryFolder folder;
  Image image = uniformImage({4, 1}, -0.5f);
  image.channels["G"][1] = std::numeric_limits<float>::quiet_NaN();
  image.channels["G"][2] = std::numeric_limits<float>::infinity();
  for (const View view : {View::Standard, View::Filmic}) {
    const PngReport report = writePng(folder / "a.png", image, {.view = view});
    EXPECT_EQ(report.nonFinitePixels, 2u);
    EXPECT_EQ(report.clippedShare, 0.25);
    const std::vector<std::uint8_t> bytes = decodePng(folder / "a.png");
    EXPECT_EQ(bytes[0], 0);
    EXPECT_EQ(bytes[3 * 2 + 1], 255);
  }
}

TEST(Png, UnwritableOutputsLeaveNothingBehind) {
  const TemporaryFolder folder;
  EXPECT_THROW(writePng(folder / "none/a.png", uniformImage({2, 2}, 0.5f), {}), Error);
  Image noColour = uniformImage({2, 2}, 0.5f);
  noColour.channels.erase("R");
  EXPECT_THROW(writePng(folder / "a.png", noColour, {}), Error);
  {
    const FullDisk disk;
    EXPECT_THROW(writePng(folder / "a.png", makeNoise({64, 64}), {}), Error);
  }
  EXPECT_TRUE(folder.empty());
}

TEST(AutoExposure, AFlatPictureGoesToMiddleGrey) {
  EXPECT_NEAR(autoExposure(uniformImage({20, 20}, 0.045f)), 2.0, 1e-5);
  EXPECT_NEAR(autoExposure(uniformImage({20, 20}, 1.8e6f)), std::log2(1e-7), 1e-5);
}

TEST(AutoExposure, LessThanHalfAPercentClips) {
  const TemporaryFolder folder;
  for (const unsigned side : {1u, 5u, 14u, 15u, 60u}) {
    const Image image = makeNoise({side, side});
    const double stops = autoExposure(image);
    EXPECT_LT(writePng(folder / "a.png", image, {.exposure = stops}).clippedShare, 0.005) << side;
    // So wide a spread is limited by its highlights: a stop more clips, nothing is given away. (One pixel is grey.)
    if (side > 1) {
      EXPECT_GT(writePng(folder / "a.png", image, {.exposure = stops + 1.0}).clippedShare, 0.0) << side;
    }
  }
}

TEST(AutoExposure, ADarkSurroundingDoesNotBrightenTheSubject) {
  Image image = uniformImage({20, 20}, 1e-7f);
  for (auto& [name, pixels] : image.channels) {
    std::fill_n(pixels.begin(), 100, 0.18f);
  }
  EXPECT_NEAR(autoExposure(image), 0.0, 1e-5);
}

TEST(AutoExposure, PicturesWithoutLightStayAtZero) {
  EXPECT_EQ(autoExposure(uniformImage({4, 4}, 0.0f)), 0.0);
  EXPECT_EQ(autoExposure(uniformImage({4, 4}, -1.0f)), 0.0);
  EXPECT_EQ(autoExposure(uniformImage({4, 4}, std::numeric_limits<float>::quiet_NaN())), 0.0);
  EXPECT_EQ(autoExposure(uniformImage({0, 0}, 0.0f)), 0.0);
}

TEST(AutoExposure, OneBrightPixelInABlackPictureIsFound) {
  Image image = uniformImage({100, 100}, 0.0f);
  for (auto& [name, pixels] : image.channels) {
    pixels[5] = 0.09f;
  }
  EXPECT_NEAR(autoExposure(image), 1.0, 1e-5);
}

} // namespace
} // namespace tyndall::film

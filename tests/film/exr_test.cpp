// SPDX-License-Identifier: Apache-2.0
#include "film/exr.h"

#include "film_fixture.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tyndall::film {
namespace {

/// A 23x17 crop of a 64x48 picture with float and integer channels and metadata.
Image testImage() {
  Image image{{64, 48}, {{5, 7}, {28, 24}}, {}, {}, {{"scene.hash", "00ff"}, {"seed", "3"}}};
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> uniform(0.0f, 2.0f);
  for (const char* name : {"R", "G", "B", "A", "stderr.R"}) {
    for (std::size_t i = 0; i < image.window.pixelCount(); ++i) {
      image.channels[name].push_back(uniform(generator));
    }
  }
  for (std::size_t i = 0; i < image.window.pixelCount(); ++i) {
    image.uintChannels["samples.Y"].push_back(std::uint32_t(4000000000u + i));
  }
  return image;
}

/// Output of a command, or nothing if the program is not there.
std::string outputOf(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
    text.append(block.data(), count);
  }
  return ::pclose(pipe) == 0 ? text : "failed: " + text;
}

bool hasProgram(const std::string& name) { return !outputOf("command -v " + name).starts_with("failed"); }

TEST(Exr, RoundTripKeepsEveryBit) {
  const TemporaryFolder folder;
  const Image written = testImage();
  writeExr(folder / "a.exr", written);
  const Image read = readExr(folder / "a.exr");
  EXPECT_EQ(read.displaySize, written.displaySize);
  EXPECT_EQ(read.window, written.window);
  EXPECT_EQ(read.channels, written.channels);
  EXPECT_EQ(read.uintChannels, written.uintChannels);
  EXPECT_EQ(read.metadata, written.metadata);
}

TEST(Exr, NonFinitePixelsAreKept) {
  const TemporaryFolder folder;
  Image image = testImage();
  image.channels["R"][0] = std::numeric_limits<float>::quiet_NaN();
  image.channels["R"][1] = -std::numeric_limits<float>::infinity();
  writeExr(folder / "a.exr", image);
  const Image read = readExr(folder / "a.exr");
  EXPECT_TRUE(std::isnan(read.channels.at("R")[0]));
  EXPECT_EQ(read.channels.at("R")[1], -std::numeric_limits<float>::infinity());
}

TEST(Exr, OpenExrsOwnToolReadsTheHeader) {
  ASSERT_TRUE(hasProgram("exrheader")) << "install the package openexr, as ./tyndall test does";
  const TemporaryFolder folder;
  writeExr(folder / "a.exr", testImage());
  const std::string header = outputOf("exrheader " + (folder / "a.exr").string());
  for (const char* part : {"chromaticities", "red   (0.64 0.33)", "dataWindow (type box2i): (5 7) - (27 23)",
                           "displayWindow (type box2i): (0 0) - (63 47)", "tyndall:scene.hash", "32-bit floating-point",
                           "32-bit unsigned integer", "zip"}) {
    EXPECT_NE(header.find(part), std::string::npos) << part << " not in\n" << header;
  }
}

TEST(Exr, OpenImageIoReadsTheSamePixels) {
  if (!hasProgram("oiiotool")) {
    GTEST_SKIP() << "oiiotool is not installed";
  }
  const TemporaryFolder folder;
  Image image = testImage();
  for (auto& [name, pixels] : image.channels) {
    std::fill(pixels.begin(), pixels.end(), 0.25f);
  }
  writeExr(folder / "a.exr", image);
  const std::string text = outputOf("oiiotool --info -v --stats " + (folder / "a.exr").string());
  EXPECT_FALSE(text.starts_with("failed")) << text;
  EXPECT_NE(text.find("23 x   17"), std::string::npos) << text;
  EXPECT_NE(text.find("Stats Avg: 0.250000 0.250000 0.250000 0.250000"), std::string::npos) << text;
}

TEST(Exr, EveryTruncationIsAnError) {
  const TemporaryFolder folder;
  writeExr(folder / "a.exr", testImage());
  const std::string bytes = bytesOf(folder / "a.exr");
  for (std::size_t length = 0; length < bytes.size(); length += length < 1200 ? 13 : 97) {
    writeBytes(folder / "cut.exr", bytes.substr(0, length));
    const std::string message = errorOf([&] { readExr(folder / "cut.exr"); });
    EXPECT_TRUE(message.starts_with((folder / "cut.exr").string())) << message;
  }
  writeBytes(folder / "cut.exr", bytes.substr(0, bytes.size() - 1));
  EXPECT_THROW(readExr(folder / "cut.exr"), Error);
}

TEST(Exr, DamagedBytesGiveAnErrorOrAnImageOfTheRightShape) {
  const TemporaryFolder folder;
  writeExr(folder / "a.exr", testImage());
  const std::string bytes = bytesOf(folder / "a.exr");
  std::mt19937 generator(9);
  int errors = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string damaged = bytes;
    // The header, where sizes and types are, gets half of the hits.
    const std::size_t range = trial % 2 == 0 ? 900 : bytes.size();
    for (int hit = 0; hit < 3; ++hit) {
      damaged[generator() % range] = char(generator());
    }
    writeBytes(folder / "damaged.exr", damaged);
    try {
      const Image image = readExr(folder / "damaged.exr");
      for (const auto& [name, pixels] : image.channels) {
        EXPECT_EQ(pixels.size(), image.window.pixelCount());
      }
    } catch (const Error&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, kTrials / 4);
}

TEST(Exr, OtherFilesAreNamedInTheError) {
  const TemporaryFolder folder;
  writeBytes(folder / "a.exr", "This is a text.");
  EXPECT_NE(errorOf([&] { readExr(folder / "a.exr"); }).find("not an OpenEXR file"), std::string::npos);
  EXPECT_NE(errorOf([&] { readExr(folder / "none.exr"); }).find("no such file"), std::string::npos);
  EXPECT_NE(errorOf([&] { readExr(folder / ""); }).find("is a folder"), std::string::npos);
}

TEST(Exr, UnwritableOutputsLeaveNothingBehind) {
  const TemporaryFolder folder;
  EXPECT_THROW(writeExr(folder / "none/a.exr", testImage()), Error);
  std::filesystem::create_directory(folder / "a.exr");
  EXPECT_THROW(writeExr(folder / "a.exr", testImage()), Error);
  std::filesystem::remove(folder / "a.exr");
  Image invalid = testImage();
  invalid.displaySize = {0, 0};  // OpenEXR refuses it after the temporary was opened
  EXPECT_THROW(writeExr(folder / "a.exr", invalid), Error);
  EXPECT_TRUE(folder.empty());
}

TEST(Exr, AFailedWriteKeepsTheOldFile) {
  const TemporaryFolder folder;
  writeExr(folder / "a.exr", testImage());
  const std::string before = bytesOf(folder / "a.exr");
  Image invalid = testImage();
  invalid.displaySize = {0, 0};
  EXPECT_THROW(writeExr(folder / "a.exr", invalid), Error);
  {
    const FullDisk disk;
    EXPECT_THROW(writeExr(folder / "a.exr", testImage()), Error);
  }
  EXPECT_EQ(bytesOf(folder / "a.exr"), before);
}

TEST(Exr, ColourChannelsNameWhatThereIs) {
  Image image = testImage();
  image.channels.erase("G");
  const std::string message = errorOf([&] { colourChannels(image, "a.exr"); });
  EXPECT_NE(message.find("stderr.R"), std::string::npos) << message;
  image.channels["Y"] = image.channels["R"];
  EXPECT_EQ(colourChannels(image, "a.exr")[1], &image.channels["Y"]);
}

} // namespace
} // namespace tyndall::film

// SPDX-License-Identifier: Apache-2.0
// Files as other programs write them, made here with OpenEXR alone.
#include "film/exr.h"

#include "film_fixture.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfTiledRgbaFile.h>

namespace tyndall::film {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 24;

std::vector<Imf::Rgba> ramp() {
  std::vector<Imf::Rgba> pixels(kWidth * kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    pixels[i] = Imf::Rgba(float(i % kWidth) / 64.0f, float(i / kWidth) / 64.0f, 0.5f, 1.0f);
  }
  return pixels;
}

void expectRamp(const Image& image) {
  ASSERT_EQ(image.window.pixelCount(), std::size_t(kWidth * kHeight));
  EXPECT_EQ(image.channels.at("R")[3 * kWidth + 5], 5.0f / 64.0f);
  EXPECT_EQ(image.channels.at("G")[3 * kWidth + 5], 3.0f / 64.0f);
  EXPECT_EQ(image.channels.at("B")[kWidth * kHeight - 1], 0.5f);
}

void writeRgba(const std::filesystem::path& path, Imf::RgbaChannels channels) {
  const std::vector<Imf::Rgba> pixels = ramp();
  Imf::RgbaOutputFile file(path.c_str(), Imf::Header(kWidth, kHeight), channels);
  file.setFrameBuffer(pixels.data(), 1, kWidth);
  file.writePixels(kHeight);
}

/// One float channel R over `data` in a picture of `display`, each pixel 100 y + x in the file's own coordinates.
void writeWindowed(const std::filesystem::path& path, const Imath::Box2i& display, const Imath::Box2i& data) {
  std::vector<float> pixels;
  for (int y = data.min.y; y <= data.max.y; ++y) {
    for (int x = data.min.x; x <= data.max.x; ++x) {
      pixels.push_back(100.0f * float(y) + float(x));
    }
  }
  Imf::Header header(display, data);
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  Imf::FrameBuffer frame;
  frame.insert("R", Imf::Slice::Make(Imf::FLOAT, pixels.data(), data));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(data.max.y - data.min.y + 1);
}

TEST(ForeignExr, HalfScanlines) {
  const TemporaryFolder folder;
  writeRgba(folder / "a.exr", Imf::WRITE_RGBA);
  expectRamp(readExr(folder / "a.exr"));
}

TEST(ForeignExr, TilesWithMipMaps) {
  const TemporaryFolder folder;
  {
    const std::vector<Imf::Rgba> pixels = ramp();
    Imf::TiledRgbaOutputFile file((folder / "a.exr").c_str(), Imf::Header(kWidth, kHeight), Imf::WRITE_RGBA, 16, 16,
                                  Imf::MIPMAP_LEVELS);
    file.setFrameBuffer(pixels.data(), 1, kWidth);
    for (int level = 0; level < file.numLevels(); ++level) {
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
  }
  expectRamp(readExr(folder / "a.exr"));
}

TEST(ForeignExr, LuminanceServesAsColour) {
  const TemporaryFolder folder;
  writeRgba(folder / "a.exr", Imf::WRITE_Y);
  const Image image = readExr(folder / "a.exr");
  EXPECT_EQ(colourChannels(image, "a.exr")[0], &image.channels.at("Y"));
}

TEST(ForeignExr, SubsampledChromaIsAClearError) {
  const TemporaryFolder folder;
  writeRgba(folder / "a.exr", Imf::WRITE_YC);
  const std::string message = errorOf([&] { readExr(folder / "a.exr"); });
  EXPECT_NE(message.find("subsampled 2x2"), std::string::npos) << message;
}

TEST(ForeignExr, WindowsAreRelativeToTheDisplayAndOverscanIsCut) {
  const TemporaryFolder folder;
  writeWindowed(folder / "a.exr", {{10, 20}, {19, 29}}, {{7, 25}, {15, 33}});
  const Image image = readExr(folder / "a.exr");
  EXPECT_EQ(image.displaySize, glm::uvec2(10, 10));
  EXPECT_EQ(image.window.min, glm::uvec2(0, 5));
  EXPECT_EQ(image.window.max, glm::uvec2(6, 10));
  EXPECT_EQ(image.channels.at("R").front(), 2510.0f);
  EXPECT_EQ(image.channels.at("R").back(), 2915.0f);
  EXPECT_EQ(image.channels.at("R").size(), 30u);
}

TEST(ForeignExr, NothingInsideTheDisplayIsAnError) {
  const TemporaryFolder folder;
  writeWindowed(folder / "a.exr", {{0, 0}, {9, 9}}, {{20, 20}, {25, 25}});
  EXPECT_NE(errorOf([&] { readExr(folder / "a.exr"); }).find("outside the display window"), std::string::npos);
}

TEST(ForeignExr, FirstPartOfAMultiPartFile) {
  const TemporaryFolder folder;
  {
    std::vector<Imf::Header> headers;
    for (const char* name : {"left", "right"}) {
      Imf::Header header(4, 4);
      header.setName(name);
      header.setType(Imf::SCANLINEIMAGE);
      header.channels().insert("R", Imf::Channel(Imf::FLOAT));
      headers.push_back(header);
    }
    Imf::MultiPartOutputFile file((folder / "a.exr").c_str(), headers.data(), 2);
    for (int part = 0; part < 2; ++part) {
      const std::vector<float> pixels(16, float(part + 1));
      Imf::FrameBuffer frame;
      frame.insert("R", Imf::Slice::Make(Imf::FLOAT, pixels.data(), headers[0].dataWindow()));
      Imf::OutputPart output(file, part);
      output.setFrameBuffer(frame);
      output.writePixels(4);
    }
  }
  EXPECT_EQ(readExr(folder / "a.exr").channels.at("R")[7], 1.0f);
}

} // namespace
} // namespace tyndall::film

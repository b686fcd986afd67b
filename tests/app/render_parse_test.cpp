// SPDX-License-Identifier: Apache-2.0
#include "app/render_parse.h"
#include "app/render_progress.h"
#include "app/render_request.h"
#include "base/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace tyndall::app {
namespace {

TEST(RenderParse, TimesHaveUnits) {
  EXPECT_EQ(parseSeconds("--time", "60"), 60.0);
  EXPECT_EQ(parseSeconds("--time", "1.5s"), 1.5);
  EXPECT_EQ(parseSeconds("--time", "2m"), 120.0);
  EXPECT_EQ(parseSeconds("--time", "1h"), 3600.0);
  for (const char* bad : {"", "0", "-1", "1d", "s", "1 s", "nan", "inf", "1e999", "2m3"}) {
    EXPECT_THROW(parseSeconds("--time", bad), Error) << bad;
  }
}

TEST(RenderParse, ErrorsAreSharesBelowOne) {
  EXPECT_EQ(parseShare("--error", "1%"), 0.01);
  EXPECT_EQ(parseShare("--error", "0.01"), 0.01);
  for (const char* bad : {"0", "100%", "1", "-1%", "%", "5 %x"}) {
    EXPECT_THROW(parseShare("--error", bad), Error) << bad;
  }
}

TEST(RenderParse, MemoryHasDecimalAndBinaryUnits) {
  EXPECT_EQ(parseBytes("--memory", "2G"), 2e9);
  EXPECT_EQ(parseBytes("--memory", "1KiB"), 1024.0);
  EXPECT_EQ(parseBytes("--memory", "512"), 512.0);
  for (const char* bad : {"0", "-2G", "2X", "G"}) {
    EXPECT_THROW(parseBytes("--memory", bad), Error) << bad;
  }
}

TEST(RenderParse, SizesAndWindows) {
  EXPECT_EQ(parseSize("--size", "640x480"), glm::uvec2(640, 480));
  EXPECT_EQ(parseWindow("--crop", "1,2,3,5"), (film::Window{{1, 2}, {3, 5}}));
  for (const char* bad : {"640", "0x4", "4x0", "4x65537", "4x4x4", "axb", "-4x4", "4 x4"}) {
    EXPECT_THROW(parseSize("--size", bad), Error) << bad;
  }
  for (const char* bad : {"1,2,3", "3,0,3,1", "0,0,1,-1", "1,2,3,4,5", ",,,"}) {
    EXPECT_THROW(parseWindow("--crop", bad), Error) << bad;
  }
}

TEST(RenderParse, MessagesNameTheOptionAndTheForm) {
  try {
    parseWhole("--spp", "many", {1, 100});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "--spp many: give a whole number from 1 to 100");
  }
}

TEST(RenderProgress, SaysWhatIsKnownAndNothingElse) {
  render::Progress progress;
  progress.fraction = 0.5;
  progress.samplesPerPixel = 32;
  progress.seconds = 60;
  progress.error = std::numeric_limits<double>::infinity();
  EXPECT_EQ(formatProgress(progress, 4), "[##..]  50 %  32 samples per pixel  1:00 left");
  progress.error = 0.0123;
  progress.nonFinite = 2;
  EXPECT_EQ(formatProgress(progress, 0), " 50 %  32 samples per pixel  1:00 left  error 1.2 %  2 NOT FINITE");
  EXPECT_EQ(formatDuration(3725.0), "1:02:05");
}

TEST(RenderOutput, FramesAreNumbered) {
  RenderRequest request;
  request.output = "out/smoke.exr";
  EXPECT_EQ(outputFiles(request, std::nullopt).png, "out/smoke.png");
  EXPECT_EQ(outputFiles(request, 7).exr, "out/smoke_0007.exr");
  request.output = "out/smoke.##.exr";
  EXPECT_EQ(outputFiles(request, 7).checkpoint, "out/smoke.07.exr.checkpoint");
}

} // namespace
} // namespace tyndall::app

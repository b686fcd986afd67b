// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "support/fixtures.h"
#include "volume/sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

namespace tyndall::volume {
namespace {

using testing::HasSubstr;

std::string messageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& problem) {
    return problem.what();
  }
  return "no error";
}

TEST(Sequence, PatternsGiveFileNames) {
  EXPECT_EQ(frameFile("a/smoke_%06d.vdb", 7), "a/smoke_000007.vdb");
  EXPECT_EQ(frameFile("smoke_####.vdb", 12), "smoke_0012.vdb");
  EXPECT_EQ(frameFile("smoke_#.vdb", 1234), "smoke_1234.vdb");
  EXPECT_EQ(frameFile("%d.vdb", 3), "3.vdb");
  EXPECT_EQ(frameFile("100%%_%02d.vdb", 3), "100%_03.vdb");
}

TEST(Sequence, OnlyPlaceholdersMakeASequence) {
  EXPECT_TRUE(isSequence("x_%04d.vdb"));
  EXPECT_TRUE(isSequence("x_#.vdb"));
  EXPECT_FALSE(isSequence("x_0001.vdb"));
  EXPECT_FALSE(isSequence("100%.vdb"));
}

TEST(Sequence, BadPatternsSayWhatToWrite) {
  for (const char* pattern : {"smoke.vdb", "a_%d_%d.vdb", "#_#.vdb", "a_%s.vdb", "a_%4d.vdb", "a%"}) {
    EXPECT_THAT(messageOf([&] { frameFile(pattern, 1); }), HasSubstr("smoke_####.vdb")) << pattern;
  }
}

TEST(Sequence, FrameRanges) {
  EXPECT_EQ(parseFrames("1-3").count(), 3);
  EXPECT_EQ(parseFrames("7").first, 7);
  EXPECT_EQ(parseFrames("7").last, 7);
  for (const char* text : {"", "a", "1-", "-", "1-2-3", "1,2", "99999999999", "1-99999999"}) {
    EXPECT_NE(messageOf([&] { parseFrames(text); }), "no error") << text;
  }
  EXPECT_THAT(messageOf([] { parseFrames("5-2"); }), HasSubstr("2-5"));
}

TEST(Sequence, MissingFramesAreNamed) {
  const test::TemporaryFolder folder;
  for (const char* name : {"s_01.vdb", "s_02.vdb", "s_04.vdb"}) {
    std::ofstream(folder / name) << "x";
  }
  const std::string pattern = (folder / "s_##.vdb").string();
  EXPECT_EQ(expandSequence(pattern, {1, 2}).size(), 2u);
  EXPECT_EQ(expandSequence(pattern, {1, 2})[1], folder / "s_02.vdb");
  const std::string message = messageOf([&] { expandSequence(pattern, {1, 5}); });
  EXPECT_THAT(message, HasSubstr("2 of 5 frames"));
  EXPECT_THAT(message, HasSubstr("3 and 5"));
}

} // namespace
} // namespace tyndall::volume

// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "support/fixtures.h"
#include "volume/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tyndall::volume {
namespace {

using testing::HasSubstr;

/// The error's text, or "" if the file was taken. Anything but an Error fails the test by escaping.
std::string refusal(const std::filesystem::path& path) {
  try {
    inspectFile(path);
    loadGrid(path, {});
  } catch (const Error& problem) {
    return problem.what();
  }
  return "";
}

TEST(Malformed, EveryFileIsRefusedOrReadButNeverCrashes) {
  const test::TemporaryFolder folder;
  for (const std::string& name : test::writeMalformed(folder.path())) {
    const std::string message = refusal(folder / name);
    if (!name.starts_with("garbled")) { // noise may hit nothing but values
      EXPECT_NE(message, "") << name;
    }
    if (!message.empty()) {
      EXPECT_THAT(message, HasSubstr(name));
    }
  }
}

TEST(Malformed, MessagesSayWhatTheFileIs) {
  const test::TemporaryFolder folder;
  test::writeMalformed(folder.path());
  EXPECT_THAT(refusal(folder / "text.vdb"), HasSubstr("not a VDB file: it starts with \"this is not a v"));
  EXPECT_THAT(refusal(folder / "zero_bytes.vdb"), HasSubstr("empty (0 bytes)"));
  EXPECT_THAT(refusal(folder / "nano.vdb"), HasSubstr("nanovdb_convert"));
  EXPECT_THAT(refusal(folder / "cut_tenth_5.vdb"), HasSubstr("damaged or incomplete"));
  EXPECT_THAT(refusal(folder / "none.vdb"), HasSubstr("No such file"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("is a folder"));
}

} // namespace
} // namespace tyndall::volume

// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"

#include <gtest/gtest.h>

#include <fstream>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
  std::size_t entries() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }

  const fs::path folder_ =
      fs::temp_directory_path() / fmt::format("tyndall-file-test-{}", testing::UnitTest::GetInstance()->random_seed());
};

TEST_F(FileTest, AtomicWriteReplacesWholeFiles) {
  const fs::path path = folder_ / "a.txt";
  write(path, "old");
  writeFileAtomically(path, [](const fs::path& temporary) { write(temporary, "new"); });
  EXPECT_EQ(readTextFile(path), "new");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(FileTest, FailedWriteLeavesTheOldFileAndNothingElse) {
  const fs::path path = folder_ / "a.txt";
  write(path, "old");
  EXPECT_THROW(writeFileAtomically(path,
                                   [](const fs::path& temporary) {
                                     write(temporary, "half");
                                     fail("disk full");
                                   }),
               Error);
  EXPECT_EQ(readTextFile(path), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(FileTest, UnwritablePlacesAreNamed) {
  EXPECT_THROW(checkWritable(folder_ / "missing" / "a.exr"), Error);
  EXPECT_THROW(checkWritable(folder_), Error);
  write(folder_ / "plain", "");
  EXPECT_THROW(checkWritable(folder_ / "plain" / "a.exr"), Error);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(FileTest, ReadingNamesWhatIsWrong) {
  EXPECT_THROW(readTextFile(folder_ / "none"), Error);
  EXPECT_THROW(readTextFile(folder_), Error);
}

TEST_F(FileTest, HashIsFnv1a) {
  EXPECT_EQ(hashText(""), 0xcbf29ce484222325ull);
  EXPECT_EQ(hashText("a"), 0xaf63dc4c8601ec8cull); // published test vector
  write(folder_ / "a", "a");
  EXPECT_EQ(hashFile(folder_ / "a"), hashText("a"));
}

} // namespace
} // namespace tyndall

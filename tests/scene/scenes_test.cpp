// SPDX-License-Identifier: Apache-2.0
// The scenes that come with the program.
#include "base/file.h"
#include "scene/support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tyndall::scene {
namespace {

TEST(Scenes, AllLoadWithoutProblemsAndAreInTheTable) {
  const std::string table = readTextFile("scenes/README.md");
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator("scenes")) {
    if (entry.path().extension() != ".json" || entry.path().stem().extension() == ".suite") {
      continue; // suites of `tyndall bench` have tests of their own
    }
    const LoadResult result = readScene(entry.path());
    EXPECT_TRUE(result.problems.empty()) << test::listed(result);
    EXPECT_EQ(result.scene.name, entry.path().stem().string());
    const std::string inTable = std::filesystem::relative(entry.path(), "scenes").generic_string();
    EXPECT_THAT(table, testing::HasSubstr("`" + inTable + "`"));
    const LoadResult again = parseScene(result.canonical, entry.path().string(), entry.path().parent_path());
    EXPECT_EQ(again.canonical, result.canonical) << test::listed(again);
    ++count;
  }
  EXPECT_GE(count, 21); // the folders within are looked through
}

} // namespace
} // namespace tyndall::scene

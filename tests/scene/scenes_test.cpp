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
  for (const auto& entry : std::filesystem::directory_iterator("scenes")) {
    if (entry.path().extension() != ".json") {
      continue;
    }
    const LoadResult result = readScene(entry.path());
    EXPECT_TRUE(result.problems.empty()) << test::listed(result);
    EXPECT_EQ(result.scene.name, entry.path().stem().string());
    EXPECT_THAT(table, testing::HasSubstr("`" + entry.path().filename().string() + "`"));
    const LoadResult again = parseScene(result.canonical, entry.path().string(), "scenes");
    EXPECT_EQ(again.canonical, result.canonical) << test::listed(again);
    ++count;
  }
  EXPECT_GE(count, 6);
}

} // namespace
} // namespace tyndall::scene

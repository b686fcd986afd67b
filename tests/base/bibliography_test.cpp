// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> keys;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    keys.insert((*match)[1]);
  }
  return keys;
}

/// Runs in the repository's root (tests' working folder).
TEST(Bibliography, HoldsEveryKeyThatTheCodeCites) {
  const std::set<std::string> known =
      matches(readTextFile("docs/bibliography.md"), std::regex(R"(\| ([A-Z][A-Za-z]+\d{2}) \|)"));
  ASSERT_FALSE(known.empty());
  std::size_t cited = 0;
  for (const char* root : {"shaders", "src"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file()) {
        continue;
      }
      for (const std::string& key : matches(readTextFile(entry.path()), std::regex(R"(\[([A-Z][a-z]+\d{2})[\],; ])"))) {
        EXPECT_TRUE(known.contains(key)) << entry.path() << " cites " << key;
        ++cited;
      }
    }
  }
  EXPECT_GT(cited, 5u);
}

} // namespace
} // namespace tyndall

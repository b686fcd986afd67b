// SPDX-License-Identifier: Apache-2.0
// Suites: what they say, and what is said of bad ones.
#include "base/error.h"
#include "bench/suite.h"
#include "scene/load.h"

#include <gtest/gtest.h>

#include <fstream>

namespace tyndall::bench {
namespace {

namespace fs = std::filesystem;

/// A suite file beside a scene.
class SuiteFile : public testing::Test {
protected:
  SuiteFile() {
    std::string name = (fs::temp_directory_path() / "tyndall-suite-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(folder_ / "a.json") << "{}";
  }
  ~SuiteFile() override { fs::remove_all(folder_); }

  Suite load(const std::string& text) const {
    std::ofstream(folder_ / "mine.suite.json") << text;
    return loadSuite(folder_ / "mine.suite.json");
  }
  std::string complaint(const std::string& text) const {
    try {
      load(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "no complaint";
  }

  fs::path folder_;
};

constexpr const char* kScene =
    R"({"name": "a", "title": "t", "file": "a.json", "size": [8, 4], "samples": [1, 4], "contenders": ["x"]})";

TEST_F(SuiteFile, IsReadWhole) {
  const Suite suite =
      load(std::string(R"({"title": "T", "contenders": {"x": ["--depth", "1"]}, "scenes": [)") + kScene + "]}");
  EXPECT_EQ(suite.name, "mine");
  EXPECT_EQ(suite.contenders.at("x"), (std::vector<std::string>{"--depth", "1"}));
  ASSERT_EQ(suite.scenes.size(), 1u);
  EXPECT_EQ(suite.scenes[0].size, glm::uvec2(8, 4));
  EXPECT_EQ(suite.scenes[0].samples, (std::vector<std::uint32_t>{1, 4}));
  EXPECT_EQ(suite.scenes[0].file, folder_ / "a.json");
}

TEST_F(SuiteFile, ComplaintsSayWhereAndWhat) {
  const std::pair<const char*, const char*> cases[] = {
      {"{\n \"titel\": \"T\", \"scenes\": []}", ":2:2: \"titel\" is not known"},
      {R"({"title": "T", "scenes": []})", "there is no scene"},
      {R"({"title": "T", "scenes": [{"name": "a", "title": "t", "size": [1, 1], "samples": [1]}]})",
       "\"file\" is missing"},
      {R"({"title": "T", "scenes": [{"name": "a", "title": "t", "file": "b.json", "size": [1, 1], "samples": [1]}]})",
       "is not there"},
      {R"({"title": "T", "scenes": [{"name": "a", "title": "t", "file": "a.json", "size": [1], "samples": [1]}]})",
       "[width, height]"},
      {R"({"title": "T", "scenes": [{"name": "a", "title": "t", "file": "a.json", "size": [1, 1], "samples": [4, 4]}]})",
       "must rise"},
      {R"({"title": "T", "scenes": [{"name": "a", "title": "t", "file": "a.json", "size": [1, 0.5], "samples": [4]}]})",
       "whole number"},
      {R"({"title": "T", "scenes": [{"name": "a", "title": "t", "file": "a.json", "size": [1, 1], "samples": []}]})",
       "the list is empty"},
      {R"({"title": "T", "contenders": {"y": []}, "scenes": [{"name": "a", "title": "t", "file": "a.json", "size": [1, 1], "samples": [1], "contenders": ["x"]}]})",
       "no contender is called \"x\"; there are y"},
      {R"({"title": "T" "scenes": []})", "mine.suite.json:1:"}};
  for (const auto& [text, expected] : cases) {
    EXPECT_NE(complaint(text).find(expected), std::string::npos) << complaint(text);
  }
}

TEST(Suites, ThoseThatComeWithTheProgramAreSound) {
  for (const char* name : {"quick", "standard"}) {
    const Suite suite = loadSuite(findSuite(name));
    EXPECT_EQ(suite.name, name);
    for (const SuiteScene& scene : suite.scenes) {
      EXPECT_TRUE(scene::readScene(scene.file).ok()) << scene.file;
    }
  }
  EXPECT_GE(loadSuite(findSuite("standard")).scenes.size(), 12u);
}

TEST(Suites, AnUnknownNameIsToldTheNearest) {
  try {
    findSuite("standrad");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"standard\""), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace tyndall::bench

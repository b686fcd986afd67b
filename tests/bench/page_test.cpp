// SPDX-License-Identifier: Apache-2.0
// The page stands alone and says what was measured.
#include "bench/page.h"
#include "bench/page_pictures.h"

#include <gtest/gtest.h>

#include <regex>

namespace tyndall::bench {
namespace {

Report report() {
  Level level;
  level.label = "16";
  level.samples = 16;
  level.runs = 8;
  level.errors = {{1e-2, 0.1}, {0.1, 0.05}};
  level.cpu = level.wall = {1.5, 0.02};
  ContenderResult ours{"tyndall", "ours & <best>", true, {}, {level}, {}, {}, {}, {}, {}};
  ours.targets.push_back({"relMSE", 1e-3, {Reach::Extrapolated, {12.0, 0.1}}, {Reach::Measured, {6.0, 0.1}}});
  ContenderResult refused{"peer", "Peer 1", false, "not exportable: glass", {}, {}, {}, {}, {}, {}};
  SceneResult scene{"a", "A.", {8, 8}, "path", "device", "scatter", {ours, refused}};
  return {"mine", "Mine", "tyndall bench", "now", {{"processor", "x"}}, 8, {scene}};
}

TEST(Page, AsksForNothingFromElsewhere) {
  const std::string html = htmlPage(report());
  const std::string rest = std::regex_replace(html, std::regex("xmlns=\"http://www.w3.org/2000/svg\""), "");
  EXPECT_EQ(rest.find("http"), std::string::npos);
  EXPECT_EQ(rest.find("<script"), std::string::npos);
  EXPECT_EQ(rest.find("<link"), std::string::npos);
}

TEST(Page, SaysWhatWasMeasuredAndWhatWasNot) {
  const std::string html = htmlPage(report());
  for (const char* part : {"~12.0", "not exportable: glass", "ours &amp; &lt;best&gt;", "<svg", "relMSE 0.001"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(html.find("<best>"), std::string::npos);
}

TEST(Page, TagsAreClosed) {
  const std::string html = htmlPage(report());
  for (const char* tag : {"table", "tr", "td", "th", "h1", "h2", "h3", "p", "svg", "figure", "html", "body", "style"}) {
    const std::regex open(std::string("<") + tag + "[ >]");
    const std::regex close(std::string("</") + tag + ">");
    EXPECT_EQ(std::distance(std::sregex_iterator(html.begin(), html.end(), open), {}),
              std::distance(std::sregex_iterator(html.begin(), html.end(), close), {}))
        << tag;
  }
}

TEST(Page, RatiosOfBoundsAreBounds) {
  const Crossing measured{Reach::Measured, {10.0, 0.0}};
  const Crossing better{Reach::Better, {2.0, 0.0}};
  const Crossing never{};
  EXPECT_EQ(ratioText(measured, better, 8).substr(0, 2), "> ");
  EXPECT_EQ(ratioText(better, measured, 8).substr(0, 2), "< ");
  EXPECT_EQ(ratioText(better, better, 8), "");
  EXPECT_EQ(ratioText(never, measured, 8), "");
  EXPECT_EQ(crossingText(never), "never");
}

/// RFC 4648, section 10.
TEST(Base64, OfTheStandardsOwnExamples) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(base64(bytes), text);
  }
  EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

} // namespace
} // namespace tyndall::bench

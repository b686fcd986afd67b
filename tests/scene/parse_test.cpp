// SPDX-License-Identifier: Apache-2.0
// The text reader: what it tolerates and the positions it keeps.
#include "scene/json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tyndall::scene::json {
namespace {

std::pair<int, int> place(const Position& position) { return {position.line, position.column}; }

TEST(SceneText, KeepsThePositionOfKeysAndValues) {
  const Parsed parsed = parse("{\n  \"a\": [1,\r\n    {\"b\": null}],\n  \"\xc3\xa9\xe2\x82\xac\": true}");
  ASSERT_TRUE(parsed.complete && parsed.mistakes.empty());
  EXPECT_EQ(place(parsed.root.position), std::pair(1, 1));
  const Member& a = *parsed.root.member("a");
  EXPECT_EQ(place(a.position), std::pair(2, 3));
  EXPECT_EQ(place(a.value.position), std::pair(2, 8));
  EXPECT_EQ(place(a.value.items[1].position), std::pair(3, 5));
  EXPECT_EQ(place(a.value.items[1].member("b")->value.position), std::pair(3, 11));
  // Two characters of two and three bytes: columns count characters.
  EXPECT_EQ(place(parsed.root.members[1].value.position), std::pair(4, 9));
}

TEST(SceneText, ToleratesCommentsTrailingCommasAndByteOrderMark) {
  const Parsed parsed = parse("\xef\xbb\xbf// one\r\n{ /* two\n * // */ \"a\": [1, 2,], // \xff anything\n}/**/ ");
  ASSERT_TRUE(parsed.complete && parsed.mistakes.empty());
  EXPECT_EQ(place(parsed.root.position), std::pair(2, 1));
  EXPECT_EQ(parsed.root.find("a")->items.size(), 2u);
}

TEST(SceneText, ByteOrderMarkShowsNoColumn) {
  EXPECT_EQ(place(parse("\xef\xbb\xbf[x]").mistakes.front().position), std::pair(1, 2));
}

TEST(SceneText, AgreesWithAnotherParser) {
  const std::string text =
      R"({"s": "\u00e9\ud83d\ude00\"\\\/\b\f\n\r\t \u0000 end", "n": [0, -0.0, 1e-3, 123456789.125, -2E+5,
    4.9406564584124654e-310, 1.7976931348623157e308], "b": [true, false, null], "o": {"": {}}, "e": []})";
  const nlohmann::json expected = nlohmann::json::parse(text);
  const Parsed parsed = parse(text);
  ASSERT_TRUE(parsed.complete);
  ASSERT_TRUE(parsed.mistakes.empty()) << parsed.mistakes.front().message;
  EXPECT_EQ(parsed.root.find("s")->text, expected["s"].get<std::string>());
  for (std::size_t i = 0; i < expected["n"].size(); ++i) {
    EXPECT_EQ(parsed.root.find("n")->items[i].number, expected["n"][i].get<double>());
  }
  EXPECT_TRUE(parsed.root.find("b")->items[0].boolean);
  EXPECT_FALSE(parsed.root.find("b")->items[1].boolean);
  EXPECT_EQ(parsed.root.find("b")->items[2].kind, Kind::Null);
  EXPECT_EQ(parsed.root.find("o")->find("")->kind, Kind::Object);
  EXPECT_TRUE(parsed.root.find("e")->items.empty());
}

TEST(SceneText, QuotedTextReadsBack) {
  std::string text;
  for (char c = 1; c < 127; ++c) {
    text += c;
  }
  text += "\xc3\xa9";
  EXPECT_EQ(nlohmann::json::parse(inQuotes(text)).get<std::string>(), text);
  EXPECT_EQ(parse(inQuotes(text)).root.text, text);
}

TEST(SceneText, GoesOnAfterSlips) {
  const Parsed parsed = parse("{a: 'b' \"c\": .5, \"c\": NaN}");
  EXPECT_TRUE(parsed.complete);
  std::vector<int> columns;
  for (const Mistake& mistake : parsed.mistakes) {
    columns.push_back(mistake.position.column);
  }
  EXPECT_EQ(columns, (std::vector<int>{2, 5, 9, 14, 23, 18}));
  EXPECT_EQ(parsed.root.find("a")->text, "b");
}

TEST(SceneText, BombsAreRefused) {
  const std::string deep(1000000, '[');
  EXPECT_FALSE(parse(deep).complete);
  EXPECT_EQ(parse(deep).mistakes.size(), 1u);
  std::string wide = "{";
  for (int i = 0; i < 2000; ++i) {
    wide += "\"k" + std::to_string(i) + "\": 1,";
  }
  EXPECT_FALSE(parse(wide + "}").complete);
  std::string slips = "[";
  for (int i = 0; i < 2000; ++i) {
    slips += "x,";
  }
  EXPECT_LE(parse(slips + "]").mistakes.size(), 101u);
}

} // namespace
} // namespace tyndall::scene::json

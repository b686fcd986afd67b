// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

/// Texts in which @ marks where a problem must be reported; it is taken out before parsing.
namespace tyndall::scene::test {

struct Malformed {
  const char* text;
  const char* message; ///< must be part of the message
  bool warning = false;
};

/// The text without its mark, and where the mark was, counted in characters.
struct Marked {
  std::string text;
  int line = 1;
  int column = 1;
};

inline Marked unmark(std::string text) {
  Marked marked;
  const std::size_t at = text.find('@');
  for (std::size_t i = 0; i < at; ++i) {
    const bool newLine = text[i] == '\n';
    marked.line += newLine ? 1 : 0;
    marked.column = newLine ? 1 : marked.column + ((text[i] & 0xc0) == 0x80 ? 0 : 1);
  }
  marked.text = text.erase(at, 1);
  return marked;
}

inline void expectOne(const std::string& markedText, const std::string& message, bool warning) {
  ASSERT_EQ(std::count(markedText.begin(), markedText.end(), '@'), 1) << markedText;
  const Marked marked = unmark(markedText);
  const LoadResult result = parse(marked.text);
  ASSERT_EQ(result.problems.size(), 1u) << marked.text << '\n' << listed(result);
  const Problem& problem = result.problems.front();
  EXPECT_EQ(problem.location.file, "test.json");
  EXPECT_EQ(problem.location.line, marked.line) << marked.text << '\n' << problem.message;
  EXPECT_EQ(problem.location.column, marked.column) << marked.text << '\n' << problem.message;
  EXPECT_THAT(problem.message, testing::HasSubstr(message)) << marked.text;
  EXPECT_EQ(problem.warning, warning);
  EXPECT_EQ(result.ok(), warning);
  EXPECT_EQ(result.canonical.empty(), !warning);
}

} // namespace tyndall::scene::test

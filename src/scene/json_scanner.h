// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/json_cursor.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::scene::json {

bool isWordStart(char c);
bool isNumberStart(char c);

/// The tokens of the text, from left to right. Mistakes that can be stepped over are kept; others end the reading.
class Scanner {
public:
  /// Thrown by stop(), caught by parse().
  struct Stop {};

  Scanner(std::string_view text, int override);

  const Cursor& cursor() const { return cursor_; }
  const Position& position() const { return cursor_.position(); }
  bool atEnd() const { return cursor_.atEnd(); }
  char peek() const { return cursor_.peek(); }
  void advance() { cursor_.advance(); }

  /// A mistake after which reading goes on.
  void slip(const Position& position, std::string message);
  /// A mistake at the cursor that ends the reading. @throws Stop
  [[noreturn]] void stop(std::string message);
  /// What stands at the cursor, in words.
  std::string here() const;

  /// Steps over white space and comments.
  void skipBlank();
  std::string string();
  std::string key();
  /// Fill kind and content; a malformed token gives Kind::Invalid and a mistake.
  void number(Value& result);
  void word(Value& result);

  std::vector<Mistake> takeMistakes() { return std::move(mistakes_); }

private:
  void blockComment();
  std::string_view token(bool (*belongs)(char));
  void escape(std::string& text);
  void unicodeEscape(std::string& text, const Position& position);
  std::optional<unsigned> hexCode();

  Cursor cursor_;
  std::vector<Mistake> mistakes_;
};

} // namespace tyndall::scene::json

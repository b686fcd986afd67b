// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/json.h"

#include <cstddef>
#include <string_view>

namespace tyndall::scene::json {

/// Length in bytes of the well-formed UTF-8 character at `at`, 0 if there is none (Unicode 15, table 3-7:
/// no overlong forms, no surrogates, nothing above U+10FFFF).
std::size_t characterLength(std::string_view text, std::size_t at);

/// Walks UTF-8 text one character at a time and keeps the position that an editor would show.
class Cursor {
public:
  explicit Cursor(std::string_view text, int override) : text_(text) { position_ = {1, 1, override}; }

  bool atEnd() const { return at_ >= text_.size(); }
  /// The byte at the cursor, 0 at the end.
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool startsWith(std::string_view token) const { return text_.substr(at_).starts_with(token); }
  const Position& position() const { return position_; }
  std::size_t offset() const { return at_; }
  std::string_view since(std::size_t start) const { return text_.substr(start, at_ - start); }
  /// The whole character at the cursor.
  std::string_view character() const { return text_.substr(at_, characterLength(text_, at_)); }

  /// Steps over one character; a UTF-8 sequence counts as one column.
  void advance();
  void advance(std::size_t characters) {
    for (; characters > 0; --characters) {
      advance();
    }
  }
  /// Steps over bytes that show no column (the byte-order mark).
  void skipHidden(std::size_t bytes) { at_ += bytes; }

private:
  std::string_view text_;
  std::size_t at_ = 0;
  Position position_;
};

} // namespace tyndall::scene::json

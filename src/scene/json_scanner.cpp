// SPDX-License-Identifier: Apache-2.0
#include "scene/json_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tyndall::scene::json {
namespace {

/// More slips than this in one text mean that it is not a scene.
constexpr std::size_t kMaximumMistakes = 100;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isWord(char c) { return isWordStart(c) || isDigit(c) || c == '-' || c == '.'; }
bool isNumberPart(char c) { return isNumberStart(c) || isWordStart(c); }

/// RFC 8259, section 6.
bool isNumber(std::string_view token) {
  std::size_t at = 0;
  const auto at0 = [&] { return at < token.size() ? token[at] : '\0'; };
  const auto digits = [&] {
    const std::size_t start = at;
    for (; isDigit(at0()); ++at) {
    }
    return at > start;
  };
  at += at0() == '-' ? 1 : 0;
  const bool leadingZero = at0() == '0' && at + 1 < token.size() && isDigit(token[at + 1]);
  if (leadingZero || !digits()) {
    return false;
  }
  if (at0() == '.' && (++at, !digits())) {
    return false;
  }
  if (at0() == 'e' || at0() == 'E') {
    ++at;
    at += at0() == '-' || at0() == '+' ? 1 : 0;
    if (!digits()) {
      return false;
    }
  }
  return at == token.size();
}

void appendUtf8(std::string& text, unsigned code) {
  const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xc0 | (code >> 6));
    put(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    put(0xe0 | (code >> 12));
    put(0x80 | ((code >> 6) & 0x3f));
    put(0x80 | (code & 0x3f));
  } else {
    put(0xf0 | (code >> 18));
    put(0x80 | ((code >> 12) & 0x3f));
    put(0x80 | ((code >> 6) & 0x3f));
    put(0x80 | (code & 0x3f));
  }
}

} // namespace

bool isWordStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$'; }

bool isNumberStart(char c) { return isDigit(c) || c == '-' || c == '+' || c == '.'; }

Scanner::Scanner(std::string_view text, int override) : cursor_(text, override) {
  cursor_.skipHidden(cursor_.startsWith("\xef\xbb\xbf") ? 3 : 0);
}

void Scanner::slip(const Position& position, std::string message) {
  mistakes_.push_back({position, std::move(message)});
  if (mistakes_.size() >= kMaximumMistakes) {
    stop("too many mistakes; the rest of the file was not read");
  }
}

void Scanner::stop(std::string message) {
  mistakes_.push_back({cursor_.position(), std::move(message)});
  throw Stop{};
}

/// What stands at the cursor, in words.
std::string Scanner::here() const {
  if (cursor_.atEnd()) {
    return "the end of the file";
  }
  const auto byte = static_cast<unsigned char>(cursor_.peek());
  const std::string_view character = cursor_.character();
  if (character.empty()) {
    return fmt::format("the byte 0x{:02x}, which is not UTF-8 text,", byte);
  }
  return byte < 0x20 || byte == 0x7f ? fmt::format("the control character 0x{:02x}", byte)
                                     : fmt::format("'{}'", character);
}

void Scanner::skipBlank() {
  for (;;) {
    const char c = cursor_.peek();
    if (!cursor_.atEnd() && (c == ' ' || c == '\t' || c == '\n' || c == '\r')) {
      cursor_.advance();
    } else if (cursor_.startsWith("//")) {
      while (!cursor_.atEnd() && cursor_.peek() != '\n') {
        cursor_.advance();
      }
    } else if (cursor_.startsWith("/*")) {
      blockComment();
    } else {
      return;
    }
  }
}

void Scanner::blockComment() {
  const Position start = cursor_.position();
  cursor_.advance(2);
  while (!cursor_.startsWith("*/")) {
    if (cursor_.atEnd()) {
      stop(fmt::format("the comment that starts in line {} is not closed; add */", start.line));
    }
    cursor_.advance();
  }
  cursor_.advance(2);
}

std::string Scanner::key() {
  if (cursor_.peek() == '"' || cursor_.peek() == '\'') {
    return string();
  }
  if (!isWordStart(cursor_.peek())) {
    stop(fmt::format("a key in double quotes is needed, not {}", here()));
  }
  const Position position = cursor_.position();
  const std::string name{token(isWord)};
  slip(position, fmt::format("keys stand in double quotes: write \"{}\"", name));
  return name;
}

std::string_view Scanner::token(bool (*belongs)(char)) {
  const std::size_t start = cursor_.offset();
  while (belongs(cursor_.peek())) {
    cursor_.advance();
  }
  return cursor_.since(start);
}

void Scanner::word(Value& result) {
  const std::string name{token(isWord)};
  if (name == "true" || name == "false") {
    result.kind = Kind::Boolean;
    result.boolean = name == "true";
    return;
  }
  if (name == "null") {
    return;
  }
  result.kind = Kind::Invalid;
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (lower == "nan" || lower == "inf" || lower == "infinity") {
    slip(result.position, fmt::format("{} is not allowed; write a finite number", name));
  } else if (lower == "true" || lower == "false" || lower == "null" || lower == "none") {
    slip(result.position, fmt::format("write {} in place of {}", lower == "none" ? "null" : lower, name));
  } else {
    slip(result.position, fmt::format("text stands in double quotes: write \"{}\"", name));
  }
}

void Scanner::number(Value& result) {
  result.text = token(isNumberPart);
  result.kind = Kind::Number;
  if (!isNumber(result.text)) {
    result.kind = Kind::Invalid;
    slip(result.position,
         fmt::format("{} is not a number; write a finite decimal number such as 0.5, -2 or 1e-3", result.text));
    return;
  }
  const char* end = result.text.data() + result.text.size();
  const auto [last, error] = std::from_chars(result.text.data(), end, result.number);
  if (error != std::errc{} || last != end || !std::isfinite(result.number)) {
    result.kind = Kind::Invalid;
    slip(result.position, fmt::format("{} is too large or too small for a number; the limits are about 1e-307 "
                                      "and 1e308",
                                      result.text));
  }
}

std::string Scanner::string() {
  const char quote = cursor_.peek();
  const Position start = cursor_.position();
  if (quote == '\'') {
    slip(start, "write double quotes, not single quotes");
  }
  cursor_.advance();
  std::string text;
  while (cursor_.peek() != quote || cursor_.atEnd()) {
    const auto byte = static_cast<unsigned char>(cursor_.peek());
    if (cursor_.atEnd() || byte == '\n') {
      stop(fmt::format("the text that starts in line {}, column {} is not closed; add {}", start.line, start.column,
                       quote));
    }
    if (byte == '\\') {
      escape(text);
    } else if (byte < 0x20) {
      stop(fmt::format("{} may not stand in text; write \\u{:04x}", here(), byte));
    } else if (cursor_.character().empty()) {
      stop(fmt::format("{} is not valid; save the file as UTF-8", here()));
    } else {
      text += cursor_.character();
      cursor_.advance();
    }
  }
  cursor_.advance();
  return text;
}

void Scanner::escape(std::string& text) {
  constexpr std::string_view kLetters = "\"\\/bfnrt";
  constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
  const Position position = cursor_.position();
  cursor_.advance();
  const std::size_t which = cursor_.atEnd() ? kLetters.npos : kLetters.find(cursor_.peek());
  if (which != kLetters.npos) {
    text += kMeanings[which];
    cursor_.advance();
    return;
  }
  if (cursor_.peek() != 'u') {
    slip(position, fmt::format("\\ before {} means nothing; write \\\\ for a backslash, / in file names", here()));
    return;
  }
  cursor_.advance();
  unicodeEscape(text, position);
}

void Scanner::unicodeEscape(std::string& text, const Position& position) {
  const std::optional<unsigned> high = hexCode();
  if (high && (*high < 0xd800 || *high > 0xdfff)) {
    appendUtf8(text, *high);
    return;
  }
  if (high && *high < 0xdc00 && cursor_.startsWith("\\u")) {
    cursor_.advance(2);
    const std::optional<unsigned> low = hexCode();
    if (low && *low >= 0xdc00 && *low <= 0xdfff) {
      appendUtf8(text, 0x10000 + ((*high - 0xd800) << 10) + (*low - 0xdc00));
      return;
    }
  }
  slip(position, "\\u needs four hexadecimal digits that make a character; write the character itself");
}

std::optional<unsigned> Scanner::hexCode() {
  unsigned code = 0;
  for (int i = 0; i < 4; ++i) {
    const char c = cursor_.peek();
    const std::size_t digit =
        std::string_view("0123456789abcdef").find(isWordStart(c) ? static_cast<char>(c | 0x20) : c);
    if (digit == std::string_view::npos) {
      return std::nullopt;
    }
    code = code * 16 + static_cast<unsigned>(digit);
    cursor_.advance();
  }
  return code;
}

} // namespace tyndall::scene::json

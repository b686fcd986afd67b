// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// JSON with comments as a tree in which every key and value knows where it was written.
namespace tyndall::scene::json {

/// Lines and columns count from 1, columns in characters (UTF-8 code points). 0 = unknown.
struct Position {
  int line = 0;
  int column = 0;
  int override = -1; ///< >= 0: written on the command line, as the override of that number
  auto operator<=>(const Position&) const = default;
};

enum class Kind { Invalid, Null, Boolean, Number, String, Array, Object };

struct Member;

struct Value {
  Kind kind = Kind::Null; ///< Invalid: malformed and already reported
  bool boolean = false;
  double number = 0.0; ///< finite
  std::string text;    ///< a string's text, or a number as it was written
  std::vector<Value> items;
  std::vector<Member> members; ///< in file order, keys unique
  Position position;

  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
  const Member* member(std::string_view key) const;
};

struct Member {
  std::string key;
  Position position;
  Value value;
};

/// Something wrong with the text itself.
struct Mistake {
  Position position;
  std::string message; ///< what is wrong and the fix
};

struct Parsed {
  Value root;
  bool complete = false;         ///< false: the text could not be followed to its end
  std::vector<Mistake> mistakes; ///< in text order; those that allow it are collected
};

/// Deeper nesting than this is a mistake; a scene needs 8 levels.
inline constexpr int kMaximumDepth = 64;
/// Keys in one object; no object of a scene has 20.
inline constexpr std::size_t kMaximumKeys = 1000;

/// Reads UTF-8 text with an optional byte-order mark, LF or CRLF line ends, `//` and `/* */` comments and commas
/// before a closing bracket. Never throws. Small slips (a missing comma, a key without quotes, a number such as
/// `.5`, a key given twice) are reported and reading goes on.
Parsed parse(std::string_view text, int override = -1);

/// A value in words for messages: `the text "abc"`, `5`, `a list of 3`.
std::string inWords(const Value& value);

/// Text as a JSON string, quotes included.
std::string inQuotes(std::string_view text);

/// The value as JSON, in one line. Wants no Invalid in it.
std::string toText(const Value& value);

} // namespace tyndall::scene::json

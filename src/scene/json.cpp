// SPDX-License-Identifier: Apache-2.0
#include "scene/json.h"

#include "scene/json_scanner.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::scene::json {
namespace {

class Parser {
public:
  Parser(std::string_view text, int override) : scan_(text, override) {}

  Parsed run() {
    Parsed parsed;
    try {
      scan_.skipBlank();
      if (scan_.atEnd()) {
        scan_.stop("there is no JSON value here; a scene is an object: { \"camera\": { ... }, ... }");
      }
      parsed.root = value(0);
      scan_.skipBlank();
      if (!scan_.atEnd()) {
        scan_.stop(fmt::format("{} follows the end of the value; remove it, or look for a bracket closed too early",
                               scan_.here()));
      }
      parsed.complete = true;
    } catch (const Scanner::Stop&) {
    }
    parsed.mistakes = scan_.takeMistakes();
    return parsed;
  }

private:
  Value value(int depth) {
    if (depth >= kMaximumDepth) {
      scan_.stop(fmt::format("nested more than {} levels deep; a scene needs 7: remove brackets", kMaximumDepth));
    }
    Value result;
    result.position = scan_.position();
    const char c = scan_.peek();
    if (c == '{') {
      object(result, depth);
    } else if (c == '[') {
      array(result, depth);
    } else if (c == '"' || c == '\'') {
      result.text = scan_.string();
      result.kind = Kind::String;
    } else if (isNumberStart(c)) {
      scan_.number(result);
    } else if (isWordStart(c)) {
      scan_.word(result);
    } else {
      scan_.stop(fmt::format("a value is needed, not {}", scan_.here()));
    }
    return result;
  }

  /// Stops at the end of the text, naming the bracket that is still open.
  void requireMore(char close, const Position& open) {
    if (scan_.atEnd()) {
      scan_.stop(fmt::format("the file ends before the {} of line {}, column {} is closed; add {}",
                             close == '}' ? "{" : "[", open.line, open.column, close));
    }
  }

  /// After a member or item: true if another one follows, with the cursor on it.
  bool next(char close, const Position& open) {
    scan_.skipBlank();
    const bool comma = scan_.peek() == ',';
    if (comma) {
      scan_.advance();
      scan_.skipBlank();
    }
    if (scan_.peek() == close) {
      scan_.advance();
      return false;
    }
    const char c = scan_.peek();
    requireMore(close, open);
    const bool startsItem =
        c == '"' || c == '\'' || isWordStart(c) || (close == ']' && (isNumberStart(c) || c == '{' || c == '['));
    if (!startsItem) {
      scan_.stop(fmt::format("{} or a comma is needed here, not {}", close, scan_.here()));
    }
    if (!comma) {
      scan_.slip(scan_.position(), "a comma is missing before this");
    }
    return true;
  }

  void array(Value& result, int depth) {
    result.kind = Kind::Array;
    scan_.advance();
    scan_.skipBlank();
    requireMore(']', result.position);
    if (scan_.peek() == ']') {
      scan_.advance();
      return;
    }
    do {
      result.items.push_back(value(depth + 1));
    } while (next(']', result.position));
  }

  void object(Value& result, int depth) {
    result.kind = Kind::Object;
    scan_.advance();
    scan_.skipBlank();
    requireMore('}', result.position);
    if (scan_.peek() == '}') {
      scan_.advance();
      return;
    }
    do {
      member(result, depth);
    } while (next('}', result.position));
  }

  void member(Value& object, int depth) {
    Member result{.key = {}, .position = scan_.position(), .value = {}};
    result.key = scan_.key();
    scan_.skipBlank();
    if (scan_.peek() == '=') {
      scan_.slip(scan_.position(), "write ':' between a key and its value, not '='");
    } else if (scan_.peek() != ':') {
      scan_.stop(fmt::format("':' is needed after the key \"{}\", not {}", result.key, scan_.here()));
    }
    scan_.advance();
    scan_.skipBlank();
    result.value = value(depth + 1);
    if (const Member* first = object.member(result.key)) {
      scan_.slip(result.position, fmt::format("the key \"{}\" was already given in line {}, column {}; remove one",
                                              result.key, first->position.line, first->position.column));
      return;
    }
    if (object.members.size() == kMaximumKeys) {
      scan_.stop(fmt::format("an object with more than {} keys is no part of a scene", kMaximumKeys));
    }
    object.members.push_back(std::move(result));
  }

  Scanner scan_;
};

template <class Values>
auto findIn(Values& members, std::string_view key) {
  return std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
}

} // namespace

const Member* Value::member(std::string_view key) const {
  const auto found = findIn(members, key);
  return found == members.end() ? nullptr : &*found;
}

const Value* Value::find(std::string_view key) const {
  const Member* found = member(key);
  return found == nullptr ? nullptr : &found->value;
}

Value* Value::find(std::string_view key) {
  const auto found = findIn(members, key);
  return found == members.end() ? nullptr : &found->value;
}

Parsed parse(std::string_view text, int override) { return Parser(text, override).run(); }

std::string inWords(const Value& value) {
  constexpr std::size_t kLongest = 40;
  switch (value.kind) {
  case Kind::Invalid:
    return "a malformed value";
  case Kind::Null:
    return "null";
  case Kind::Boolean:
    return value.boolean ? "true" : "false";
  case Kind::Number:
    return value.text;
  case Kind::String:
    return "the text " + (value.text.size() <= kLongest ? inQuotes(value.text) : "that stands here");
  case Kind::Array:
    return fmt::format("a list of {}", value.items.size());
  case Kind::Object:
    return "an object";
  }
  return {};
}

std::string inQuotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
    }
    if (byte < 0x20) {
      result += fmt::format("\\u{:04x}", byte);
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string toText(const Value& value) {
  switch (value.kind) {
  case Kind::Invalid:
  case Kind::Null:
    return "null";
  case Kind::Boolean:
    return value.boolean ? "true" : "false";
  case Kind::Number:
    return value.text;
  case Kind::String:
    return inQuotes(value.text);
  case Kind::Array:
  case Kind::Object:
    break;
  }
  std::string inside;
  for (const Value& item : value.items) {
    inside += (inside.empty() ? "" : ", ") + toText(item);
  }
  for (const Member& member : value.members) {
    inside += (inside.empty() ? "" : ", ") + inQuotes(member.key) + ": " + toText(member.value);
  }
  return value.kind == Kind::Array ? "[" + inside + "]" : "{" + inside + "}";
}

} // namespace tyndall::scene::json

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <source_location>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tyndall {

/// A place in a text file that a user wrote. Lines and columns count from 1; 0 = unknown.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Bad input or environment: says what, where and what to do. Caught once, in main.
class Error : public std::runtime_error {
public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  /// The text becomes "file:line:column: message", unknown parts left out.
  Error(const SourceLocation& location, const std::string& message);
};

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

[[noreturn]] void checkFailed(const char* expression, std::source_location where);

/// "a, b and c" for messages that name what is there.
std::string joinNames(const std::vector<std::string>& names);

/// The candidate nearest to `name` by edit distance; empty when none is near (distance > 1 + length / 3).
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

} // namespace tyndall

/// Programmer errors only: prints the expression and the place, and aborts.
#define TYNDALL_CHECK(expression)                                                                                      \
  ((expression) ? void() : ::tyndall::checkFailed(#expression, std::source_location::current()))

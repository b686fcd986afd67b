// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace tyndall {
namespace {

std::string located(const SourceLocation& location, const std::string& message) {
  if (location.file.empty()) {
    return message;
  }
  if (location.line == 0) {
    return fmt::format("{}: {}", location.file, message);
  }
  return fmt::format("{}:{}:{}: {}", location.file, location.line, location.column, message);
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      const std::size_t replace = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replace, above + 1, row[j - 1] + 1});
      diagonal = above;
    }
  }
  return row[b.size()];
}

} // namespace

Error::Error(const SourceLocation& location, const std::string& message)
    : std::runtime_error(located(location, message)) {}

void checkFailed(const char* expression, std::source_location where) {
  std::fprintf(stderr, "%s:%u: internal check failed: %s\n", where.file_name(), where.line(), expression);
  std::abort();
}

std::string joinNames(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t best = 2 + name.size() / 3;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

} // namespace tyndall

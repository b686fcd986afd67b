// SPDX-License-Identifier: Apache-2.0
#include "volume/sequence.h"

#include "base/error.h"

#include <cctype>
#include <charconv>
#include <optional>

namespace tyndall::volume {
namespace {

constexpr int kMaxFrames = 1'000'000;
constexpr std::size_t kMaxNamed = 8; ///< missing frames that a message lists

struct Pattern {
  std::string before;
  std::string after;
  int width = 0;
  bool hasPlaceholder = false;
};

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

[[noreturn]] void failPattern(const std::string& pattern, const char* problem) {
  fail("'{}': {}; write one placeholder for the frame, as in smoke_%04d.vdb or smoke_####.vdb", pattern, problem);
}

/// The placeholder that starts at `at`, "%0Nd", "%d" or "###": its width; moves `at` behind it.
std::optional<int> placeholderAt(const std::string& pattern, std::size_t& at) {
  if (pattern[at] == '#') {
    const std::size_t start = at;
    while (at < pattern.size() && pattern[at] == '#') {
      ++at;
    }
    return int(at - start);
  }
  if (pattern[at] != '%') {
    return std::nullopt;
  }
  std::size_t end = at + 1;
  int width = 0;
  while (end < pattern.size() && isDigit(pattern[end]) && width < 100) {
    width = 10 * width + (pattern[end++] - '0');
  }
  const bool zeroPadded = end == at + 1 || pattern[at + 1] == '0';
  if (end >= pattern.size() || pattern[end] != 'd' || !zeroPadded || width > 20) {
    failPattern(pattern, "the '%' is not followed by d or 0Nd");
  }
  at = end + 1;
  return width;
}

Pattern parsePattern(const std::string& pattern) {
  Pattern parsed;
  std::size_t at = 0;
  while (at < pattern.size()) {
    std::string& text = parsed.hasPlaceholder ? parsed.after : parsed.before;
    if (pattern.compare(at, 2, "%%") == 0) {
      text += '%';
      at += 2;
    } else if (const std::optional<int> width = placeholderAt(pattern, at)) {
      if (parsed.hasPlaceholder) {
        failPattern(pattern, "more than one frame placeholder");
      }
      parsed.hasPlaceholder = true;
      parsed.width = *width;
    } else {
      text += pattern[at++];
    }
  }
  return parsed;
}

std::filesystem::path nameOf(const Pattern& pattern, int frame) {
  return pattern.before + fmt::format("{:0{}d}", frame, pattern.width) + pattern.after;
}

Pattern requirePlaceholder(const std::string& pattern) {
  const Pattern parsed = parsePattern(pattern);
  if (!parsed.hasPlaceholder) {
    failPattern(pattern, "no frame placeholder");
  }
  return parsed;
}

} // namespace

FrameRange parseFrames(const std::string& text) {
  const char* const end = text.data() + text.size();
  FrameRange range;
  auto [next, problem] = std::from_chars(text.data(), end, range.first);
  bool good = problem == std::errc();
  range.last = range.first;
  if (good && next != end) {
    good = *next == '-';
    if (good) {
      const auto second = std::from_chars(next + 1, end, range.last);
      good = second.ec == std::errc() && second.ptr == end;
    }
  }
  if (!good) {
    fail("frames '{}': write one frame or a range, as in 7 or 1-48", text);
  }
  if (range.last < range.first) {
    fail("frames '{}': the range runs backwards; write {}-{}", text, range.last, range.first);
  }
  if (std::int64_t(range.last) - range.first >= kMaxFrames) {
    fail("frames '{}': more than {} frames; render it in parts", text, kMaxFrames);
  }
  return range;
}

bool isSequence(const std::string& pattern) {
  try {
    return parsePattern(pattern).hasPlaceholder;
  } catch (const Error&) {
    return false; // a plain file may have any percent sign in its name
  }
}

std::filesystem::path frameFile(const std::string& pattern, int frame) {
  return nameOf(requirePlaceholder(pattern), frame);
}

std::vector<std::filesystem::path> expandSequence(const std::string& pattern, const FrameRange& frames) {
  const Pattern parsed = requirePlaceholder(pattern);
  std::vector<std::filesystem::path> files;
  std::vector<std::string> missing;
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    files.push_back(nameOf(parsed, frame));
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(files.back(), ignored)) {
      missing.push_back(std::to_string(frame));
    }
  }
  if (!missing.empty()) {
    const std::size_t count = missing.size();
    const std::string firstFile = frameFile(pattern, std::stoi(missing.front())).string();
    if (count > kMaxNamed) {
      missing.resize(kMaxNamed);
      missing.push_back(fmt::format("{} more", count - kMaxNamed));
    }
    fail("'{}': {} of {} frames have no file: {} (looked for {}); correct the pattern or choose other frames", pattern,
         count, frames.count(), joinNames(missing), firstFile);
  }
  return files;
}

} // namespace tyndall::volume

// SPDX-License-Identifier: Apache-2.0
#include "app/frames.h"

#include "base/error.h"
#include "volume/sequence.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

namespace tyndall::app {
namespace fs = std::filesystem;
namespace {

/// Every whole number in a name: "take2_007.vdb" -> 2, 7.
std::set<int> numbersIn(const std::string& name) {
  std::set<int> numbers;
  for (std::size_t i = 0; i < name.size(); ++i) {
    int number = 0;
    const bool begins = std::isdigit(static_cast<unsigned char>(name[i])) != 0;
    if (begins && std::from_chars(name.data() + i, name.data() + name.size(), number).ec == std::errc()) {
      numbers.insert(number);
    }
  }
  return numbers;
}

} // namespace

std::vector<int> framesPresent(const std::string& pattern) {
  const fs::path folder = fs::path(pattern).has_parent_path() ? fs::path(pattern).parent_path() : fs::path(".");
  std::vector<int> frames;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    for (const int number : numbersIn(name)) {
      if (volume::frameFile(pattern, number).filename() == name) {
        frames.push_back(number);
      }
    }
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

fs::path firstFile(const std::string& file) {
  std::error_code ignored;
  if (!volume::isSequence(file) || fs::exists(file, ignored)) {
    return file;
  }
  const std::vector<int> frames = framesPresent(file);
  if (frames.empty()) {
    fail("{}: no frame of this sequence is there; {} would be the first, correct the name or the number of digits",
         file, volume::frameFile(file, 1).string());
  }
  return volume::frameFile(file, frames.front());
}

std::string inFrame(double frame, const std::string& message) { return fmt::format("in frame {}: {}", frame, message); }

} // namespace tyndall::app

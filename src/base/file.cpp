// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include "base/error.h"

#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>

namespace tyndall {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kFnvOffset = 14695981039346656037ull;
constexpr std::uint64_t kFnvPrime = 1099511628211ull;

std::uint64_t fnv1a(std::uint64_t hash, const char* bytes, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    hash = (hash ^ static_cast<unsigned char>(bytes[i])) * kFnvPrime;
  }
  return hash;
}

std::ifstream openForReading(const fs::path& path) {
  if (!fs::exists(path)) {
    fail("{}: no such file", path.string());
  }
  if (fs::is_directory(path)) {
    fail("{}: is a folder, a file is needed", path.string());
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    fail("{}: cannot be read; check its permissions", path.string());
  }
  return stream;
}

fs::path temporaryBeside(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.{}.part", path.filename().string(), ::getpid());
}

} // namespace

std::string readTextFile(const fs::path& path) {
  std::ifstream stream = openForReading(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  checkWritable(path);
  const fs::path temporary = temporaryBeside(path);
  try {
    write(temporary);
    fs::rename(temporary, path);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void checkWritable(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) {
    fail("{}: the folder {} does not exist; create it or name another output with -o", path.string(), folder.string());
  }
  if (fs::is_directory(path)) {
    fail("{}: is a folder; name a file", path.string());
  }
  const fs::path probe = temporaryBeside(path);
  const bool writable = static_cast<bool>(std::ofstream(probe));
  std::error_code ignored;
  fs::remove(probe, ignored);
  if (!writable) {
    fail("{}: cannot write into {}; name another output with -o", path.string(), folder.string());
  }
}

std::uint64_t hashFile(const fs::path& path) {
  std::ifstream stream = openForReading(path);
  std::array<char, 1 << 16> block{};
  std::uint64_t hash = kFnvOffset;
  while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
    hash = fnv1a(hash, block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return hash;
}

std::uint64_t hashText(const std::string& text) { return fnv1a(kFnvOffset, text.data(), text.size()); }

} // namespace tyndall

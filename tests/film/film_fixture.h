// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "film/film.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

namespace tyndall::film {

/// A folder that lives as long as the object.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tyndall-film-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  bool empty() const { return std::filesystem::is_empty(path_); }

private:
  std::filesystem::path path_;
};

/// While it lives no file of this process grows beyond 4 KiB: a disk that fills up in the middle of writing.
class FullDisk {
public:
  FullDisk() {
    previousHandler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &previous_);
    const rlimit small{4096, previous_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &previous_);
    std::signal(SIGXFSZ, previousHandler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

private:
  rlimit previous_{};
  void (*previousHandler_)(int) = SIG_DFL;
};

inline std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

/// What an Error says; fails the test if `action` throws none.
template <class Action>
std::string errorOf(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return {};
}

/// Sums that depend on pixel position, seed and batch alone, as a renderer's do whatever its crops are.
inline BatchSums pseudoBatch(const glm::uvec2& position, std::uint32_t seed, std::uint32_t batch) {
  std::seed_seq sequence{position.x, position.y, seed, batch};
  std::minstd_rand generator(sequence);
  std::uniform_real_distribution<float> uniform(0.0f, 16.0f);
  BatchSums sums;
  for (float& sum : sums.moments) {
    sum = uniform(generator);
  }
  for (float& sum : sums.extras) {
    sum = uniform(generator);
  }
  return sums;
}

inline Film pseudoFilm(const glm::uvec2& size, const Window& window, std::uint32_t seed, glm::uvec2 batches) {
  Film film(size, window);
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    const glm::uvec2 position = window.min + glm::uvec2(i % window.extent().x, i / window.extent().x);
    for (std::uint32_t batch = batches.x; batch < batches.y; ++batch) {
      film.add(i, batch, kBatchSamples, pseudoBatch(position, seed, batch));
    }
  }
  return film;
}

inline void expectSameBits(const Film& a, const Film& b) {
  ASSERT_EQ(a.imageSize(), b.imageSize());
  ASSERT_EQ(a.window(), b.window());
  ASSERT_EQ(a.pixels().size(), b.pixels().size());
  EXPECT_EQ(std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(PixelState)), 0);
}

} // namespace tyndall::film

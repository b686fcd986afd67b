// SPDX-License-Identifier: Apache-2.0
// Kernels with their specialization constants written in, and where they are kept.
#include "gpu/specialise.h"

#include <cstdint>

// Needs <cstdint> before it.
#include "kernels/doubling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;

/// A folder that goes away again.
class Folder {
public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "tyndall-specialise-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path path;
};

std::vector<gpu::SpecEntry> factor(float value) { return {{0, gpu::specBits(value)}}; }

std::vector<fs::path> filesIn(const fs::path& folder) { return {fs::directory_iterator(folder), {}}; }

/// The value stands in the module; a constant that is told apart by nothing else would give equal words.
TEST(Specialise, WritesTheValueIn) {
  const std::vector<std::uint32_t> three = gpu::specialise(k_doubling_spirv, factor(3.0f));
  const std::uint32_t bits = gpu::specBits(3.0f);
  EXPECT_NE(std::ranges::find(three, bits), three.end());
  EXPECT_NE(three, gpu::specialise(k_doubling_spirv, factor(4.0f)));
  EXPECT_LT(three.size(), std::size(k_doubling_spirv)) << "names were to be left out";
}

/// What is kept is read again: seen by a kept file that says something else, hash and all.
TEST(Specialise, ReadsWhatItKept) {
  const Folder folder;
  const std::vector<std::uint32_t> first = gpu::specialiseOnce(k_doubling_spirv, factor(3.0f), folder.path);
  ASSERT_EQ(filesIn(folder.path).size(), 1u);
  const fs::path three = filesIn(folder.path).front();
  const std::vector<std::uint32_t> four = gpu::specialiseOnce(k_doubling_spirv, factor(4.0f), folder.path);
  ASSERT_EQ(filesIn(folder.path).size(), 2u) << "another value is another file";
  for (const fs::path& file : filesIn(folder.path)) {
    if (file != three) {
      fs::copy_file(file, three, fs::copy_options::overwrite_existing);
    }
  }
  EXPECT_EQ(gpu::specialiseOnce(k_doubling_spirv, factor(3.0f), folder.path), four);
  EXPECT_NE(first, four);
}

TEST(Specialise, ADamagedFileIsMadeAnew) {
  const Folder folder;
  const std::vector<std::uint32_t> sound = gpu::specialiseOnce(k_doubling_spirv, factor(3.0f), folder.path);
  const fs::path file = filesIn(folder.path).front();
  const auto size = fs::file_size(file);
  const auto damage = [&](const auto& change) {
    change();
    EXPECT_EQ(gpu::specialiseOnce(k_doubling_spirv, factor(3.0f), folder.path), sound);
    EXPECT_EQ(fs::file_size(file), size) << "and kept anew";
  };
  damage([&] { fs::resize_file(file, size - 4); });
  damage([&] { fs::resize_file(file, 0); });
  damage([&] {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(size / 2)).put('\x55').put('\x55');
  });
}

TEST(Specialise, TheFolderDoesNotGrowWithoutBound) {
  const Folder folder;
  for (std::size_t i = 0; i < gpu::kKeptModules + 5; ++i) {
    const fs::path old = folder.path / (std::to_string(i) + ".spv");
    std::ofstream(old) << "old";
    fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  std::ofstream(folder.path / "pipelines.bin") << "not ours";
  const std::vector<std::uint32_t> sound = gpu::specialiseOnce(k_doubling_spirv, factor(3.0f), folder.path);
  EXPECT_EQ(filesIn(folder.path).size(), gpu::kKeptModules + 1);
  EXPECT_TRUE(fs::exists(folder.path / "pipelines.bin"));
}

TEST(Specialise, WorksWhereNothingCanBeKept) {
  const std::vector<std::uint32_t> sound = gpu::specialise(k_doubling_spirv, factor(3.0f));
  EXPECT_EQ(gpu::specialiseOnce(k_doubling_spirv, factor(3.0f), "/proc/no/such/folder"), sound);
  EXPECT_EQ(gpu::specialiseOnce(k_doubling_spirv, factor(3.0f), {}), sound);
}

} // namespace
} // namespace tyndall::test

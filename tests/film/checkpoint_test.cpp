// SPDX-License-Identifier: Apache-2.0
#include "film/checkpoint.h"

#include "film/exr.h"
#include "film_fixture.h"

#include <algorithm>
#include <limits>

namespace tyndall::film {
namespace {

const Window kCrop{{3, 2}, {14, 9}};

Film testFilm() {
  Film film = pseudoFilm({20, 15}, kCrop, 4, {0, 5});
  film.metadata["seed"] = "4";
  return film;
}

TEST(Checkpoint, RoundTripIsBitExact) {
  const TemporaryFolder folder;
  Film film = testFilm();
  // Values whose bits a conversion would change.
  film.pixels()[0].sum[0] = {-0.0, std::numeric_limits<double>::denorm_min(), 1e300, 0.1};
  film.pixels()[1].samples = {4294967295u, 1u};
  film.independentHalves = true;
  saveCheckpoint(folder / "a.exr", film, {{"scene.hash", "abc"}, {"seed", "9"}});
  const Film loaded = loadCheckpoint(folder / "a.exr");
  expectSameBits(loaded, film);
  EXPECT_TRUE(loaded.independentHalves);
  EXPECT_EQ(loaded.metadata, (Metadata{{"scene.hash", "abc"}, {"seed", "9"}}));
}

TEST(Checkpoint, ResumingGivesTheUninterruptedFilm) {
  const TemporaryFolder folder;
  saveCheckpoint(folder / "a.exr", testFilm());
  Film resumed = loadCheckpoint(folder / "a.exr");
  for (std::size_t i = 0; i < resumed.pixels().size(); ++i) {
    const glm::uvec2 position = kCrop.min + glm::uvec2(i % kCrop.extent().x, i / kCrop.extent().x);
    for (std::uint32_t batch = 5; batch < 9; ++batch) {
      resumed.add(i, batch, kBatchSamples, pseudoBatch(position, 4, batch));
    }
  }
  expectSameBits(resumed, pseudoFilm({20, 15}, kCrop, 4, {0, 9}));
}

TEST(Checkpoint, TruncationIsAnError) {
  const TemporaryFolder folder;
  saveCheckpoint(folder / "a.exr", testFilm());
  const std::string bytes = bytesOf(folder / "a.exr");
  for (std::size_t length = 0; length < bytes.size(); length += 211) {
    writeBytes(folder / "cut.exr", bytes.substr(0, length));
    EXPECT_THROW(loadCheckpoint(folder / "cut.exr"), Error) << length;
  }
  writeBytes(folder / "cut.exr", bytes.substr(0, bytes.size() - 1));
  EXPECT_THROW(loadCheckpoint(folder / "cut.exr"), Error);
}

TEST(Checkpoint, OneChangedBitOfTheSumsIsFound) {
  const TemporaryFolder folder;
  saveCheckpoint(folder / "a.exr", testFilm());
  const std::string bytes = bytesOf(folder / "a.exr");
  std::mt19937 generator(8);
  const std::size_t pixelBytes = kCrop.pixelCount() * sizeof(PixelState);
  const std::size_t rowBytes = kCrop.extent().x * sizeof(PixelState);
  for (int trial = 0; trial < 100; ++trial) {
    std::string damaged = bytes;
    // Rows lie at the end, each after 8 bytes of position and size; only hit the last row's pixels.
    damaged[bytes.size() - 1 - generator() % std::min(rowBytes, pixelBytes)] ^= char(1 << (generator() % 8));
    writeBytes(folder / "damaged.exr", damaged);
    EXPECT_NE(errorOf([&] { loadCheckpoint(folder / "damaged.exr"); }).find("damaged"), std::string::npos);
  }
}

TEST(Checkpoint, DamagedHeadersNeverCrash) {
  const TemporaryFolder folder;
  saveCheckpoint(folder / "a.exr", testFilm());
  const std::string bytes = bytesOf(folder / "a.exr");
  std::mt19937 generator(6);
  int errors = 0;
  for (int trial = 0; trial < 150; ++trial) {
    std::string damaged = bytes;
    damaged[generator() % 2600] = char(generator());
    writeBytes(folder / "damaged.exr", damaged);
    try {
      loadCheckpoint(folder / "damaged.exr");
    } catch (const Error&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 50);
}

TEST(Checkpoint, APictureIsNotACheckpoint) {
  const TemporaryFolder folder;
  Image image{{2, 2}, {{0, 0}, {2, 2}}, {{"R", std::vector<float>(4, 1.0f)}}, {}, {}};
  writeExr(folder / "a.exr", image);
  EXPECT_FALSE(isCheckpoint(folder / "a.exr"));
  EXPECT_FALSE(isCheckpoint(folder / "none.exr"));
  EXPECT_NE(errorOf([&] { loadCheckpoint(folder / "a.exr"); }).find("not a checkpoint"), std::string::npos);
  saveCheckpoint(folder / "b.exr", testFilm());
  EXPECT_TRUE(isCheckpoint(folder / "b.exr"));
}

std::vector<std::byte> pseudoBytes(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<std::byte> bytes(count);
  std::generate(bytes.begin(), bytes.end(), [&] { return std::byte(generator()); });
  return bytes;
}

/// Files beside the checkpoint.
std::vector<std::filesystem::path> companionsIn(const TemporaryFolder& folder) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
    if (entry.path().filename().string().starts_with("a.exr.checkpoint.")) {
      found.push_back(entry.path());
    }
  }
  return found;
}

TEST(Checkpoint, ItsCompanionComesAndGoesWithIt) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.exr.checkpoint";
  writeBytes(folder / "a.exr.checkpoint.notes", "somebody else's");
  for (const std::size_t size : {1000u, 1001u, 0u, 77u}) { // whole words and a rest; none
    const std::vector<std::byte> companion = pseudoBytes(size, unsigned(size));
    saveCheckpoint(path, testFilm(), {}, companion);
    EXPECT_EQ(loadCompanion(path), companion);
    EXPECT_EQ(loadCheckpoint(path).metadata, testFilm().metadata);
    EXPECT_EQ(companionsIn(folder).size(), size > 0 ? 2u : 1u) << "the one before is deleted, and nothing else";
  }
  removeCheckpoint(path);
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(companionsIn(folder).size(), 1u);
}

/// A program that ends between the two files leaves the checkpoint before with the companion that belongs to it.
TEST(Checkpoint, IsNeverWithoutItsCompanion) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.exr.checkpoint";
  const std::vector<std::byte> before = pseudoBytes(3000, 1);
  saveCheckpoint(path, testFilm(), {}, before);
  const std::string checkpoint = bytesOf(path);
  const std::filesystem::path companion = companionsIn(folder).front();
  {
    const FullDisk disk; // has room for the companion, not for the checkpoint
    EXPECT_THROW(saveCheckpoint(path, testFilm(), {}, pseudoBytes(3000, 2)), Error);
  }
  EXPECT_EQ(companionsIn(folder).size(), 2u);
  EXPECT_EQ(bytesOf(path), checkpoint);
  EXPECT_EQ(loadCompanion(path), before);
  saveCheckpoint(path, testFilm(), {}, pseudoBytes(3000, 3));
  EXPECT_EQ(companionsIn(folder).size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(companion));
}

TEST(Checkpoint, ADamagedOrMissingCompanionIsRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.exr.checkpoint";
  saveCheckpoint(path, testFilm(), {}, pseudoBytes(1001, 1));
  const std::filesystem::path companion = companionsIn(folder).front();
  const std::string whole = bytesOf(companion);
  for (std::size_t i = 0; i < whole.size(); i += 50) {
    std::string damaged = whole;
    damaged[i] ^= char(1 << i % 8);
    writeBytes(companion, damaged);
    EXPECT_NE(errorOf([&] { loadCompanion(path); }).find("damaged"), std::string::npos) << i;
    writeBytes(companion, whole.substr(0, i));
    EXPECT_NE(errorOf([&] { loadCompanion(path); }).find("damaged"), std::string::npos) << i;
  }
  std::filesystem::remove(companion);
  EXPECT_NE(errorOf([&] { loadCompanion(path); }).find("missing"), std::string::npos);
  loadCheckpoint(path); // the film alone is whole
}

TEST(Checkpoint, UnwritableOutputsLeaveNothingBehind) {
  const TemporaryFolder folder;
  EXPECT_THROW(saveCheckpoint(folder / "none/a.exr", testFilm()), Error);
  EXPECT_THROW(saveCheckpoint(folder / "a.exr", Film()), Error);  // no pixels: OpenEXR refuses
  {
    const FullDisk disk;
    const std::string message = errorOf([&] { saveCheckpoint(folder / "a.exr", testFilm()); });
    EXPECT_NE(message.find("some space"), std::string::npos) << message;
  }
  EXPECT_TRUE(folder.empty());
}

} // namespace
} // namespace tyndall::film

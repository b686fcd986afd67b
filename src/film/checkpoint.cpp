// SPDX-License-Identifier: Apache-2.0
#include "film/checkpoint.h"

#include "base/file.h"
#include "film/exr_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

namespace tyndall::film {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "the word order of the channels below");
static_assert(sizeof(PixelState) == 208, "a new field needs its channels below and a new kVersion");

const std::string kVersion = "1";
const std::string kVersionKey = "checkpoint.version";
const std::string kHashKey = "checkpoint.hash";
const std::string kHalvesKey = "checkpoint.independentHalves";
const std::string kCompanionKey = "checkpoint.companion";

constexpr std::size_t kHashDigits = 16;

/// One 32-bit word of a PixelState.
struct Word {
  std::string channel;
  std::size_t offset = 0;
};

void addDoubles(std::vector<Word>& words, const std::string& name, std::size_t offset, int count) {
  for (int i = 0; i < count; ++i) {
    words.push_back({fmt::format("{}.{}.lo", name, i), offset + 8 * std::size_t(i)});
    words.push_back({fmt::format("{}.{}.hi", name, i), offset + 8 * std::size_t(i) + 4});
  }
}

const std::vector<Word>& pixelWords() {
  static const std::vector<Word> all = [] {
    std::vector<Word> words;
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t moments = half * kMomentCount * sizeof(double);
      addDoubles(words, fmt::format("half{}.sum", half), offsetof(PixelState, sum) + moments, kMomentCount);
      addDoubles(words, fmt::format("half{}.squares", half), offsetof(PixelState, sumOfSquares) + moments,
                 kMomentCount);
      words.push_back({fmt::format("half{}.samples", half), offsetof(PixelState, samples) + 4 * half});
      words.push_back({fmt::format("half{}.batches", half), offsetof(PixelState, batches) + 4 * half});
    }
    addDoubles(words, "extra", offsetof(PixelState, extra), kExtraCount);
    return words;
  }();
  return all;
}

/// Words of all bytes, each multiplied in: any changed, swapped or missing bit shows.
std::string hashOf(std::span<const std::byte> bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof(word), bytes.size() - i));
    hash = std::rotl((hash ^ word) * 1099511628211ull, 29);  // rotation: high bits reach the low ones too
  }
  return fmt::format("{:016x}", hash);
}

std::string hashOf(const Film& film) { return hashOf(std::as_bytes(std::span(film.pixels()))); }

/// "a.exr.checkpoint" -> "a.exr.checkpoint.0123456789abcdef"
fs::path companionOf(const fs::path& path, const std::string& hash) { return fs::path(path) += "." + hash; }

bool isCompanion(const fs::path& file, const fs::path& checkpoint) {
  const std::string name = file.filename().string();
  const std::string stem = checkpoint.filename().string() + ".";
  return name.size() == stem.size() + kHashDigits && name.starts_with(stem) &&
         std::all_of(name.end() - kHashDigits, name.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
}

/// Deletes all but the one that is named; "": all. What cannot be deleted does no harm.
void removeCompanions(const fs::path& checkpoint, const std::string& except) {
  std::error_code ignored;
  const fs::path folder = checkpoint.has_parent_path() ? checkpoint.parent_path() : fs::path(".");
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (isCompanion(entry.path(), checkpoint) && entry.path().extension() != "." + except) {
      old.push_back(entry.path());
    }
  }
  for (const fs::path& file : old) {
    fs::remove(file, ignored);
  }
}

void saveCompanion(const fs::path& path, std::span<const std::byte> companion) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(companion.data()), std::streamsize(companion.size()));
    stream.close();
    if (!stream) {
      fail("{}: writing failed; is the disk full? Free some space or name another output with -o", path.string());
    }
  });
}

Imf::FrameBuffer frameOf(const PixelState* pixels, const Imath::Box2i& data) {
  const std::size_t width = std::size_t(data.max.x - data.min.x + 1);
  Imf::FrameBuffer frame;
  for (const Word& word : pixelWords()) {
    frame.insert(word.channel, Imf::Slice::Make(Imf::UINT, reinterpret_cast<const char*>(pixels) + word.offset, data,
                                                sizeof(PixelState), sizeof(PixelState) * width));
  }
  return frame;
}

void checkLayout(const Imf::Header& header, const Metadata& metadata, const std::filesystem::path& path) {
  const auto version = metadata.find(kVersionKey);
  if (version == metadata.end()) {
    fail("{}: is a picture, not a checkpoint; name a file that --resume or merge can read, written with the render",
         path.string());
  }
  if (version->second != kVersion) {
    fail("{}: checkpoint of version {}, this program reads version {}; render again or use the program that wrote it",
         path.string(), version->second, kVersion);
  }
  for (const Word& word : pixelWords()) {
    const Imf::Channel* channel = header.channels().findChannel(word.channel);
    if (channel == nullptr || channel->type != Imf::UINT || channel->xSampling != 1 || channel->ySampling != 1) {
      fail("{}: the checkpoint has no integer channel {}; it is damaged, render again", path.string(), word.channel);
    }
  }
  const Imath::Box2i& data = header.dataWindow();
  const Imath::Box2i& display = header.displayWindow();
  if (display.min != Imath::V2i(0) || data.min.x < 0 || data.min.y < 0 || data.max.x > display.max.x ||
      data.max.y > display.max.y) {
    fail("{}: the checkpoint's windows do not fit; it is damaged, render again", path.string());
  }
  // Uncompressed: the pixels must be in the file before memory is taken for them.
  const std::uint64_t count = std::uint64_t(data.max.x - data.min.x + 1) * std::uint64_t(data.max.y - data.min.y + 1);
  if (count > std::filesystem::file_size(path) / sizeof(PixelState)) {
    fail("{}: the checkpoint is cut short; render again or use an older copy", path.string());
  }
}

} // namespace

void saveCheckpoint(const std::filesystem::path& path, const Film& film, const Metadata& extra,
                    std::span<const std::byte> companion) {
  const std::string companionHash = companion.empty() ? "" : hashOf(companion);
  if (!companion.empty()) {
    saveCompanion(companionOf(path, companionHash), companion);
  }
  Metadata metadata = extra;
  metadata.insert(film.metadata.begin(), film.metadata.end());
  metadata[kVersionKey] = kVersion;
  metadata[kHashKey] = hashOf(film);
  metadata[kCompanionKey] = companionHash;
  metadata[kHalvesKey] = std::string(film.independentHalves ? "1" : "0");
  Imf::Header header = makeHeader(film.imageSize(), film.window(), metadata);
  header.compression() = Imf::NO_COMPRESSION;
  for (const Word& word : pixelWords()) {
    header.channels().insert(word.channel, Imf::Channel(Imf::UINT));
  }
  writeExrAtomically(path, [&](std::ofstream& stream, const std::string& name) {
    Imf::StdOFStream output(stream, name.c_str());
    Imf::OutputFile file(output, header);
    file.setFrameBuffer(frameOf(film.pixels().data(), header.dataWindow()));
    file.writePixels(int(film.window().extent().y));
  });
  removeCompanions(path, companionHash);
}

std::vector<std::byte> loadCompanion(const fs::path& path) {
  checkIsExr(path);
  const std::string hash = readingExr(path, [&] {
    return readMetadata(Imf::InputFile(path.string().c_str()).header())[kCompanionKey];
  });
  if (hash.empty()) {
    return {};
  }
  const fs::path file = companionOf(path, hash);
  if (!fs::is_regular_file(file)) {
    fail("{}: belongs to the checkpoint and is missing; put it back, or delete {} and render again", file.string(),
         path.string());
  }
  const std::string text = readTextFile(file);
  const auto bytes = std::as_bytes(std::span(text));
  if (hashOf(bytes) != hash) {
    fail("{}: is not what was saved with the checkpoint; it is damaged, delete {} and render again", file.string(),
         path.string());
  }
  return {bytes.begin(), bytes.end()};
}

void removeCheckpoint(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
  removeCompanions(path, "");
}

bool isCheckpoint(const std::filesystem::path& path) {
  try {
    checkIsExr(path);
    return readingExr(path, [&] {
      return readMetadata(Imf::InputFile(path.string().c_str()).header()).contains(kVersionKey);
    });
  } catch (const Error&) {
    return false;
  }
}

Film loadCheckpoint(const std::filesystem::path& path) {
  checkIsExr(path);
  return readingExr(path, [&] {
    Imf::InputFile file(path.string().c_str());
    Metadata metadata = readMetadata(file.header());
    checkLayout(file.header(), metadata, path);
    const Imath::Box2i& data = file.header().dataWindow();
    const Imath::V2i display = file.header().displayWindow().max;
    Film film(glm::uvec2(display.x + 1, display.y + 1),
              {glm::uvec2(data.min.x, data.min.y), glm::uvec2(data.max.x + 1, data.max.y + 1)});
    file.setFrameBuffer(frameOf(film.pixels().data(), data));
    file.readPixels(data.min.y, data.max.y);
    if (metadata[kHashKey] != hashOf(film)) {
      fail("{}: the checkpoint's sums are not those that were saved; the file is damaged, render again", path.string());
    }
    film.independentHalves = metadata[kHalvesKey] == "1";
    for (const std::string& key : {kVersionKey, kHashKey, kHalvesKey, kCompanionKey}) {
      metadata.erase(key);
    }
    film.metadata = std::move(metadata);
    return film;
  });
}

} // namespace tyndall::film

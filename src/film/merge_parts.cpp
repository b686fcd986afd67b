// SPDX-License-Identifier: Apache-2.0
#include "film/merge_parts.h"

#include "base/error.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

namespace tyndall::film {
namespace {

std::uint32_t numberOf(const NamedFilm& film, const char* key) {
  const std::string text = metadataOf(film, key);
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    fail("{}: \"{}\" in its header is {}, not a whole number; render it again", film.first, key, text);
  }
  return number;
}

std::string textOf(const std::vector<Block>& blocks) {
  std::string text;
  for (const Block& b : blocks) {
    text += fmt::format("{}{} {} {} {} {} {} {}", text.empty() ? "" : "; ", b.seed, b.first, b.end, b.window.min.x,
                        b.window.min.y, b.window.max.x, b.window.max.y);
  }
  return text;
}

std::vector<Block> blocksOf(const NamedFilm& film) {
  if (!film.second.metadata.contains(kPartsKey)) {
    return {{numberOf(film, kSeedKey), numberOf(film, kFirstSampleKey), numberOf(film, kEndSampleKey),
             film.second.window()}};
  }
  std::vector<Block> blocks;
  std::istringstream list(metadataOf(film, kPartsKey));
  for (std::string item; std::getline(list, item, ';');) {
    std::istringstream numbers(item);
    Block b;
    if (!(numbers >> b.seed >> b.first >> b.end >> b.window.min.x >> b.window.min.y >> b.window.max.x >>
          b.window.max.y)) {
      fail("{}: \"{}\" in its header cannot be read; merge its parts again", film.first, kPartsKey);
    }
    blocks.push_back(b);
  }
  return blocks;
}

/// The sum for counts, else the one value or the distinct ones in order.
std::string joinedValue(const std::string& key, const std::vector<Part>& parts) {
  std::set<std::string> values;
  std::uint64_t sum = 0;
  for (const Part& part : parts) {
    const auto it = part.source->second.metadata.find(key);
    if (it == part.source->second.metadata.end()) {
      continue;
    }
    values.insert(it->second);
    std::uint64_t count = 0;
    std::from_chars(it->second.data(), it->second.data() + it->second.size(), count);
    sum += count;
  }
  if (key.starts_with(kCountPrefix)) {
    return std::to_string(sum);
  }
  std::string text;
  for (const std::string& value : values) {
    text += (text.empty() ? "" : "; ") + value;
  }
  return text;
}

/// One rectangle of one range of one seed, if that is what the blocks are: neighbouring crops make one render.
bool isOneRender(const std::vector<Block>& blocks) {
  return std::ranges::all_of(blocks, [&](const Block& block) {
    return block.seed == blocks[0].seed && block.first == blocks[0].first && block.end == blocks[0].end;
  });
}

} // namespace

std::string metadataOf(const NamedFilm& film, const char* key) {
  const auto it = film.second.metadata.find(key);
  if (it == film.second.metadata.end()) {
    fail("{}: has no \"{}\" in its header, so it cannot be merged; render it again with this program", film.first, key);
  }
  return it->second;
}

Part partOf(const NamedFilm& film) { return {&film, blocksOf(film)}; }

bool sameSamples(const Block& a, const Block& b) {
  const bool windowsMeet = a.window.min.x < b.window.max.x && b.window.min.x < a.window.max.x &&
                           a.window.min.y < b.window.max.y && b.window.min.y < a.window.max.y;
  return windowsMeet && a.seed == b.seed && a.first < b.end && b.first < a.end;
}

Metadata joinedMetadata(const std::vector<Part>& parts) {
  std::set<std::string> keys;
  std::vector<Block> blocks;
  for (const Part& part : parts) {
    for (const auto& [key, value] : part.source->second.metadata) {
      keys.insert(key);
    }
    blocks.insert(blocks.end(), part.blocks.begin(), part.blocks.end());
  }
  Metadata metadata;
  for (const std::string& key : keys) {
    metadata[key] = joinedValue(key, parts);
  }
  std::ranges::sort(blocks, {}, &Block::key);
  metadata.erase(kPartsKey);
  if (!isOneRender(blocks)) {
    metadata[kPartsKey] = textOf(blocks);
  }
  return metadata;
}

void setProvenance(Film& film, const Provenance& provenance) {
  film.metadata[kSceneHashKey] = provenance.sceneHash;
  film.metadata[kDeviceKey] = provenance.device;
  film.metadata[kSeedKey] = std::to_string(provenance.seed);
  film.metadata[kFirstSampleKey] = std::to_string(provenance.firstSample);
  film.metadata[kEndSampleKey] = std::to_string(provenance.endSample);
}

} // namespace tyndall::film

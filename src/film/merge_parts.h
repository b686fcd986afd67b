// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/merge.h"

#include <tuple>

/// Who holds which samples. Internal to merging.
namespace tyndall::film {

using NamedFilm = std::pair<std::string, Film>;

/// Samples [first, end) of `seed` in every pixel of `window`.
struct Block {
  std::uint32_t seed = 0;
  std::uint32_t first = 0;
  std::uint32_t end = 0;
  Window window;
  auto key() const { return std::tuple(seed, first, end, window.min.y, window.min.x, window.max.y, window.max.x); }
  bool operator<(const Block& other) const { return key() < other.key(); }
};

/// A film with the blocks that it is made of.
struct Part {
  const NamedFilm* source = nullptr;
  std::vector<Block> blocks;
};

/// @throws Error if the film's provenance is missing or unreadable.
Part partOf(const NamedFilm& film);

/// @throws Error naming the film if the key is missing.
std::string metadataOf(const NamedFilm& film, const char* key);

/// Whether a pixel of both gets a sample of equal seed and index.
bool sameSamples(const Block& a, const Block& b);

Metadata joinedMetadata(const std::vector<Part>& parts);

} // namespace tyndall::film

// SPDX-License-Identifier: Apache-2.0
#include "film/merge.h"

#include "base/error.h"
#include "film/merge_parts.h"

#include <algorithm>
#include <limits>

namespace tyndall::film {
namespace {

void checkPair(const Part& a, const Part& b) {
  const auto& [nameA, filmA] = *a.source;
  const auto& [nameB, filmB] = *b.source;
  if (filmA.imageSize() != filmB.imageSize()) {
    fail("{} is of a {}x{} picture and {} of a {}x{} one; render them with one --size", nameA, filmA.imageSize().x,
         filmA.imageSize().y, nameB, filmB.imageSize().x, filmB.imageSize().y);
  }
  const std::string sceneA = metadataOf(*a.source, kSceneHashKey);
  const std::string sceneB = metadataOf(*b.source, kSceneHashKey);
  if (sceneA != sceneB) {
    fail("{} and {} are of different scenes ({} and {}); merge parts of one scene", nameA, nameB, sceneA, sceneB);
  }
  for (const Block& blockA : a.blocks) {
    for (const Block& blockB : b.blocks) {
      if (sameSamples(blockA, blockB)) {
        fail("{} and {} hold the same samples (seed {}, from {}) of the same pixels, which would count twice; render "
             "one with another --seed",
             nameA, nameB, blockA.seed, std::max(blockA.first, blockB.first));
      }
    }
  }
}

Window unionOf(const std::vector<Part>& parts) {
  Window all = parts.front().source->second.window();
  for (const Part& part : parts) {
    all.min = glm::min(all.min, part.source->second.window().min);
    all.max = glm::max(all.max, part.source->second.window().max);
  }
  return all;
}

/// @throws Error with the first rectangle of every band of rows that no part covers.
void checkCovered(const std::vector<Part>& parts, const Window& all) {
  std::vector<Window> holes;
  for (std::uint32_t y = all.min.y; y < all.max.y; ++y) {
    std::uint32_t x = all.min.x;
    std::uint32_t gapEnd = all.max.x;
    for (bool moved = true; moved;) {  // from the left, as far as the parts reach
      moved = false;
      gapEnd = all.max.x;
      for (const Part& part : parts) {
        const Window& window = part.source->second.window();
        const bool inRow = y >= window.min.y && y < window.max.y;
        if (inRow && window.min.x <= x && window.max.x > x) {
          x = window.max.x;
          moved = true;
        } else if (inRow && window.min.x > x) {
          gapEnd = std::min(gapEnd, window.min.x);
        }
      }
    }
    if (x >= all.max.x) {
      continue;
    }
    const bool continues = !holes.empty() && holes.back().max.y == y && holes.back().min.x == x &&
                           holes.back().max.x == gapEnd;
    if (continues) {
      holes.back().max.y = y + 1;
    } else {
      holes.push_back({{x, y}, {gapEnd, y + 1}});
    }
  }
  if (holes.empty()) {
    return;
  }
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min<std::size_t>(holes.size(), 5); ++i) {
    texts.push_back(fmt::format("rows {} to {} (columns {} to {})", holes[i].min.y, holes[i].max.y - 1, holes[i].min.x,
                                holes[i].max.x - 1));
  }
  fail("the parts leave out {}{}; render these with --crop and merge again", joinNames(texts),
       holes.size() > texts.size() ? " and more" : "");
}

std::uint32_t addCounts(std::uint32_t a, std::uint32_t b) {
  if (a > std::numeric_limits<std::uint32_t>::max() - b) {
    fail("the parts together have more than {} samples in a pixel; merge fewer",
         std::numeric_limits<std::uint32_t>::max());
  }
  return a + b;
}

void addState(PixelState& to, const PixelState& from) {
  for (int half = 0; half < 2; ++half) {
    for (int moment = 0; moment < kMomentCount; ++moment) {
      to.sum[half][moment] += from.sum[half][moment];
      to.sumOfSquares[half][moment] += from.sumOfSquares[half][moment];
    }
    to.samples[half] = addCounts(to.samples[half], from.samples[half]);
    to.batches[half] = addCounts(to.batches[half], from.batches[half]);
  }
  for (int extra = 0; extra < kExtraCount; ++extra) {
    to.extra[extra] += from.extra[extra];
  }
}

void addFilm(Film& to, const Film& from) {
  const std::size_t width = to.window().extent().x;
  const Window& window = from.window();
  const std::size_t fromWidth = window.extent().x;
  for (std::size_t i = 0; i < from.pixels().size(); ++i) {
    const std::size_t x = window.min.x - to.window().min.x + i % fromWidth;
    const std::size_t y = window.min.y - to.window().min.y + i / fromWidth;
    PixelState& target = to.pixels()[y * width + x];
    if (target.samples[0] == 0 && target.samples[1] == 0) {
      target = from.pixels()[i];  // copied, not added to zero: keeps the sign of -0.0
    } else {
      addState(target, from.pixels()[i]);
    }
  }
}

} // namespace

Film merge(const std::vector<NamedFilm>& films) {
  if (films.empty()) {
    fail("nothing to merge; name the parts");
  }
  std::vector<Part> parts;
  for (const NamedFilm& film : films) {
    metadataOf(film, kSceneHashKey);
    parts.push_back(partOf(film));
  }
  // Sums are rounded: a fixed order makes the result independent of the order of the arguments.
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.blocks < b.blocks; });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      checkPair(parts[j], parts[i]);
    }
  }
  const Window all = unionOf(parts);
  checkCovered(parts, all);
  Film merged(parts.front().source->second.imageSize(), all);
  for (const Part& part : parts) {
    addFilm(merged, part.source->second);
    merged.independentHalves |= part.source->second.independentHalves;
  }
  merged.metadata = joinedMetadata(parts);
  return merged;
}

std::uint64_t countOf(const Metadata& metadata, const std::string& name) {
  const auto entry = metadata.find(kCountPrefix + name);
  return entry == metadata.end() ? 0 : std::stoull(entry->second);
}

} // namespace tyndall::film

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"

#include <utility>

namespace tyndall::film {

/// Metadata keys that merging reads.
inline constexpr const char* kSceneHashKey = "scene.hash";
inline constexpr const char* kDeviceKey = "device";
inline constexpr const char* kSeedKey = "seed";
inline constexpr const char* kFirstSampleKey = "samples.first";
inline constexpr const char* kEndSampleKey = "samples.end";    ///< one past the last
inline constexpr const char* kPartsKey = "merge.parts";        ///< what a merged film is made of
/// Keys that begin so are whole numbers that add up over the parts, e.g. "count.nonFinite".
inline constexpr const char* kCountPrefix = "count.";
/// The count "count.<name>"; 0 if it is not there.
std::uint64_t countOf(const Metadata& metadata, const std::string& name);

/// Which samples a film holds. Equal samples of a pixel are those of equal seed and index.
struct Provenance {
  std::string sceneHash;
  std::string device;
  std::uint32_t seed = 0;
  std::uint32_t firstSample = 0;
  std::uint32_t endSample = 0;
};
void setProvenance(Film& film, const Provenance& provenance);

/// Joins films of one scene: crops, seeds, sample ranges, machines, in any mixture and order; the order has no say in
/// the result. Sums are added, so that crops of one render give the whole bit for bit. Films that were merged before
/// can be merged on. Other metadata that differs is joined with "; ".
/// @param parts name (for messages) and film, at least one.
/// @throws Error if scenes or picture sizes differ, a pixel would get the same samples twice, the provenance is
/// missing, or the windows leave holes in the rectangle around them.
Film merge(const std::vector<std::pair<std::string, Film>>& parts);

} // namespace tyndall::film

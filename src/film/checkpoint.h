// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace tyndall::film {

/// The film bit for bit, in an OpenEXR whose integer channels are the halves of the doubles. Uncompressed, because sums
/// do not pack and saving must be quick: 208 bytes a pixel. `extra` is added to the film's own metadata; its values
/// win. The file appears whole or not at all. @throws Error if it cannot be written.
/// @param companion what belongs to the film, such as what guides its paths; empty: nothing. It goes into a file of its
/// own beside the checkpoint, which names it. That file is written first, under the hash of its bytes, and the one of
/// the checkpoint before is deleted last: whenever the program ends, a checkpoint's own companion is there.
void saveCheckpoint(const std::filesystem::path& path, const Film& film, const Metadata& extra = {},
                    std::span<const std::byte> companion = {});

/// The companion that a checkpoint names; empty: none. @throws Error if it is missing or damaged.
std::vector<std::byte> loadCompanion(const std::filesystem::path& path);

/// Deletes the checkpoint, then its companions.
void removeCheckpoint(const std::filesystem::path& path);

/// Whether the file says that it is a checkpoint; false for any other file, also one that is not OpenEXR.
bool isCheckpoint(const std::filesystem::path& path);

/// @throws Error if the file is not a checkpoint, is of another version, or differs in one bit from what was saved.
Film loadCheckpoint(const std::filesystem::path& path);

} // namespace tyndall::film

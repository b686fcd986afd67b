// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"

#include <filesystem>

namespace tyndall::film {

/// The film bit for bit, in an OpenEXR whose integer channels are the halves of the doubles. Uncompressed, because sums
/// do not pack and saving must be quick: 208 bytes a pixel. `extra` is added to the film's own metadata; its values
/// win. The file appears whole or not at all. @throws Error if it cannot be written.
void saveCheckpoint(const std::filesystem::path& path, const Film& film, const Metadata& extra = {});

/// Whether the file says that it is a checkpoint; false for any other file, also one that is not OpenEXR.
bool isCheckpoint(const std::filesystem::path& path);

/// @throws Error if the file is not a checkpoint, is of another version, or differs in one bit from what was saved.
Film loadCheckpoint(const std::filesystem::path& path);

} // namespace tyndall::film

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace tyndall {

/// The whole file as text. @throws Error if it cannot be read or is a folder.
std::string readTextFile(const std::filesystem::path& path);

/// Writes through `write(temporary)` beside `path`, then renames: `path` is the old file or the new one, never a part.
/// The temporary is removed when `write` throws. @throws Error if the folder is missing or not writable.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write);

/// @throws Error with the fix if a file cannot be created at `path`; leaves nothing behind. Call it before long work.
void checkWritable(const std::filesystem::path& path);

/// 64-bit FNV-1a of a file's bytes. @throws Error if it cannot be read.
std::uint64_t hashFile(const std::filesystem::path& path);

/// 64-bit FNV-1a of a text.
std::uint64_t hashText(const std::string& text);

} // namespace tyndall

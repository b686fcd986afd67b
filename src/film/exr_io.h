// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "film/film.h"

#include <ImfHeader.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <new>

/// What the picture and the checkpoint share of OpenEXR. Internal to film: nobody else sees OpenEXR's headers.
namespace tyndall::film {

/// Header with the windows, Rec.709 chromaticities and metadata; rows from the top.
Imf::Header makeHeader(const glm::uvec2& displaySize, const Window& window, const Metadata& metadata);

Metadata readMetadata(const Imf::Header& header);

/// Writes through `write(stream, name)` into a temporary that is flushed, checked and renamed.
/// @throws Error naming `path` if anything fails, disk full included.
void writeExrAtomically(const std::filesystem::path& path,
                        const std::function<void(std::ofstream& stream, const std::string& name)>& write);

/// @throws Error if there is no readable, non-empty file with OpenEXR's first four bytes.
void checkIsExr(const std::filesystem::path& path);

/// Pixels a side that a file may have.
inline constexpr int kLargestExtent = 1 << 18;

/// Calls `read()`; what OpenEXR throws becomes an Error that names `path`. Errors pass through.
template <class Read>
auto readingExr(const std::filesystem::path& path, Read read) {
  // OpenEXR allocates its line table from the header before we see it; a damaged one may claim two billion rows.
  Imf::Header::setMaxImageSize(kLargestExtent, kLargestExtent);
  try {
    return read();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail("{}: too large for this machine's memory, or damaged; write the file again", path.string());
  } catch (const std::exception& exception) {
    fail("{}: damaged or not readable as OpenEXR ({}); write the file again", path.string(), exception.what());
  }
}

} // namespace tyndall::film

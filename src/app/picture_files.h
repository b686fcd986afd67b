// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/picture.h"
#include "film/png.h"

#include <filesystem>

namespace tyndall::app {

/// How a film becomes an EXR and a PNG: what `render` takes from the scene and `merge` from the parts' headers.
struct PictureSettings {
  bool transparent = false;      ///< film::PictureOptions::transparent
  bool opaqueBackground = false; ///< film::PictureOptions::opaqueBackground
  std::vector<std::string> aovs;
  film::PngOptions png;
};

/// Written into the film's metadata under "picture." keys, so that merged parts give the picture that a whole render
/// would.
void noteSettings(const PictureSettings& settings, film::Metadata& metadata);

/// What noteSettings wrote; defaults where a key is missing. Of values that merging has joined, the first one.
PictureSettings settingsOf(const film::Metadata& metadata);

struct PictureFiles {
  std::filesystem::path exr;
  std::filesystem::path png; ///< beside the EXR, with its stem
  film::PngReport report;
};

/// @param layers channels that the film knows nothing of. @throws Error if a file cannot be written.
PictureFiles writePicture(const std::filesystem::path& exr, const film::Film& film, const PictureSettings& settings,
                          const std::map<std::string, std::vector<float>>& layers = {});

} // namespace tyndall::app

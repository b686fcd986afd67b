// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tyndall::scene {

/// One thing wrong (or doubtful) in a scene file.
struct Problem {
  SourceLocation location;
  std::string message; ///< what is wrong and the fix
  bool warning = false;
};

struct LoadResult {
  Scene scene;                   ///< meaningful only if ok()
  std::vector<Problem> problems; ///< all of them, in file order
  std::string canonical;         ///< the scene with every default written out: what hashes and metadata use
  bool ok() const;
};

/// A change made on the command line: --set film.size=[320,240], media.0.density_scale=2, lights.sun.irradiance=3.
/// A list element is named by its number or its "name".
struct Override {
  std::string path;
  std::string value; ///< JSON; a bare word is taken as a string
};

/// The frame that a scene is read at where none is asked for.
inline constexpr double kFirstFrame = 1.0;

/// Parses and validates; collects every problem instead of stopping at the first one.
/// File references are resolved against the scene file's folder (those of overrides against the working folder) and
/// checked to exist. Columns count characters. What moves stands where it is at `frame`, unless an override changes it.
LoadResult readScene(const std::filesystem::path& path, const std::vector<Override>& overrides = {},
                     double frame = kFirstFrame);

/// As readScene, from text; `name` stands in messages, `folder` resolves file references.
LoadResult parseScene(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                      const std::vector<Override>& overrides = {}, double frame = kFirstFrame);

/// Frames at which a track has a key, ascending.
std::vector<double> keyFrames(const Animation& animation);

/// readScene, or @throws Error whose text lists every problem, one per line.
Scene loadScene(const std::filesystem::path& path, const std::vector<Override>& overrides = {});

/// The scene as JSON that loads back to the same values; every key that applies is written, numbers to the last bit.
/// File names are written relative to `folder`, where the text will stand; if that is empty, as the scene has them,
/// which is right for a file in the working folder. Tracks are written too, and what they move as the file had it.
std::string toJson(const Scene& scene, const std::filesystem::path& folder = {});

} // namespace tyndall::scene

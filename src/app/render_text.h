// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "base/file.h"
#include "film/tone.h"
#include "scene/scene.h"

#include <chrono>
#include <fstream>

/// Small things that the render command's files share.
namespace tyndall::app {

/// Seconds since it was made.
class Stopwatch {
public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The file appears whole or not at all. @throws Error
inline void writeText(const std::filesystem::path& path, const std::string& text) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    if (!(stream << text) || !stream.flush()) {
      fail("{}: cannot be written; is the disk full?", path.string());
    }
  });
}

inline film::View filmView(scene::View view) {
  return view == scene::View::Filmic ? film::View::Filmic : film::View::Standard;
}

} // namespace tyndall::app

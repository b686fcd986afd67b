// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tyndall::volume {

/// Frames [first, last], both counted.
struct FrameRange {
  int first = 1;
  int last = 1;
  int count() const { return last - first + 1; }
};

/// "7" or "1-48". @throws Error if the text is neither, the range is backwards or has more than a million frames.
FrameRange parseFrames(const std::string& text);

/// True if a file name has a frame placeholder: "%d", "%06d", or one or more "#".
bool isSequence(const std::string& pattern);

/// The file of one frame: "smoke_%06d.vdb" and "smoke_######.vdb" both give "smoke_000007.vdb" for frame 7; "%%" is a
/// percent sign. @throws Error if the pattern has no placeholder, several, or one of another kind.
std::filesystem::path frameFile(const std::string& pattern, int frame);

/// The files of all frames, in order. @throws Error that names the missing frames if a file is not there.
std::vector<std::filesystem::path> expandSequence(const std::string& pattern, const FrameRange& frames);

} // namespace tyndall::volume

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tyndall::app {

/// The numbers of a sequence's frames that lie in its folder, ascending.
/// @param pattern as for volume::frameFile. @throws Error if it is not such a pattern.
std::vector<int> framesPresent(const std::string& pattern);

/// `file`, or the first frame that is there if it is the pattern of a sequence. @throws Error if none is there.
std::filesystem::path firstFile(const std::string& file);

/// What is wrong in one frame of a scene that moves.
std::string inFrame(double frame, const std::string& message);

} // namespace tyndall::app

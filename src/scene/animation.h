// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/findings.h"
#include "scene/load.h"

#include <filesystem>
#include <vector>

namespace tyndall::scene {

/// Puts what the document's tracks move to its place at a frame. A track whose target overlaps with the path of an
/// override is off: the command line has the last word. Mistakes in the section itself are left to readRoot.
/// @return the animation as a scene keeps it: the tracks that are on, and file names resolved against `folder`.
Animation animate(json::Value& root, const std::vector<Override>& overrides, double frame,
                  const std::filesystem::path& folder, Findings& findings);

} // namespace tyndall::scene

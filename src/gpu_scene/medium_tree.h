// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/media.h"

#include <vector>

namespace tyndall::gpu_scene {

/// With fewer grid media a ray asks each of them in turn.
inline constexpr std::size_t kMediumTreeFrom = 8;

/// A tree of boxes over the media with density grids, depth first (interop::MediumNode), split at the middle of the
/// widest axis. Boxes are wider than the grids by more than device arithmetic is off.
std::vector<interop::MediumNode> mediumTree(const PackedMedia& media);

} // namespace tyndall::gpu_scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "guide/store.h"
#include "scene/scene.h"

#include <span>
#include <vector>

namespace tyndall::render {

/// Two cameras of a picture of `size` pixels, one frame apart.
struct CameraMove {
  scene::Camera before;
  scene::Camera now;
  glm::uvec2 size;
};

/// Distance chains that the frame before has left, at the vertices that see the same places now, as far away as they
/// are from there; (107) of docs/theory.md. @param width between vertices [pixels]
std::vector<interop::DistanceState> movedDistances(std::span<const interop::DistanceState> states,
                                                   const guide::StoreSize& size, double width, const CameraMove& move);

/// Moves those of a store, if it has any and the cameras differ.
void moveDistances(guide::Store& store, const scene::GuideSettings& settings, const CameraMove& move);

} // namespace tyndall::render

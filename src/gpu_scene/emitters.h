// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/media.h"
#include "gpu_scene/surfaces.h"
#include "interop/emitters.h"

#include <vector>

namespace tyndall::gpu_scene {

/// Lights that have a place: those of the surfaces first, in their order, then points and spots, then emissive media.
struct PackedEmitters {
  std::vector<interop::Emitter> emitters;
  std::vector<interop::LightTreeNode> nodes;
  bool volumes = false; ///< emissive media are among them
  bool small = false;   ///< points, spots or small spheres are among them
};

/// Writes Medium::emitter of the media that become lights.
/// @param bounds of the scene; device coordinates are relative to their centre.
PackedEmitters packEmitters(const scene::Scene& scene, const PackedSurfaces& surfaces, PackedMedia& media,
                            const Bounds3& bounds);

} // namespace tyndall::gpu_scene

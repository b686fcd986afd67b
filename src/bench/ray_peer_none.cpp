// SPDX-License-Identifier: Apache-2.0
// In place of ray_peer_embree.cpp where Embree is not installed.
#include "bench/ray_scenes.h"

namespace tyndall::bench {

std::optional<RayCaster> embreeCaster(const RayScene&) { return std::nullopt; }

} // namespace tyndall::bench

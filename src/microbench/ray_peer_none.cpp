// SPDX-License-Identifier: Apache-2.0
// In place of ray_peer_embree.cpp where Embree is not installed.
#include "microbench/ray_peer.h"

namespace tyndall::microbench {

std::optional<RayCaster> embreeCaster(const RayScene&) { return std::nullopt; }

} // namespace tyndall::microbench

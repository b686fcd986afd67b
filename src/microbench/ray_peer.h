// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/ray_scenes.h"
#include "microbench/measure.h"
#include "passes/bench/ray_cast_io.h"

#include <functional>
#include <optional>
#include <span>

namespace tyndall::microbench {

/// Casts rays one by one: distances, tMax for a miss; any hit: 0 where something is in the way.
using RayCaster = std::function<void(std::span<const interop::BenchRay> rays, bool anyHit, std::span<float> distances)>;

/// Embree's rtcIntersect1 and rtcOccluded1; nothing where the program was built without it.
std::optional<RayCaster> embreeCaster(const RayScene& scene);

} // namespace tyndall::microbench

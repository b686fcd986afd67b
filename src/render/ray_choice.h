// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"

#include <functional>
#include <string>

namespace tyndall::render {

/// What casts rays through surfaces.
enum class RayCaster {
  Auto, ///< the faster one, as timed
  Tree, ///< our own tree
  Query ///< the device's ray queries
};

struct RayChoice {
  bool query = false;
  std::string reason; ///< for the statistics: what, and why
};

/// Seconds that a probe of the scene's rays takes, by ray queries or by our own tree.
using RayTimer = std::function<double(bool query)>;

/// @param time called only where there is a choice: surfaces, a device with ray queries, and no CPU. On one, a query is
/// 2 to 8 times slower than our tree (lavapipe), and compiling the second module takes longer than it could gain.
/// @throws Error if queries are asked for and cannot serve, with the reason and what to do.
RayChoice chooseRays(RayCaster wanted, const gpu::Device& device, const gpu_scene::GpuScene& scene,
                     const RayTimer& time);

/// The faster one, each timed some times after a first one that does not count: it compiles.
RayChoice fasterRays(const RayTimer& time);

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bare_rates.h"
#include "bench/cost.h"
#include "bench/ray_scenes.h"
#include "gpu_scene/gpu_scene.h"

namespace tyndall::bench {

enum class Clock { Wall, Device }; ///< Device: process time on a CPU device, else wall time

/// What the parts of an estimator reach when nothing else is done. Per second.
struct RayRates {
  double primary = 0.0; ///< camera rays, closest hit
  double diffuse = 0.0; ///< cosine-distributed from where those hit
  double shadow = 0.0;  ///< from there to the light, any hit
};
/// @param size camera rays are those of size x size pixels. @param repeats after a first time that compiles; medians.
RayRates rayRates(const gpu::Device& device, const RayScene& scene, std::uint32_t size, std::uint32_t repeats,
                  Clock clock);

/// Density lookups per second along camera rays, by both clocks. @param meanStep voxels between them.
Cost bareLookups(const gpu::Device& device, const gpu_scene::GpuScene& gpuScene, std::uint32_t size,
                 std::uint32_t repeats, double meanStep);

/// Both, in scenes of their own.
BareRates measureBareRates(const gpu::Device& device);

} // namespace tyndall::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microbench/commands.h"
#include "microbench/measure.h"
#include "microbench/ray_scenes.h"
#include "gpu_scene/gpu_scene.h"

namespace tyndall::microbench {

/// What the parts of an estimator reach when nothing else is done. Per second; of process time on a CPU device.
struct RayRates {
  double primary = 0.0; ///< camera rays, closest hit
  double diffuse = 0.0; ///< cosine-distributed from where those hit
  double shadow = 0.0;  ///< from there to the light, any hit
};
RayRates rayRates(const Session& session, const RayScene& scene);

/// Density lookups per second along camera rays, by both clocks. @param meanStep voxels between them.
Cost bareLookups(const gpu::Device& device, const gpu_scene::GpuScene& gpuScene, const Options& options,
                 double meanStep);

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"
#include "render/tracer.h"
#include "scene/scene.h"

namespace tyndall::app {

/// Stops for the scene's picture, rounded to a tenth, from a few samples of one pixel in every small square: some
/// 10^4 pixels whatever the size. The same scene gives the same number.
double chooseExposure(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                      const gpu_scene::GpuScene& gpuScene, const render::EstimatorOptions& options);

} // namespace tyndall::app

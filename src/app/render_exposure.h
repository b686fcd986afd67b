// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"
#include "render/tracer.h"
#include "scene/scene.h"

namespace tyndall::app {

/// Stops for the scene's picture, rounded to a tenth, from a few samples of one pixel in every small square: some
/// 10^4 pixels whatever the size. The same scene and estimator give the same number.
/// @param estimator of `method`, made for the scene; its totals count the samples.
double chooseExposure(const scene::Scene& scene, render::Estimator& estimator, render::Method method);

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/render_source.h"
#include "app/render_statistics.h"
#include "gpu_scene/gpu_scene.h"
#include "render/choose.h"

#include <atomic>
#include <memory>

namespace tyndall::app {

/// One picture's scene in device memory. Stays where it was made: the estimator borrows from it.
struct Prepared {
  scene::Scene scene;
  gpu_scene::VolumeSet volumes;
  render::MethodChoice choice;
  std::optional<render::GuidePlan> guide;
  std::unique_ptr<gpu_scene::GpuScene> gpuScene;
  std::unique_ptr<render::Estimator> estimator; ///< the exposure's and the picture's
  Timings timings;
};

/// What all pictures of a request share.
struct PictureContext {
  const RenderRequest& request;
  const gpu::Device& device;
  const std::atomic<bool>& interrupted;
  Say say;
};

/// What ends a picture.
render::StopRule stopRule(const RenderRequest& request, const scene::Scene& scene);

render::EstimatorOptions estimatorOptions(const RenderRequest& request, const Prepared& prepared);

/// Renders one picture, writes its files and says what came out.
/// @return exit code: 0, 1 if the picture is unsound (samples that were not finite, a majorant exceeded, rays cut
/// short), 130 if it was interrupted. @throws Error if a file cannot be written or a checkpoint does not fit.
int renderPicture(const PictureContext& context, const Prepared& prepared, const OutputFiles& files);

} // namespace tyndall::app

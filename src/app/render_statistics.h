// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/render_request.h"
#include "app/surface_counts.h"
#include "film/film.h"
#include "film/png.h"
#include "gpu/device.h"
#include "gpu_scene/volumes.h"
#include "render/choose.h"
#include "render/renderer.h"

namespace tyndall::app {

/// Seconds of the stages of one picture.
struct Timings {
  double start = 0.0; ///< device, driver
  double load = 0.0;  ///< scene and volumes, framing
  double upload = 0.0;
  double exposure = 0.0;  ///< the preview that chooses it
  double estimator = 0.0; ///< its pipeline and light caches
  double write = 0.0;
};

/// Everything known about a picture. Borrows for a call.
struct RenderRecord {
  const RenderRequest& request;
  const scene::Scene& scene;
  const gpu_scene::VolumeSet& volumes;
  const gpu::Device& device;
  const render::RenderReport& report;
  const render::MethodChoice& choice;
  SurfaceCounts surfaces; ///< as they were uploaded; all 0 without the estimator path
  film::ErrorEstimate error;
  film::PngReport png;
  double plannedBytes =
      0.0; ///< on the device, for grids, surfaces, light caches and the estimator, as they were chosen
  Timings timings;
  std::vector<std::string> notes;
};

/// The record as JSON; every key of a quantity ends in its unit. Infinite numbers become null.
std::string statisticsJson(const RenderRecord& record, const film::Metadata& metadata);

/// Flat keys for the EXR's header. The counts are those of this run plus `earlier` (of a resumed film).
film::Metadata pictureMetadata(const RenderRecord& record);

} // namespace tyndall::app

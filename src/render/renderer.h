// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"
#include "gpu_scene/gpu_scene.h"
#include "render/estimator.h"
#include "render/schedule.h"
#include "scene/scene.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// The only place that knows the whole chain: scene -> device -> passes -> film.
namespace tyndall::render {

/// What a progress line shows.
struct Progress {
  double fraction = 0.0;        ///< of the work until the sample limit or the time limit, [0, 1]
  std::uint64_t samples = 0;    ///< taken so far, over all pixels
  double samplesPerPixel = 0.0; ///< mean over the pixels that see media
  double seconds = 0.0;
  double error = 0.0; ///< estimated rRMSE; infinity while unknown
  std::uint64_t nonFinite = 0;
};

struct RenderOptions {
  film::Window crop; ///< empty: the whole image
  StopRule stop;
  std::uint32_t seed = 0;
  EstimatorOptions estimator;       ///< of the one that renderFilm makes; not read where one is handed over
  double secondsBefore = 0.0;       ///< spent on making the estimator that is handed over; counts as rendering
  std::filesystem::path checkpoint; ///< empty: none are written; the last one when interrupted or resuming
  double checkpointSeconds = 20.0;
  bool moments = false;  ///< RenderReport::sampleSquares is wanted; each sample is a dispatch of its own
  bool resume = false;   ///< go on from `checkpoint` if it is there
  std::string sceneHash; ///< what a checkpoint must agree with
  std::function<void(const Progress&)> progress;
  const std::atomic<bool>* interrupted = nullptr;
};

struct RenderReport {
  Totals totals;
  std::map<std::string, std::string> pipeline; ///< what was left out of it
  CacheReport caches;
  std::optional<GuideReport> guide; ///< where directions were guided
  std::optional<double> guideGain;  ///< Estimator::guideGain
  std::size_t kernelBytes = 0;
  std::size_t mediaPixels = 0;       ///< pixels that may see a medium
  std::size_t backgroundPixels = 0;  ///< finished by the first passes
  double firstDispatchSeconds = 0.0; ///< compilation and the first chunk
  double seconds = 0.0;
  /// Of each pixel of the film, the sum over its samples of their squared luminance, the film's background included.
  /// Empty unless asked for. Those of a checkpoint that was gone on from are not in it.
  std::vector<double> sampleSquares;
  std::string stoppedBy; ///< "samples", "time", "error" or "interrupt"
};

/// Renders until the rule says stop. With a checkpoint the result is bit-identical to an uninterrupted render (a
/// picture of a sample count that is not a multiple of 16 can be extended, but not to the same bits).
/// @throws Error if the checkpoint belongs to another scene, size or seed.
film::Film renderFilm(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                      const gpu_scene::GpuScene& gpuScene, const RenderOptions& options, RenderReport& report);

/// The same with an estimator that was made before; the report's totals and seconds are those of this film.
film::Film renderFilm(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                      Estimator& estimator, const RenderOptions& options, RenderReport& report);

} // namespace tyndall::render

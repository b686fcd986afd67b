// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/scenes.h"
#include "bench/variance.h"
#include "film/film.h"
#include "microbench/measure.h"
#include "render/estimator.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tyndall::microbench {

/// Building a scene's light caches alone, memory and pipelines apart.
struct CacheBuild {
  Cost cost;
  double bytes = 0.0;
  std::uint32_t count = 0;
  std::uint32_t dropped = 0;
  double spacing = 0.0; ///< voxels between nodes of the first cache; 0 without and for skies
};
/// Those of a sky are made anew for every batch, planning and memory included, and a pass's time holds them already.
/// @param gpuScene uploaded as cells. Built `repeats` times after a first time that compiles; medians.
CacheBuild buildCaches(const gpu::Device& device, const gpu_scene::GpuScene& gpuScene,
                       const gpu_scene::VolumeSet& volumes, double cacheBytes, std::uint32_t repeats);

/// The pixels that may see a medium, less those close to a point light.
std::vector<std::uint32_t> measuredPixels(const BenchScene& scene);

/// What the passes of one sample count gave.
struct Passes {
  Pictures pictures;                 ///< luminance of light from the media, mean over the samples of a pass
  std::vector<double> transmittance; ///< mean over all passes
  std::vector<double> seconds;       ///< of each pass
  render::Totals spent;              ///< over all passes
};

/// Those of the pixels that the conventions' measures of error count: 1 - T > 0.01. As indices into the pictures.
std::vector<std::size_t> coveredPixels(const Passes& passes);

/// One estimator on one scene, ready to run.
class Contender {
public:
  /// Borrows everything. `gpuScene` has the layout of the options' method.
  Contender(std::string name, const gpu::Device& device, const BenchScene& scene, const gpu_scene::GpuScene& gpuScene,
            const render::EstimatorOptions& options);

  /// Takes the first `samples` <= 16 samples of a batch in every pixel. Kept in passes(samples), unless it is a
  /// warm-up.
  void run(const std::vector<std::uint32_t>& pixels, std::uint32_t samples, std::uint32_t seed, bool warmUp);

  const std::string& name() const { return name_; }
  const render::EstimatorOptions& options() const { return options_; }
  const Passes& passes(std::uint32_t samples) const { return passes_.at(samples); }

private:
  std::string name_;
  render::EstimatorOptions options_;
  const gpu::Device* device_;
  std::unique_ptr<render::Estimator> estimator_;
  std::map<std::uint32_t, Passes> passes_;
};

} // namespace tyndall::microbench

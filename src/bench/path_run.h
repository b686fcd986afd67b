// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/cost.h"
#include "gpu/kernel.h"
#include "gpu_scene/gpu_scene.h"
#include "passes/path/path_pass.h"
#include "render/batch_runner.h"

#include <span>
#include <vector>

namespace tyndall::bench {

/// The module of pass `path`, as the renderer has it.
std::span<const std::uint32_t> pathModule();
std::vector<gpu::SpecEntry> pathSpecEntries(const passes::PathSpec& spec);

/// What the passes of one pipeline gave; counters are summed over them.
struct PathFigures {
  std::vector<std::vector<double>> pictures; ///< luminance, background included, mean over a pass's samples
  std::vector<double> seconds;               ///< of each pass
  double samples = 0.0;
  double segments = 0.0;
  double lookups = 0.0;
  double events = 0.0;

  double totalSeconds() const;
};

/// Pass `path` with any specialization, or a module in which nothing is left to specialize. Borrows the scene.
class PathRun {
public:
  PathRun(const gpu::Device& device, const gpu_scene::GpuScene& scene, std::span<const std::uint32_t> module,
          std::span<const gpu::SpecEntry> spec, const std::vector<std::uint32_t>& pixels);

  /// Process time [s] of making the pipeline and of its first dispatch, of one sample of 64 pixels: what the driver
  /// compiles. Wall time on devices that are no CPU.
  double compileSeconds() const { return compileSeconds_; }
  /// Takes the first `samples` <= 16 samples of a batch in every pixel. Kept in figures(), unless it is a warm-up.
  void run(std::uint32_t samples, std::uint32_t seed, bool warmUp);
  const PathFigures& figures() const { return figures_; }

private:
  /// Any kernel with the inputs of pass `path`.
  struct Pass {
    gpu::Kernel kernel;
    void run(const interop::PathInputs& inputs) const { kernel.run(inputs, inputs.count); }
  };

  std::span<const interop::PixelSums> take(std::size_t count, std::uint32_t samples, std::uint32_t seed);

  const gpu::Device* device_;
  const gpu_scene::GpuScene* scene_;
  std::vector<std::uint32_t> pixels_;
  Cost creation_; // of the kernel, which is made next
  Pass pass_;
  render::BatchRunner<Pass, interop::PathInputs, interop::PathState, interop::PathCounters> runner_;
  double compileSeconds_ = 0.0;
  PathFigures figures_;
  PathFigures last_; // counters of the pass in hand
};

} // namespace tyndall::bench

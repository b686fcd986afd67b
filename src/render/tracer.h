// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/trace/trace_pass.h"
#include "render/batch_runner.h"

namespace tyndall::render {

/// Specialization of the trace pass for a scene: what it does not use has no code.
passes::TraceSpec traceSpecFor(const gpu_scene::Features& features, const EstimatorOptions& options);

/// Null-collision tracking.
class Tracer final : public Estimator {
public:
  Tracer(const gpu::Device& device, const gpu_scene::GpuScene& scene, const EstimatorOptions& options);

  std::span<const interop::PixelSums> run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                          std::uint32_t seed) override;
  std::uint32_t chunkPixels() const override { return runner_.chunkPixels(); }
  std::size_t kernelBytes() const override { return pass_.kernel().spirvBytes(); }
  std::map<std::string, std::string> pipeline() const override;

private:
  void collect(const interop::TraceCounters& counters);

  const gpu_scene::GpuScene& scene_;
  passes::TraceSpec spec_;
  passes::TracePass pass_;
  BatchRunner<passes::TracePass, interop::TraceInputs, interop::TraceState, interop::TraceCounters> runner_;
};

} // namespace tyndall::render

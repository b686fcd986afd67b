// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"
#include "gpu_scene/gpu_scene.h"
#include "passes/trace/trace_pass.h"

#include <cstdint>
#include <span>

namespace tyndall::render {

struct TracerOptions {
  bool aovs = false;
  bool deltaTracking = false;    ///< distances by delta tracking even where the weighted walk would serve
  std::uint32_t chunkPixels = 0; ///< pixels of one dispatch; 0 = by the device's kind
  std::uint32_t stepBound = 0;   ///< steps of one invocation in one dispatch; 0 = by the device's kind
  std::uint32_t plantedBug = 0;  ///< tests only: interop::kBug*
};

/// Counters over all dispatches so far.
struct TraceTotals {
  std::uint64_t lookups = 0;
  std::uint64_t segments = 0;
  std::uint64_t samples = 0;
  std::uint64_t resumed = 0; ///< invocations that reached the step bound and went on in a next dispatch
  std::uint64_t nonFinite = 0;
  std::uint64_t negative = 0;
  std::uint64_t majorantExceeded = 0;
  std::uint64_t dispatches = 0;
};

/// A run of consecutive samples of one batch, the same for every pixel of a call.
struct SampleRange {
  std::uint32_t first = 0; ///< index within the pixel
  std::uint32_t count = 0; ///< 1 .. kBatchSamples, not beyond the batch's end
};

/// Specialization of the trace pass for a scene: what it does not use has no code.
passes::TraceSpec traceSpecFor(const gpu_scene::Features& features, const TracerOptions& options);

/// Runs batches of samples on the device. Borrows the device and the scene.
class Tracer {
public:
  Tracer(const gpu::Device& device, const gpu_scene::GpuScene& scene, const TracerOptions& options);

  /// @param pixels x | y << 16, absolute; at most chunkPixels(). @return one entry per pixel, valid until the next
  /// call.
  std::span<const interop::PixelSums> run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                          std::uint32_t seed);

  std::uint32_t chunkPixels() const { return static_cast<std::uint32_t>(pixels_.size()); }
  const TraceTotals& totals() const { return totals_; }
  const passes::TraceSpec& spec() const { return spec_; }
  std::size_t kernelBytes() const { return pass_.kernel().spirvBytes(); }
  /// Device bytes that a tracer with these options will allocate.
  static double plannedBytes(const gpu::Device& device, const TracerOptions& options);

private:
  void collect(const interop::TraceCounters& counters);

  const gpu_scene::GpuScene& scene_;
  std::uint32_t stepBound_;
  passes::TraceSpec spec_;
  passes::TracePass pass_;
  gpu::Buffer<std::uint32_t> pixels_;
  gpu::Buffer<interop::PixelSums> sums_;
  gpu::Buffer<interop::TraceState> suspended_[2];
  gpu::Buffer<interop::TraceCounters> counters_;
  TraceTotals totals_;
};

} // namespace tyndall::render

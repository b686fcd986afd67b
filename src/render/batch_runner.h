// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "gpu/buffer.h"
#include "interop/pixel_sums.h"
#include "render/estimator.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace tyndall::render {

/// Steps of one invocation in one dispatch where the options do not say.
std::uint32_t stepBoundFor(const gpu::Device& device, const EstimatorOptions& options);

/// Runs a pass whose invocations may stop at a step bound and go on in a next dispatch, until all are done.
/// Pass: its run(Inputs). Inputs, State, Counters: its interop structs, with the members named as in trace_io.h.
template <class Pass, class Inputs, class State, class Counters>
class BatchRunner {
public:
  BatchRunner(const gpu::Device& device, const EstimatorOptions& options)
      : stepBound_(stepBoundFor(device, options)), pixels_(device, chunkFor(device, options), gpu::Memory::Host),
        sums_(device, pixels_.size(), gpu::Memory::Host), counters_(device, 1, gpu::Memory::Host) {
    for (gpu::Buffer<State>& queue : suspended_) {
      queue = gpu::Buffer<State>(device, pixels_.size(), gpu::Memory::Device);
    }
  }

  std::uint32_t chunkPixels() const { return static_cast<std::uint32_t>(pixels_.size()); }

  /// @param inputs what the pass borrows: the scene, and what else is its own; the rest is filled in here.
  /// @param stageCost steps that a stage counts for. @param collect takes each dispatch's counters.
  /// @return one entry per pixel, valid until the next call.
  template <class Collect>
  std::span<const interop::PixelSums> run(const Pass& pass, Inputs inputs,
                                          std::span<const std::uint32_t> pixels, SampleRange samples,
                                          std::uint32_t seed, std::uint32_t stageCost, Collect collect) {
    TYNDALL_CHECK(pixels.size() <= pixels_.size() && samples.count > 0);
    pixels_.write(pixels);
    inputs.pixels = pixels_.ptr();
    inputs.sums = sums_.ptr();
    inputs.counters = counters_.ptr();
    inputs.count = static_cast<std::uint32_t>(pixels.size());
    inputs.firstSample = samples.first;
    inputs.sampleCount = samples.count;
    inputs.seed = seed;
    inputs.stageCost = stageCost;
    inputs.stepBound = std::max(stepBound_, 2 * stageCost);
    for (std::uint32_t round = 0; inputs.count > 0; ++round) {
      inputs.suspendedIn = suspended_[(round + 1) % 2].ptr();
      inputs.suspendedOut = suspended_[round % 2].ptr();
      inputs.resume = round > 0 ? 1 : 0;
      counters_.fillZero();
      pass.run(inputs);
      const Counters counters = counters_.mapped()[0];
      collect(counters);
      inputs.count = counters.suspended;
    }
    return sums_.mapped().subspan(0, pixels.size());
  }

private:
  std::uint32_t stepBound_;
  gpu::Buffer<std::uint32_t> pixels_;
  gpu::Buffer<interop::PixelSums> sums_;
  gpu::Buffer<State> suspended_[2];
  gpu::Buffer<Counters> counters_;
};

} // namespace tyndall::render

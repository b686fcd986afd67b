// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/march/march_pass.h"
#include "render/estimator.h"
#include "render/march_scene.h"

namespace tyndall::render {

/// Specialization of the march pass for a scene: what it does not use has no code.
passes::MarchSpec marchSpecFor(const gpu_scene::GpuScene& scene, const MarchPlan& plan,
                               const EstimatorOptions& options);

/// Exact march along camera rays with light caches.
class Marcher final : public Estimator {
public:
  Marcher(const gpu::Device& device, const gpu_scene::GpuScene& scene, const gpu_scene::VolumeSet& volumes,
          const EstimatorOptions& options);

  std::span<const interop::PixelSums> run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                          std::uint32_t seed) override;
  std::uint32_t chunkPixels() const override { return static_cast<std::uint32_t>(pixels_.size()); }
  std::size_t kernelBytes() const override { return pass_.kernel().spirvBytes(); }
  std::map<std::string, std::string> pipeline() const override;
  CacheReport caches() const override { return march_.caches(); }

private:
  void collect(const interop::MarchCounters& counters, std::uint64_t samples);

  const gpu_scene::GpuScene& scene_;
  std::uint32_t samplesPerDispatch_;
  MarchScene march_;
  passes::MarchSpec spec_;
  passes::MarchPass pass_;
  gpu::Buffer<std::uint32_t> pixels_;
  gpu::Buffer<interop::PixelSums> sums_;
  gpu::Buffer<interop::MarchCounters> counters_;
};

} // namespace tyndall::render

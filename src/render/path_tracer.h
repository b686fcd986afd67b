// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/ray_query.h"
#include "passes/path/path_pass.h"
#include "render/batch_runner.h"
#include "render/guide_watch.h"

namespace tyndall::render {

/// Specialization of the path pass for a scene: what it does not use has no code.
passes::PathSpec pathSpecFor(const gpu_scene::Features& features, const EstimatorOptions& options);

/// Paths through media and between surfaces.
class PathTracer final : public Estimator {
public:
  PathTracer(const gpu::Device& device, const gpu_scene::GpuScene& scene, const EstimatorOptions& options);

  std::span<const interop::PixelSums> run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                          std::uint32_t seed) override;
  std::uint32_t chunkPixels() const override { return runner_.chunkPixels(); }
  std::size_t kernelBytes() const override { return pass_->kernel().spirvBytes(); }
  std::map<std::string, std::string> pipeline() const override;
  const Guiding* guiding() const override;
  void resetTotals() override;
  std::span<const interop::GuideView> viewGuide(std::span<const std::uint32_t> pixels) override;
  std::optional<double> guideGain() const override;

private:
  void choosePass(const gpu::Device& device, RayCaster wanted);
  void makeQueryPass(const gpu::Device& device);
  double probeSeconds(const passes::PathPass& pass);
  std::uint32_t stageCost() const;
  interop::PathInputs inputs() const;
  void collect(const interop::PathCounters& counters);
  std::span<const interop::PixelSums> runWith(bool guided, std::span<const std::uint32_t> pixels, SampleRange samples,
                                              std::uint32_t seed);
  std::span<const interop::PixelSums> runRound(bool guided, std::span<const std::uint32_t> pixels, SampleRange samples,
                                               std::uint32_t seed);
  std::span<const interop::PixelSums> runTrial(std::span<const std::uint32_t> pixels, SampleRange samples,
                                               std::uint32_t seed);
  std::span<const interop::PixelSums> runPhase(std::span<const std::uint32_t> pixels, SampleRange samples,
                                               std::uint32_t seed);
  const passes::PathPass& plainPass();

  const gpu::Device& device_;
  const gpu_scene::GpuScene& scene_;
  passes::PathSpec spec_;
  std::optional<gpu_scene::RayQueryTree> rays_; ///< of the pass with ray queries
  std::unique_ptr<passes::PathPass> pass_;
  RayChoice rayChoice_;
  std::unique_ptr<Guiding> guiding_; ///< null: paths are not guided
  std::vector<interop::PixelSums> trialSums_;
  std::vector<interop::PixelSums> roundSums_;
  std::vector<interop::PixelSums> phaseSums_;
  std::unique_ptr<passes::PathPass> plain_; ///< without guiding, once it is wanted
  std::unique_ptr<passes::PathPass> view_;  ///< of the store, likewise
  gpu::Buffer<interop::GuideView> views_;
  BatchRunner<passes::PathPass, interop::PathInputs, interop::PathState, interop::PathCounters> runner_;
  GuideTrial trial_;
};

} // namespace tyndall::render

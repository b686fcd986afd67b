// SPDX-License-Identifier: Apache-2.0
#include "render/walk_probe.h"

#include "support/probe.h"

// Needs <cstdint> before it.
#include "kernels/walk_probe.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tyndall::test {
namespace {

std::vector<gpu::SpecEntry> entriesOf(const passes::TraceSpec& spec) {
  return {
#define SPEC(type, name, id, value) gpu::SpecEntry{id, gpu::specBits(spec.name)},
      TYNDALL_TRACE_SPEC(SPEC)
#undef SPEC
  };
}

SegmentEstimate summed(std::span<const interop::WalkResult> results, std::uint32_t walks) {
  SegmentEstimate estimate;
  double sum = 0.0;
  double squares = 0.0;
  for (const interop::WalkResult& result : results) {
    sum += double(result.transmittance);
    squares += double(result.transmittanceSquared);
    estimate.hits += result.hits;
  }
  estimate.walks = double(results.size()) * walks;
  estimate.transmittance = sum / estimate.walks;
  const double variance = std::max(0.0, squares / estimate.walks - estimate.transmittance * estimate.transmittance);
  estimate.standardError = std::sqrt(variance / (estimate.walks - 1.0));
  return estimate;
}

} // namespace

WalkProbe::WalkProbe(const TestScene& test, const render::EstimatorOptions& options)
    : scene_(std::make_unique<gpu_scene::GpuScene>(probeDevice(), test.scene, test.volumes)) {
  const passes::TraceSpec spec = render::traceSpecFor(scene_->features(), options);
  kernel_ = std::make_unique<gpu::Kernel>(probeDevice(), k_walk_probe_spirv, entriesOf(spec), scene_->images());
}

WalkReport WalkProbe::run(const std::vector<ProbeSegment>& segments, const WalkCountsWanted& wanted) const {
  std::vector<interop::WalkRay> rays;
  for (const ProbeSegment& segment : segments) {
    rays.push_back(
        {glm::vec3(segment.origin - scene_->centre()), glm::vec3(segment.direction), static_cast<float>(segment.tMax)});
  }
  const auto input = ProbeRunner::upload(rays);
  const std::size_t invocations = segments.size() * wanted.invocationsPerRay;
  const auto results = ProbeRunner::results<interop::WalkResult>(invocations);
  const auto distances = ProbeRunner::results<float>(wanted.distances ? invocations * wanted.walks : 1);
  interop::WalkInputs inputs{};
  inputs.scene = scene_->ptr();
  inputs.rays = input.ptr();
  inputs.results = results.ptr();
  inputs.distances = distances.ptr();
  inputs.rayCount = static_cast<std::uint32_t>(segments.size());
  inputs.invocationsPerRay = wanted.invocationsPerRay;
  inputs.walks = wanted.walks;
  inputs.mode = wanted.mode;
  inputs.seed = wanted.seed;
  inputs.writeDistances = wanted.distances ? 1 : 0;
  inputs.firstXi = wanted.firstXi;
  kernel_->run(inputs, static_cast<std::uint32_t>(invocations));
  WalkReport report;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    report.segments.push_back(
        summed(results.mapped().subspan(i * wanted.invocationsPerRay, wanted.invocationsPerRay), wanted.walks));
  }
  for (const interop::WalkResult& result : results.mapped()) {
    report.lookups += result.lookups;
    report.exceeded += result.exceeded;
  }
  if (wanted.distances) {
    report.distances = ProbeRunner::download(distances);
  }
  for (const std::string& message : probeDevice().messages()) {
    ADD_FAILURE() << "validation: " << message;
  }
  return report;
}

} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
#include "render/tracer.h"

#include "base/error.h"

#include <algorithm>

namespace tyndall::render {
namespace {

/// Well below what old Mesa cuts (65535 iterations), and on a GPU below what its watchdog allows.
constexpr std::uint32_t kStepsOnCpu = 16384;
constexpr std::uint32_t kStepsOnGpu = 2048;

std::uint32_t stepBoundFor(const gpu::Device& device, const EstimatorOptions& options) {
  if (options.stepBound > 0) {
    return options.stepBound;
  }
  return device.info().type == "cpu" ? kStepsOnCpu : kStepsOnGpu;
}

} // namespace

passes::TraceSpec traceSpecFor(const gpu_scene::Features& features, const EstimatorOptions& options) {
  passes::TraceSpec spec;
  spec.kPhaseMask = features.phaseMask;
  spec.kFormatMask = features.formatMask;
  spec.kHomogeneous = features.homogeneous;
  spec.kGrids = features.grids;
  spec.kGridEmission = features.gridEmission;
  spec.kPointLights = features.pointLights;
  spec.kDistantDeltas = features.distantDeltas;
  spec.kDistantAreas = features.distantAreas;
  spec.kOrthographic = features.orthographic;
  spec.kBackground = features.background;
  spec.kAovs = options.aovs;
  spec.kWeighted = !features.overlapOfGrids && !options.deltaTracking;
  spec.kMediumTree = features.mediumTree;
  spec.kPlantedBug = options.plantedBug;
  return spec;
}

Tracer::Tracer(const gpu::Device& device, const gpu_scene::GpuScene& scene, const EstimatorOptions& options)
    : scene_(scene), stepBound_(stepBoundFor(device, options)), spec_(traceSpecFor(scene.features(), options)),
      pass_(device, spec_, scene.images()), pixels_(device, chunkFor(device, options), gpu::Memory::Host),
      sums_(device, pixels_.size(), gpu::Memory::Host), counters_(device, 1, gpu::Memory::Host) {
  for (gpu::Buffer<interop::TraceState>& queue : suspended_) {
    queue = gpu::Buffer<interop::TraceState>(device, pixels_.size(), gpu::Memory::Device);
  }
}

std::map<std::string, std::string> Tracer::pipeline() const {
  std::map<std::string, std::string> result;
#define SPEC(type, name, id, value) result.insert(specText(#name, spec_.name));
  TYNDALL_TRACE_SPEC(SPEC)
#undef SPEC
  return result;
}

void Tracer::collect(const interop::TraceCounters& counters) {
  totals_.lookups += counters.lookups;
  totals_.segments += counters.segments;
  totals_.resumed += counters.suspended;
  totals_.nonFinite += counters.nonFinite;
  totals_.negative += counters.negative;
  totals_.majorantExceeded += counters.majorantExceeded;
  ++totals_.dispatches;
}

std::span<const interop::PixelSums> Tracer::run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                                std::uint32_t seed) {
  TYNDALL_CHECK(pixels.size() <= pixels_.size() && samples.count > 0);
  pixels_.write(pixels);
  interop::TraceInputs inputs{};
  inputs.scene = scene_.ptr();
  inputs.pixels = pixels_.ptr();
  inputs.sums = sums_.ptr();
  inputs.counters = counters_.ptr();
  inputs.count = static_cast<std::uint32_t>(pixels.size());
  inputs.firstSample = samples.first;
  inputs.sampleCount = samples.count;
  inputs.seed = seed;
  inputs.stageCost = 1 + scene_.loopCount();
  inputs.stepBound = std::max(stepBound_, 2 * inputs.stageCost);
  for (std::uint32_t round = 0; inputs.count > 0; ++round) {
    inputs.suspendedIn = suspended_[(round + 1) % 2].ptr();
    inputs.suspendedOut = suspended_[round % 2].ptr();
    inputs.resume = round > 0 ? 1 : 0;
    counters_.fillZero();
    pass_.run(inputs);
    const interop::TraceCounters counters = counters_.mapped()[0];
    collect(counters);
    inputs.count = counters.suspended;
  }
  totals_.samples += std::uint64_t(pixels.size()) * samples.count;
  return sums_.mapped().subspan(0, pixels.size());
}

} // namespace tyndall::render

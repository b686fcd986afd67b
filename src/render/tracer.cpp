// SPDX-License-Identifier: Apache-2.0
#include "render/tracer.h"

#include <algorithm>

namespace tyndall::render {
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
    : scene_(scene), spec_(traceSpecFor(scene.features(), options)), pass_(device, spec_, scene.images()),
      runner_(device, options) {}

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
  totals_.samples += std::uint64_t(pixels.size()) * samples.count;
  interop::TraceInputs inputs{};
  inputs.scene = scene_.ptr();
  return runner_.run(pass_, inputs, pixels, samples, seed, 1 + scene_.loopCount(),
                     [this](const interop::TraceCounters& counters) { collect(counters); });
}

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#include "render/path_tracer.h"

#include <algorithm>

namespace tyndall::render {
namespace {

/// What a ray through the surfaces counts for.
constexpr std::uint32_t kCastSteps = 16;

} // namespace

passes::PathSpec pathSpecFor(const gpu_scene::Features& features, const EstimatorOptions& options) {
  passes::PathSpec spec;
  spec.kPhaseMask = features.phaseMask;
  spec.kFormatMask = features.formatMask;
  spec.kHomogeneous = features.homogeneous;
  spec.kGrids = features.grids;
  spec.kGridEmission = features.gridEmission;
  spec.kHomogeneousEmission = features.homogeneousEmission;
  spec.kChromatic = features.chromatic;
  spec.kSurfaces = features.surfaces;
  spec.kMaterialMask = features.materialMask;
  spec.kTextures = features.textures;
  spec.kSpheres = features.spheres;
  spec.kInstances = features.instances;
  spec.kPassing = features.passing;
  spec.kInteriors = features.interiors;
  spec.kEmitters = features.emitters;
  spec.kEmissiveSurfaces = features.emissiveSurfaces;
  spec.kVolumeEmitters = features.volumeEmitters;
  spec.kDistantDeltas = features.distantDeltas;
  spec.kDistantAreas = features.distantAreas;
  spec.kOrthographic = features.orthographic;
  spec.kLens = features.lens;
  spec.kBackground = features.background;
  spec.kAovs = options.aovs;
  spec.kLightSelection = options.lightSelection;
  spec.kTechniques = options.techniques;
  spec.kMediumTree = features.mediumTree;
  spec.kPlantedBug = options.plantedBug;
  return spec;
}

PathTracer::PathTracer(const gpu::Device& device, const gpu_scene::GpuScene& scene, const EstimatorOptions& options)
    : scene_(scene), spec_(pathSpecFor(scene.features(), options)), pass_(device, spec_, scene.images()),
      runner_(device, options) {}

std::map<std::string, std::string> PathTracer::pipeline() const {
  std::map<std::string, std::string> result;
#define SPEC(type, name, id, value) result.insert(specText(#name, spec_.name));
  TYNDALL_PATH_SPEC(SPEC)
#undef SPEC
  return result;
}

void PathTracer::collect(const interop::PathCounters& counters) {
  totals_.lookups += counters.lookups;
  totals_.segments += counters.segments;
  totals_.resumed += counters.suspended;
  totals_.nonFinite += counters.nonFinite;
  totals_.negative += counters.negative;
  totals_.majorantExceeded += counters.majorantExceeded;
  totals_.events += counters.events;
  totals_.longest = std::max<std::uint64_t>(totals_.longest, counters.maxEvents);
  ++totals_.dispatches;
}

std::span<const interop::PixelSums> PathTracer::run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                                    std::uint32_t seed) {
  totals_.samples += std::uint64_t(pixels.size()) * samples.count;
  return runner_.run(pass_, scene_.ptr(), pixels, samples, seed, kCastSteps + scene_.loopCount(),
                     [this](const interop::PathCounters& counters) { collect(counters); });
}

} // namespace tyndall::render

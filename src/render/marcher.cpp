// SPDX-License-Identifier: Apache-2.0
#include "render/marcher.h"

#include "base/error.h"
#include "film/film.h"

#include <algorithm>

namespace tyndall::render {
namespace {

std::uint32_t samplesPerDispatch(const gpu_scene::PackedMedia& media, std::uint32_t corrections) {
  const std::uint32_t left = kMostIterations - std::min(kMostIterations, mostPreparation(media));
  return std::clamp(left / mostIterations(media, corrections), 1u, std::uint32_t(film::kBatchSamples));
}

} // namespace

passes::MarchSpec marchSpecFor(const gpu_scene::GpuScene& scene, const MarchPlan& plan,
                               const EstimatorOptions& options) {
  const gpu_scene::Features& features = scene.features();
  passes::MarchSpec spec;
  spec.kPhaseMask = features.phaseMask;
  spec.kSlots = static_cast<std::uint32_t>(scene.media().placements.size());
  spec.kBeams = plan.beams;
  spec.kHomogeneousMedia = scene.media().homogeneousCount;
  spec.kGridMedia = static_cast<std::uint32_t>(scene.media().media.size()) - spec.kHomogeneousMedia;
  spec.kGridEmission = features.gridEmission;
  spec.kPointLights = features.pointLights;
  spec.kDistantLights = features.distantDeltas || features.distantAreas;
  spec.kDistantAreas = features.distantAreas;
  spec.kSky = plan.sky;
  spec.kOrthographic = features.orthographic;
  spec.kBackground = features.background;
  spec.kAovs = options.aovs;
  spec.kCorrections = options.preview || options.plantedBug == interop::kBugNoCorrection ? 0 : options.corrections;
  spec.kPlantedBug = options.plantedBug;
  return spec;
}

Marcher::Marcher(const gpu::Device& device, const gpu_scene::GpuScene& scene, const gpu_scene::VolumeSet& volumes,
                 const EstimatorOptions& options)
    : scene_(scene), samplesPerDispatch_(samplesPerDispatch(scene.media(), options.corrections)),
      march_(device, scene, volumes, options.cacheBytes), spec_(marchSpecFor(scene, march_.plan(), options)),
      pass_(device, spec_), pixels_(device, chunkFor(device, options), gpu::Memory::Host),
      sums_(device, pixels_.size(), gpu::Memory::Host), counters_(device, 1, gpu::Memory::Host) {
  TYNDALL_CHECK(scene.layout() == gpu_scene::GridLayout::Cells);
}

std::map<std::string, std::string> Marcher::pipeline() const {
  std::map<std::string, std::string> result;
#define SPEC(type, name, id, value) result.insert(specText(#name, spec_.name));
  TYNDALL_MARCH_SPEC(SPEC)
#undef SPEC
  return result;
}

void Marcher::collect(const interop::MarchCounters& counters, std::uint64_t samples) {
  totals_.lookups += counters.cells;
  totals_.steps += counters.steps;
  totals_.segments += samples + counters.corrections;
  totals_.nonFinite += counters.nonFinite;
  totals_.cut += counters.cut;
  totals_.samples += samples;
  ++totals_.dispatches;
}

std::span<const interop::PixelSums> Marcher::run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                                 std::uint32_t seed) {
  TYNDALL_CHECK(pixels.size() <= pixels_.size() && samples.count > 0);
  pixels_.write(pixels);
  interop::MarchInputs inputs{};
  inputs.scene = scene_.ptr();
  inputs.march = march_.ptr();
  inputs.pixels = pixels_.ptr();
  inputs.sums = sums_.ptr();
  inputs.counters = counters_.ptr();
  inputs.count = static_cast<std::uint32_t>(pixels.size());
  inputs.seed = seed;
  march_.begin(seed, samples.first / film::kBatchSamples);
  for (std::uint32_t done = 0; done < samples.count; done += inputs.sampleCount) {
    inputs.firstSample = samples.first + done;
    inputs.sampleCount = std::min(samplesPerDispatch_, samples.count - done);
    inputs.resume = done > 0 ? 1 : 0;
    counters_.fillZero();
    pass_.run(inputs);
    collect(counters_.mapped()[0], std::uint64_t(pixels.size()) * inputs.sampleCount);
  }
  return sums_.mapped().subspan(0, pixels.size());
}

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#include "bench/path_run.h"

#include "math/colour.h"

// Needs <cstdint> before it.
#include "kernels/path.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace tyndall::bench {
namespace {

/// What a ray through the surfaces counts for in steps, as in render::PathTracer.
constexpr std::uint32_t kCastSteps = 16;
constexpr std::size_t kFirstPixels = 64;

render::EstimatorOptions oneChunk(std::size_t pixels) {
  render::EstimatorOptions options;
  options.method = render::Method::Path;
  options.chunkPixels = static_cast<std::uint32_t>(pixels);
  return options;
}

gpu::Kernel timedKernel(const gpu::Device& device, std::span<const std::uint32_t> module,
                        std::span<const gpu::SpecEntry> spec, const gpu::AtlasImages& images, Cost& cost) {
  std::optional<gpu::Kernel> kernel;
  cost = costOf([&] { kernel.emplace(device, module, spec, images); });
  return std::move(*kernel);
}

} // namespace

std::span<const std::uint32_t> pathModule() { return k_path_spirv; }

std::vector<gpu::SpecEntry> pathSpecEntries(const passes::PathSpec& spec) {
  return {
#define SPEC(type, name, id, value) gpu::SpecEntry{id, gpu::specBits(spec.name)},
      TYNDALL_PATH_SPEC(SPEC)
#undef SPEC
  };
}

double PathFigures::totalSeconds() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }

PathRun::PathRun(const gpu::Device& device, const gpu_scene::GpuScene& scene, std::span<const std::uint32_t> module,
                 std::span<const gpu::SpecEntry> spec, const std::vector<std::uint32_t>& pixels)
    : device_(&device), scene_(&scene),
      pixels_(pixels), pass_{timedKernel(device, module, spec, scene.images(), creation_)},
      runner_(device, oneChunk(pixels.size())) {
  const Cost first = costOf([&] { take(std::min(kFirstPixels, pixels_.size()), 1, 0); });
  compileSeconds_ = secondsOf(creation_, device) + secondsOf(first, device);
}

void PathRun::run(std::uint32_t samples, std::uint32_t seed, bool warmUp) {
  std::span<const interop::PixelSums> sums;
  const Cost cost = costOf([&] { sums = take(pixels_.size(), samples, seed); });
  if (warmUp) {
    return;
  }
  std::vector<double> picture;
  for (const interop::PixelSums& each : sums) {
    const glm::dvec3 path(each.moments[0], each.moments[1], each.moments[2]);
    const glm::dvec3 background(each.extras[0], each.extras[1], each.extras[2]);
    picture.push_back(luminance(path + background) / samples);
  }
  figures_.pictures.push_back(std::move(picture));
  figures_.seconds.push_back(secondsOf(cost, *device_));
  figures_.samples += double(pixels_.size()) * samples;
  figures_.segments += last_.segments;
  figures_.lookups += last_.lookups;
  figures_.events += last_.events;
}

std::span<const interop::PixelSums> PathRun::take(std::size_t count, std::uint32_t samples, std::uint32_t seed) {
  last_ = {};
  interop::PathInputs inputs{};
  inputs.scene = scene_->ptr();
  return runner_.run(pass_, inputs, {pixels_.data(), count}, {0, samples}, seed, kCastSteps + scene_->loopCount(),
                     [this](const interop::PathCounters& counters) {
                       last_.segments += counters.segments;
                       last_.lookups += counters.lookups;
                       last_.events += counters.events;
                     });
}

} // namespace tyndall::bench

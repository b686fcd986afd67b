// SPDX-License-Identifier: Apache-2.0
#include "bench/path_run.h"

#include "bench/contender.h"
#include "math/colour.h"

// Needs <cstdint> before it.
#include "kernels/path.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace tyndall::bench {
namespace {

/// As in the renderer: well below what a watchdog allows on a GPU.
constexpr std::uint32_t kStepsOnCpu = 16384;
constexpr std::uint32_t kStepsOnGpu = 2048;
constexpr std::uint32_t kCastSteps = 16;
constexpr std::uint32_t kFirstPixels = 64;

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
    : device_(&device), scene_(&scene), kernel_(timedKernel(device, module, spec, scene.images(), creation_)),
      pixels_(device, std::span<const std::uint32_t>(pixels), gpu::Memory::Host),
      sums_(device, pixels.size(), gpu::Memory::Host), counters_(device, 1, gpu::Memory::Host) {
  for (gpu::Buffer<interop::PathState>& queue : suspended_) {
    queue = gpu::Buffer<interop::PathState>(device, pixels.size(), gpu::Memory::Device);
  }
  const auto count = std::min(kFirstPixels, static_cast<std::uint32_t>(pixels.size()));
  compileSeconds_ = secondsOf(creation_, device) + dispatch(count, 1, 0);
}

void PathRun::run(std::uint32_t samples, std::uint32_t seed, bool warmUp) {
  const auto count = static_cast<std::uint32_t>(pixels_.size());
  const double seconds = dispatch(count, samples, seed);
  if (warmUp) {
    return;
  }
  std::vector<double> picture;
  for (const interop::PixelSums& sums : sums_.mapped()) {
    const glm::dvec3 path(sums.moments[0], sums.moments[1], sums.moments[2]);
    const glm::dvec3 background(sums.extras[0], sums.extras[1], sums.extras[2]);
    picture.push_back(luminance(path + background) / samples);
  }
  figures_.pictures.push_back(std::move(picture));
  figures_.seconds.push_back(seconds);
  figures_.samples += double(count) * samples;
  figures_.segments += last_.segments;
  figures_.lookups += last_.lookups;
  figures_.events += last_.events;
}

double PathRun::dispatch(std::uint32_t count, std::uint32_t samples, std::uint32_t seed) {
  interop::PathInputs inputs{};
  inputs.scene = scene_->ptr();
  inputs.pixels = pixels_.ptr();
  inputs.sums = sums_.ptr();
  inputs.counters = counters_.ptr();
  inputs.count = count;
  inputs.sampleCount = samples;
  inputs.seed = seed;
  inputs.stageCost = kCastSteps + scene_->loopCount();
  inputs.stepBound = std::max(device_->info().type == "cpu" ? kStepsOnCpu : kStepsOnGpu, 2 * inputs.stageCost);
  last_ = {};
  return secondsOf(costOf([&] {
                     for (std::uint32_t round = 0; inputs.count > 0; ++round) {
                       inputs.suspendedIn = suspended_[(round + 1) % 2].ptr();
                       inputs.suspendedOut = suspended_[round % 2].ptr();
                       inputs.resume = round > 0 ? 1 : 0;
                       counters_.fillZero();
                       kernel_.run(inputs, inputs.count);
                       const interop::PathCounters counters = counters_.mapped()[0];
                       last_.segments += counters.segments;
                       last_.lookups += counters.lookups;
                       last_.events += counters.events;
                       inputs.count = counters.suspended;
                     }
                   }),
                   *device_);
}

} // namespace tyndall::bench

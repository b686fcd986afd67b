// SPDX-License-Identifier: Apache-2.0
#include "microbench/contender.h"

#include "math/colour.h"
#include "passes/light_cache/light_cache_pass.h"
#include "render/coverage.h"
#include "render/march_scene.h"
#include "render/pixel_order.h"

#include <algorithm>

namespace tyndall::microbench {
namespace {

/// Pixels within this distance of a point light are left out: 1 / r^2 gives them no second moment.
constexpr double kLightRadius = 5.0;
constexpr double kCovered = 0.01; // 1 - T

void add(render::Totals& sum, const render::Totals& before, const render::Totals& after) {
  sum.samples += after.samples - before.samples;
  sum.lookups += after.lookups - before.lookups;
  sum.segments += after.segments - before.segments;
  sum.steps += after.steps - before.steps;
  sum.nonFinite += after.nonFinite - before.nonFinite;
  sum.cut += after.cut - before.cut;
}

/// Of an environment.
CacheBuild buildSkyCaches(const gpu::Device& device, const gpu_scene::GpuScene& gpuScene,
                          const gpu_scene::VolumeSet& volumes, double cacheBytes, std::uint32_t repeats) {
  render::MarchScene march(device, gpuScene, volumes, cacheBytes);
  march.begin(0, 0); // compiles
  std::vector<double> wall;
  std::vector<double> cpu;
  for (std::uint32_t batch = 1; batch <= repeats; ++batch) {
    const Cost cost = costOf([&] { march.begin(0, batch); });
    wall.push_back(cost.wall);
    cpu.push_back(cost.cpu);
  }
  const render::CacheReport report = march.caches();
  return {{median(wall), median(cpu)}, report.bytes, report.count, report.dropped, 0.0};
}

} // namespace

CacheBuild buildCaches(const gpu::Device& device, const gpu_scene::GpuScene& gpuScene,
                       const gpu_scene::VolumeSet& volumes, double cacheBytes, std::uint32_t repeats) {
  const render::MarchPlan wanted = render::planMarch(gpuScene);
  if (wanted.sky) {
    return buildSkyCaches(device, gpuScene, volumes, cacheBytes, repeats);
  }
  const std::vector<render::LightCachePlan> plans =
      render::planLightCaches(wanted.wanted, gpuScene.media(), volumes, cacheBytes);
  CacheBuild result;
  result.count = static_cast<std::uint32_t>(plans.size());
  result.dropped = static_cast<std::uint32_t>(wanted.wanted.size() - plans.size());
  if (plans.empty()) {
    return result;
  }
  result.spacing = plans.front().spacing;
  std::vector<gpu::Buffer<float>> depths;
  std::vector<interop::LightCache> headers;
  for (const render::LightCachePlan& plan : plans) {
    depths.emplace_back(device, plan.nodes(), gpu::Memory::Device);
    headers.push_back(plan.header);
    headers.back().depths = depths.back().ptr();
    result.bytes += plan.bytes();
  }
  const gpu::Buffer<interop::LightCache> table(device, std::span<const interop::LightCache>(headers));
  const passes::LightCachePass pass(device);
  std::vector<double> wall;
  std::vector<double> cpu;
  for (std::uint32_t i = 0; i <= repeats; ++i) {
    const Cost cost = costOf([&] {
      for (std::uint32_t cache = 0; cache < headers.size(); ++cache) {
        const glm::ivec3 nodes = headers[cache].count;
        pass.run({gpuScene.cells().ptr(), table.ptr(), cache, 0, static_cast<std::uint32_t>(nodes.x * nodes.y)});
      }
    });
    if (i > 0) { // the first one compiles
      wall.push_back(cost.wall);
      cpu.push_back(cost.cpu);
    }
  }
  result.cost = {median(wall), median(cpu)};
  return result;
}

std::vector<std::uint32_t> measuredPixels(const BenchScene& scene) {
  const glm::uvec2 size = scene.scene.film.size;
  const std::vector<bool> coverage = render::sceneCoverage(scene.scene, scene.volumes);
  std::vector<std::uint32_t> pixels = render::dispatchOrder({glm::uvec2(0), size});
  std::erase_if(pixels, [&](std::uint32_t pixel) {
    const glm::uvec2 place(pixel & 0xffffu, pixel >> 16);
    const bool nearLight = scene.lightPixel && glm::length(glm::dvec2(place) + 0.5 - *scene.lightPixel) < kLightRadius;
    return nearLight || !coverage[place.x + std::size_t(size.x) * place.y];
  });
  return pixels;
}

std::vector<std::size_t> coveredPixels(const Passes& passes) {
  std::vector<std::size_t> covered;
  for (std::size_t i = 0; i < passes.transmittance.size(); ++i) {
    if (1.0 - passes.transmittance[i] > kCovered) {
      covered.push_back(i);
    }
  }
  return covered;
}

Contender::Contender(std::string name, const gpu::Device& device, const BenchScene& scene,
                     const gpu_scene::GpuScene& gpuScene, const render::EstimatorOptions& options)
    : name_(std::move(name)), options_(options), device_(&device),
      estimator_(render::makeEstimator(device, gpuScene, scene.volumes, options)) {}

void Contender::run(const std::vector<std::uint32_t>& pixels, std::uint32_t samples, std::uint32_t seed, bool warmUp) {
  std::vector<double> picture(pixels.size());
  std::vector<double> transmittance(pixels.size());
  const render::Totals before = estimator_->totals();
  double seconds = 0.0;
  for (std::size_t first = 0; first < pixels.size(); first += estimator_->chunkPixels()) {
    const std::size_t count = std::min<std::size_t>(estimator_->chunkPixels(), pixels.size() - first);
    std::span<const interop::PixelSums> sums;
    const Cost cost = costOf([&] { sums = estimator_->run({pixels.data() + first, count}, {0, samples}, seed); });
    seconds += secondsOf(cost, *device_);
    for (std::size_t i = 0; i < count; ++i) {
      picture[first + i] = luminance(glm::dvec3(sums[i].moments[0], sums[i].moments[1], sums[i].moments[2])) / samples;
      transmittance[first + i] = double(sums[i].moments[3]) / samples;
    }
  }
  if (warmUp) {
    return;
  }
  Passes& passes = passes_[samples];
  passes.transmittance.resize(pixels.size(), 0.0);
  const double runs = double(passes.pictures.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    passes.transmittance[i] = (passes.transmittance[i] * runs + transmittance[i]) / (runs + 1.0);
  }
  passes.pictures.push_back(std::move(picture));
  passes.seconds.push_back(seconds);
  add(passes.spent, before, estimator_->totals());
}

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "kernels/bare_lookup.h"
#include "passes/bench/bench_io.h"
#include "render/pixel_order.h"
#include "render/renderer.h"
#include "volume/depth.h"
#include "volume/load.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>

/// Lookups, shadow rays and samples per second on one volume under a sun; lookups per camera path beside those of one
/// global majorant; and the bare lookup kernel as the ceiling. Configurations run in turn, medians are printed.
namespace tyndall::bench {
namespace {

struct Options {
  std::string volume;
  std::uint32_t size = 512;
  std::uint32_t repeats = 5;
  double opticalDepth = 5.0;
  std::string device;
};

/// Wall and process time: on a CPU device and a busy machine the second one is the repeatable figure.
struct Cost {
  double wall = 0.0;
  double cpu = 0.0;
};

struct Figures {
  Cost cost;
  render::Totals totals;
  std::size_t pixels = 0;
};

Cost costOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpuStart = std::clock();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          double(std::clock() - cpuStart) / CLOCKS_PER_SEC};
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// The volume seen from the front, filling the picture, under one sun.
scene::Scene sunScene(const Options& options, const volume::BrickGrid& grid) {
  const Bounds3 bounds = grid.worldBounds();
  const double radius = 0.5 * glm::length(bounds.size());
  scene::Scene scene;
  scene.film.size = glm::uvec2(options.size);
  scene.camera.target = bounds.centre();
  scene.camera.position = bounds.centre() + glm::dvec3(0.0, 0.0, 3.0 * radius);
  scene.camera.verticalFov = 30.0;
  scene::Medium medium;
  medium.file = options.volume;
  medium.grid = grid.name;
  medium.albedo = glm::dvec3(0.9);
  medium.densityScale = options.opticalDepth / volume::medianOpticalDepth(grid, 4096);
  medium.phase.id = PhaseId::HenyeyGreenstein;
  medium.phase.parameters[0] = 0.3;
  scene.media.push_back(medium);
  scene::SunLight sun;
  sun.direction = glm::normalize(glm::dvec3(-0.5, -0.7, -0.5));
  sun.angularDiameter = 0.0;
  scene.lights.push_back({"sun", sun, false});
  return scene;
}

gpu_scene::VolumeSet volumesOf(volume::BrickGrid grid) {
  gpu_scene::VolumeSet set;
  set.grids.push_back(std::move(grid));
  set.uses.push_back({std::size_t{0}, std::nullopt});
  return set;
}

/// The same grid with one majorant everywhere: what trackers without a hierarchy use.
volume::BrickGrid withGlobalMajorant(volume::BrickGrid grid) {
  const float maximum = grid.maximum();
  for (volume::Range& range : grid.ranges) {
    range.max = maximum;
  }
  std::fill(grid.coarseMax.begin(), grid.coarseMax.end(), maximum);
  return grid;
}

Figures renderOnce(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                   const gpu_scene::GpuScene& gpuScene, std::uint32_t samples, bool delta) {
  render::RenderOptions options;
  options.stop.samples = samples;
  options.estimator.deltaTracking = delta;
  render::RenderReport report;
  Figures figures;
  figures.cost = costOf([&] { render::renderFilm(device, scene, volumes, gpuScene, options, report); });
  figures.totals = report.totals;
  figures.pixels = report.mediaPixels;
  return figures;
}

void printRow(const char* name, const std::vector<Figures>& runs) {
  std::vector<double> wall;
  std::vector<double> cpu;
  for (const Figures& each : runs) {
    wall.push_back(each.cost.wall);
    cpu.push_back(each.cost.cpu);
  }
  const render::Totals& totals = runs.front().totals;
  const double samples = double(totals.samples);
  const double time = median(wall);
  fmt::print("{:<28} {:>8.3f} {:>8.3f} {:>11.2f} {:>12.2f} {:>12.2f} {:>15.2f}\n", name, time, median(cpu),
             samples / time * 1e-6, double(totals.lookups) / time * 1e-6, double(totals.segments) / time * 1e-6,
             double(totals.lookups) / samples);
}

Cost bareLookups(const gpu::Device& device, const gpu_scene::GpuScene& gpuScene, const Options& options,
                 double meanStep) {
  const std::array spec{gpu::SpecEntry{0, gpuScene.features().formatMask}};
  const gpu::Kernel kernel(device, k_bare_lookup_spirv, spec, gpuScene.images());
  const std::vector<std::uint32_t> order = render::dispatchOrder({glm::uvec2(0), glm::uvec2(options.size)});
  const gpu::Buffer<std::uint32_t> pixels(device, std::span<const std::uint32_t>(order), gpu::Memory::Host);
  const gpu::Buffer<float> sums(device, order.size(), gpu::Memory::Host);
  constexpr std::uint32_t kLookups = 64;
  const interop::BareLookupInputs inputs{gpuScene.ptr(), pixels.ptr(),
                                         sums.ptr(),     static_cast<std::uint32_t>(order.size()),
                                         kLookups,       static_cast<float>(meanStep)};
  kernel.run(inputs, inputs.count);
  std::vector<double> wall;
  std::vector<double> cpu;
  for (std::uint32_t i = 0; i < options.repeats; ++i) {
    const Cost cost = costOf([&] { kernel.run(inputs, inputs.count); });
    wall.push_back(cost.wall);
    cpu.push_back(cost.cpu);
  }
  const auto hits = std::count_if(sums.mapped().begin(), sums.mapped().end(), [](float sum) { return sum != 0.0f; });
  const double lookups = double(hits) * kLookups;
  return {lookups / median(wall), lookups / median(cpu)};
}

int run(const Options& options) {
  const gpu::Device device({.select = options.device, .validation = false, .pipelineCache = {}});
  volume::BrickGrid grid;
  const double loadSeconds = costOf([&] { grid = volume::loadGrid(options.volume, {}); }).wall;
  const scene::Scene scene = sunScene(options, grid);
  const gpu_scene::VolumeSet global = volumesOf(withGlobalMajorant(grid));
  const gpu_scene::VolumeSet local = volumesOf(std::move(grid));
  const gpu_scene::GpuScene localScene(device, scene, local);
  const gpu_scene::GpuScene globalScene(device, scene, global);
  fmt::print("{} on {}\n{} at {}x{}, load {:.3f} s, {} active voxels as {}, median optical depth {}\n\n",
             device.info().name, device.info().driver, options.volume, options.size, options.size, loadSeconds,
             local.grids[0].activeVoxels, volume::storageName(local.grids[0].storage), options.opticalDepth);
  std::array<std::vector<Figures>, 3> runs;
  constexpr std::uint32_t kSamples = 16;
  for (std::uint32_t i = 0; i <= options.repeats; ++i) { // the first round compiles and is dropped
    runs[0].push_back(renderOnce(device, scene, local, localScene, kSamples, false));
    runs[1].push_back(renderOnce(device, scene, local, localScene, kSamples, true));
    runs[2].push_back(renderOnce(device, scene, global, globalScene, kSamples, true));
  }
  for (std::vector<Figures>& each : runs) {
    each.erase(each.begin());
  }
  fmt::print("{:<28} {:>8} {:>8} {:>11} {:>12} {:>12} {:>15}\n", "", "wall s", "CPU s", "Msamples/s", "Mlookups/s",
             "Mstages/s", "lookups/sample");
  printRow("weighted walk, majorant grid", runs[0]);
  printRow("delta tracking, majorant grid", runs[1]);
  printRow("delta tracking, one majorant", runs[2]);
  const Cost ceiling = bareLookups(device, localScene, options, 8.0);
  fmt::print("\nbare lookups along the camera rays: {:.1f} M per second, {:.1f} M per CPU second\n",
             ceiling.wall * 1e-6, ceiling.cpu * 1e-6);
  fmt::print("lookups per sample, majorant grid over one majorant: {:.3f}\n",
             double(runs[1][0].totals.lookups) / double(runs[2][0].totals.lookups));
  return 0;
}

} // namespace
} // namespace tyndall::bench

int main(int argc, char** argv) {
  tyndall::bench::Options options;
  CLI::App app("Speed of tracking on one volume under a sun");
  app.add_option("volume", options.volume, "A .vdb file")->required();
  app.add_option("--size", options.size, "Picture edge, pixels");
  app.add_option("--repeats", options.repeats, "Timed rounds");
  app.add_option("--optical-depth", options.opticalDepth, "Median optical depth");
  app.add_option("--device", options.device, "Index or part of the name");
  CLI11_PARSE(app, argc, argv);
  try {
    return tyndall::bench::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

// SPDX-License-Identifier: Apache-2.0
#include "bench/ceilings.h"
#include "bench/scenes.h"
#include "microbench/commands.h"
#include "microbench/measure.h"
#include "render/renderer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;

struct Figures {
  Cost cost;
  render::Totals totals;
};

/// The same grid with one majorant everywhere: what trackers without a hierarchy use.
volume::BrickGrid withGlobalMajorant(volume::BrickGrid grid) {
  const float maximum = grid.maximum();
  for (volume::Range& range : grid.ranges) {
    range.max = maximum;
  }
  std::fill(grid.coarseMax.begin(), grid.coarseMax.end(), maximum);
  return grid;
}

Figures renderOnce(const gpu::Device& device, const BenchScene& scene, const gpu_scene::GpuScene& gpuScene,
                   bool delta) {
  render::RenderOptions options;
  options.stop.samples = film::kBatchSamples;
  options.estimator.deltaTracking = delta;
  render::RenderReport report;
  Figures figures;
  figures.cost = costOf([&] { render::renderFilm(device, scene.scene, scene.volumes, gpuScene, options, report); });
  figures.totals = report.totals;
  return figures;
}

Json printRow(const char* name, const std::vector<Figures>& runs) {
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
  return {{"estimator", name},         {"wallSeconds", time},       {"cpuSeconds", median(cpu)},
          {"samples", totals.samples}, {"lookups", totals.lookups}, {"segments", totals.segments}};
}

} // namespace

Json trackingReport(const Session& session) {
  const Options& options = session.options;
  const gpu::Device& device = session.device;
  const BenchScene local = sunScene(session.grid, options.opticalDepth, options.size);
  const BenchScene global = sunScene(withGlobalMajorant(session.grid), options.opticalDepth, options.size);
  const gpu_scene::GpuScene localScene(device, local.scene, local.volumes);
  const gpu_scene::GpuScene globalScene(device, global.scene, global.volumes);
  std::array<std::vector<Figures>, 3> runs;
  for (std::uint32_t i = 0; i <= options.repeats; ++i) { // the first round compiles and is dropped
    runs[0].push_back(renderOnce(device, local, localScene, false));
    runs[1].push_back(renderOnce(device, local, localScene, true));
    runs[2].push_back(renderOnce(device, global, globalScene, true));
  }
  for (std::vector<Figures>& each : runs) {
    each.erase(each.begin());
  }
  fmt::print("\n{:<28} {:>8} {:>8} {:>11} {:>12} {:>12} {:>15}\n", "", "wall s", "CPU s", "Msamples/s", "Mlookups/s",
             "Mstages/s", "lookups/sample");
  Json report = Json::array();
  report.push_back(printRow("weighted walk, majorant grid", runs[0]));
  report.push_back(printRow("delta tracking, majorant grid", runs[1]));
  report.push_back(printRow("delta tracking, one majorant", runs[2]));
  const Cost ceiling = bareLookups(device, localScene, options.size, options.repeats, 8.0);
  fmt::print("\nbare lookups along the camera rays: {:.1f} M per second, {:.1f} M per CPU second\n",
             ceiling.wall * 1e-6, ceiling.cpu * 1e-6);
  fmt::print("lookups per sample, majorant grid over one majorant: {:.3f}\n",
             double(runs[1][0].totals.lookups) / double(runs[2][0].totals.lookups));
  report.push_back({{"bareLookupsPerSecond", ceiling.wall}, {"bareLookupsPerCpuSecond", ceiling.cpu}});
  return report;
}

} // namespace tyndall::microbench

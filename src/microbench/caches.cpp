// SPDX-License-Identifier: Apache-2.0
#include "microbench/commands.h"
#include "microbench/contender.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;
using SceneMaker = BenchScene (*)(const volume::BrickGrid&, double, std::uint32_t);

struct Lighting {
  const char* name;
  SceneMaker make;
};
constexpr Lighting kLightings[] = {{"sun", sunScene}, {"point", foggyPointScene}, {"sky", skyScene}};
constexpr double kNoBudget = 8e9;
constexpr double kBudgets[] = {256e6, 64e6, 16e6, 4e6, 1e6, 0.0};

Json buildRow(const Session& session, const volume::BrickGrid& cloud, const Lighting& lighting, double budget) {
  const int edge = cloud.indexMax.x - cloud.indexMin.x + 1;
  const BenchScene scene = lighting.make(cloud, session.options.opticalDepth, session.options.size);
  const gpu_scene::GpuScene cells(session.device, scene.scene, scene.volumes, gpu_scene::GridLayout::Cells);
  const CacheBuild build = buildCaches(session.device, cells, scene.volumes, budget, 3);
  const double gridBytes = double(session.device.allocatedBytes());
  fmt::print("{:>6} {:<8}{:>10}{:>8}{:>8}{:>10.1f}{:>10.1f}{:>10}{:>10}\n", edge, lighting.name,
             budget >= kNoBudget ? "none" : shortText(budget * 1e-6), build.count, build.spacing, gridBytes * 1e-6,
             build.bytes * 1e-6, shortText(build.cost.cpu), shortText(build.cost.wall));
  std::fflush(stdout);
  return {{"edge", edge},
          {"light", lighting.name},
          {"budgetBytes", budget},
          {"caches", build.count},
          {"dropped", build.dropped},
          {"spacing", build.spacing},
          {"gridBytes", gridBytes},
          {"bytes", build.bytes},
          {"cpuSeconds", build.cost.cpu},
          {"wallSeconds", build.cost.wall}};
}

Json sizesReport(const Session& session) {
  fmt::print("\nCaches of synthetic clouds, optical depth {}\n", session.options.opticalDepth);
  fmt::print("{:>6} {:<8}{:>10}{:>8}{:>8}{:>10}{:>10}{:>10}{:>10}\n", "edge", "light", "budget MB", "caches", "spacing",
             "grid MB", "MB", "CPU s", "wall s");
  Json rows = Json::array();
  for (int edge = 64; edge <= session.options.largestEdge; edge *= 2) {
    const volume::BrickGrid cloud = cloudOfEdge(edge);
    for (const Lighting& lighting : kLightings) {
      rows.push_back(buildRow(session, cloud, lighting, session.options.cacheBytes));
    }
    rows.push_back(buildRow(session, cloud, kLightings[0], kNoBudget));
  }
  return rows;
}

/// The march on one scene with one budget.
struct Trial {
  Trial(const Session& session, const BenchScene& scene, const gpu_scene::GpuScene& cells, double budget)
      : build(buildCaches(session.device, cells, scene.volumes, budget, 3)),
        march("march", session.device, scene, cells, optionsFor(budget)) {}

  static render::EstimatorOptions optionsFor(double budget) {
    render::EstimatorOptions options;
    options.method = render::Method::March;
    options.cacheBytes = budget;
    return options;
  }

  CacheBuild build;
  Contender march;
};

Json budgetsReport(const Session& session, const Lighting& lighting) {
  const BenchScene scene = lighting.make(session.grid, session.options.opticalDepth, session.options.size);
  const std::vector<std::uint32_t> pixels = measuredPixels(scene);
  const gpu_scene::GpuScene cells(session.device, scene.scene, scene.volumes, gpu_scene::GridLayout::Cells);
  std::vector<Trial> trials;
  for (const double budget : kBudgets) {
    trials.emplace_back(session, scene, cells, budget);
  }
  for (std::uint32_t repeat = 0; repeat <= session.options.repeats; ++repeat) {
    for (Trial& trial : trials) {
      trial.march.run(pixels, film::kBatchSamples, repeat, repeat == 0);
    }
  }
  const std::vector<std::size_t> covered = coveredPixels(trials.front().march.passes(film::kBatchSamples));
  fmt::print("\n{}, {}: the march under small budgets\n", session.options.volume, lighting.name);
  fmt::print("{:>10}{:>8}{:>8}{:>8}{:>10}{:>10}{:>8}{:>10}{:>10}{:>8}\n", "budget MB", "MB", "caches", "spacing",
             "build s", "s/16 spp", "", "V", "V s", "of best");
  Json rows = Json::array();
  Figure best;
  for (const Trial& trial : trials) {
    const Passes& passes = trial.march.passes(film::kBatchSamples);
    const Figure variance = meanVariance(passes.pictures, covered);
    const Figure seconds = medianTime(passes.seconds);
    const Figure product = variance * seconds;
    best = rows.empty() ? product : best;
    const double budget = trial.march.options().cacheBytes;
    fmt::print("{:>10}{:>8}{:>8}{:>8}{:>10}{:>10}{:>8}{:>10}{:>10}{:>8}\n", shortText(budget * 1e-6),
               shortText(trial.build.bytes * 1e-6), trial.build.count, trial.build.spacing,
               shortText(secondsOf(trial.build.cost, session.device)), shortText(seconds.value), "",
               shortText(variance.value), shortText(product.value), shortText(product.value / best.value));
    const Interval ends = interval(product, session.options.repeats);
    rows.push_back({{"light", lighting.name},
                    {"budgetBytes", budget},
                    {"bytes", trial.build.bytes},
                    {"caches", trial.build.count},
                    {"dropped", trial.build.dropped},
                    {"spacing", trial.build.spacing},
                    {"buildSeconds", secondsOf(trial.build.cost, session.device)},
                    {"secondsPerPass", seconds.value},
                    {"variance", variance.value},
                    {"varianceTimesSeconds", product.value},
                    {"interval", {ends.low, ends.high}}});
  }
  std::fflush(stdout);
  return rows;
}

} // namespace

Json cachesReport(const Session& session) {
  Json report;
  report["budgets"] = Json::array();
  for (const Lighting& lighting : kLightings) {
    report["budgets"].push_back(budgetsReport(session, lighting));
  }
  report["sizes"] = sizesReport(session);
  return report;
}

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#include "app/bench_made.h"

#include "base/error.h"
#include "bench/scaling_measure.h"
#include "bench/skip_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <thread>

namespace tyndall::app {
namespace {

using Plans = std::vector<bench::ScalingPlan>;

const MadeBenchmark kMade[] = {{"scaling", "Cost over voxels, optical depth, lights, triangles, pixels and threads"},
                               {"skip", "What features cost in scenes that do not need them, by pass path"}};
const MadeBenchmark& kScaling = kMade[0];

Plans allPlans() { return bench::scalingPlans(std::max(1u, std::thread::hardware_concurrency())); }

Plans chosenPlans(const std::vector<std::string>& parts) {
  Plans plans = allPlans();
  std::vector<std::string> names;
  std::ranges::transform(plans, std::back_inserter(names), &bench::ScalingPlan::name);
  for (const std::string& part : parts) {
    if (std::ranges::find(names, part) == names.end()) {
      fail("--scenes: scaling has no \"{}\"; it has {}", part, joinNames(names));
    }
  }
  std::erase_if(plans, [&](const bench::ScalingPlan& plan) {
    return !parts.empty() && std::ranges::find(parts, plan.name) == parts.end();
  });
  return plans;
}

void measureScaling(const MadeOptions& options, const bench::Say& say, bench::Report& report) {
  const std::vector<std::string> arguments =
      options.device.empty() ? std::vector<std::string>{} : std::vector<std::string>{"--device", options.device};
  for (const bench::ScalingPlan& plan : chosenPlans(options.parts)) {
    report.scaling.push_back(bench::measureScaling(plan, options.measure, arguments, say));
  }
}

void measureSkip(const MadeOptions& options, const bench::Say& say, bench::Report& report) {
  if (!options.parts.empty()) {
    fail("--scenes: skip has no parts; leave it away");
  }
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1); // what an earlier run compiled would hide what compiling takes
  const gpu::Device device({.select = options.device, .validation = false, .pipelineCache = {}});
  report.skip = bench::measureSkip(device, options.measure.seeds, say);
}

} // namespace

const MadeBenchmark* findMade(const std::string& name) {
  const auto* const found = std::ranges::find(kMade, name, &MadeBenchmark::name);
  return found == std::end(kMade) ? nullptr : found;
}

void listMade(const MadeBenchmark& benchmark) {
  fmt::print("{}: {}\n", benchmark.name, benchmark.title);
  if (&benchmark != &kScaling) {
    return;
  }
  for (const bench::ScalingPlan& plan : allPlans()) {
    fmt::print("  {:<20}{}: {:g}\n", plan.name, plan.title, fmt::join(plan.values, ", "));
  }
}

void measureMade(const MadeBenchmark& benchmark, const MadeOptions& options, const bench::Say& say,
                 bench::Report& report) {
  if (&benchmark == &kScaling) {
    measureScaling(options, say, report);
  } else {
    measureSkip(options, say, report);
  }
}

} // namespace tyndall::app

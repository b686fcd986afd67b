// SPDX-License-Identifier: Apache-2.0
#include "bench/evaluate.h"

#include "bench/page_pictures.h"

#include <algorithm>
#include <numeric>

namespace tyndall::bench {
namespace {

constexpr double kBounds[][2] = {{1e-2, 1e-3}, {0.05, 0.01}}; ///< of relMSE, of rRMSE

double medianOf(const std::vector<Json>& statistics, const char* pointer) {
  std::vector<double> values;
  for (const Json& each : statistics) {
    values.push_back(each.value(Json::json_pointer(pointer), 0.0));
  }
  return median(std::move(values));
}

Work workOf(const std::vector<Json>& statistics) {
  const auto mean = [&](const char* pointer) {
    return std::accumulate(
               statistics.begin(), statistics.end(), 0.0,
               [&](double sum, const Json& each) { return sum + each.value(Json::json_pointer(pointer), 0.0); }) /
           double(statistics.size());
  };
  return {mean("/samples"), mean("/density_lookups"), mean("/segments"), mean("/ray_pieces"), mean("/dispatches")};
}

Parts partsOf(const std::vector<Json>& statistics) {
  const auto of = [&](const char* pointer) { return medianOf(statistics, pointer); };
  return {of("/seconds/start"),
          of("/seconds/load"),
          of("/seconds/upload"),
          of("/seconds/estimator"),
          of("/seconds/compile_and_first_dispatch"),
          of("/seconds/render"),
          of("/seconds/write"),
          of("/device_bytes/peak"),
          of("/kernel_bytes")};
}

Level levelOf(const Measured& measured, const Reference& reference, bool seeded) {
  Level level;
  level.label = measured.plan.label;
  level.samples = measured.plan.samples;
  level.runs = seeded ? measured.pictures.size() : 1;
  level.errors = errorsOf(measured.pictures, reference);
  level.cpu = medianTime(measured.cpu);
  level.wall = medianTime(measured.wall);
  level.peakBytes = measured.peakBytes;
  if (!measured.statistics.empty()) {
    level.work = workOf(measured.statistics);
    level.parts = partsOf(measured.statistics);
  }
  return level;
}

double squaredBias(const Bias& bias, bool relMse) {
  return relMse ? std::max(bias.relMse, 0.0) : bias.rRmse * bias.rRmse;
}

std::vector<Effort> effortsOf(const std::vector<Level>& levels, bool relMse, Figure Level::*seconds) {
  std::vector<Effort> efforts;
  for (const Level& level : levels) {
    const Figure& root = level.errors.rRmse;
    const Figure squared = relMse ? level.errors.relMse : Figure{root.value * root.value, 2.0 * root.logError};
    efforts.push_back({level.samples, squared, level.*seconds});
  }
  return efforts;
}

/// @param biased what remains without noise counts beside what pictures scatter by
void addTargets(ContenderResult& result, bool biased) {
  for (const bool relMse : {true, false}) {
    const double bias = biased ? squaredBias(result.bias, relMse) : 0.0;
    for (const double bound : kBounds[relMse ? 0 : 1]) {
      const double squared = relMse ? bound : bound * bound;
      result.targets.push_back({relMse ? "relMSE" : "rRMSE", bound,
                                secondsTo(squared, effortsOf(result.levels, relMse, &Level::cpu), bias),
                                secondsTo(squared, effortsOf(result.levels, relMse, &Level::wall), bias)});
    }
  }
  Figure efficiency;
  if (efficiencyOf(effortsOf(result.levels, true, &Level::cpu), efficiency)) {
    result.efficiency = efficiency;
  }
}

} // namespace

ContenderResult evaluate(const Rendered& rendered, const Reference& reference, const Replicates& against,
                         const Showing& showing) {
  ContenderResult result{rendered.contender->name,
                         rendered.contender->title,
                         rendered.contender->ours,
                         rendered.refusal,
                         {},
                         {},
                         {},
                         {},
                         {},
                         {}};
  if (rendered.levels.empty()) {
    return result;
  }
  for (const Measured& measured : rendered.levels) {
    result.levels.push_back(levelOf(measured, reference, rendered.contender->seeded));
  }
  const Measured& last = rendered.levels.back();
  result.bias = biasOf(last.pictures, reference, against);
  // Against an exact reference, and of a single picture, errors hold the bias.
  const bool scattered = rendered.contender->seeded && !reference.exact;
  addTargets(result, scattered && result.bias.found);
  result.picture = pictureBytes(last.first, showing.exposureStops, showing.view);
  result.map = errorMapBytes(errorMap(last.pictures, reference), reference.picture.size, median(last.cpu));
  return result;
}

} // namespace tyndall::bench

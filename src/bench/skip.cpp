// SPDX-License-Identifier: Apache-2.0
#include "bench/skip.h"

#include "bench/html.h"

#include <fmt/format.h>

namespace tyndall::bench {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const PipelineCost& cost) {
  return {
      {"device_bytes", cost.deviceBytes}, {"module_bytes", cost.moduleBytes}, {"compile_seconds", cost.compileSeconds}};
}

/// "139, 168": without, with.
std::string pairText(double without, double with) {
  return without == with ? shortText(with) : shortText(without) + ", " + shortText(with);
}

} // namespace

Json toJson(const SkipTable& table) {
  Json json{
      {"clock", table.clock}, {"repeats", table.repeats}, {"features", Json::array()}, {"methods", Json::array()}};
  for (const SkipRow& row : table.features) {
    json["features"].push_back(
        {{"scene", row.scene},
         {"feature", row.feature},
         {"microseconds_per_sample", row.microseconds},
         {"time_with_over_without", {{"value", row.time.value}, {"log_error", row.time.logError}}},
         {"without", toJson(row.without)},
         {"with", toJson(row.with)},
         {"pictures", row.pictures}});
  }
  for (const MethodRow& row : table.methods) {
    json["methods"].push_back({{"scene", row.scene},
                               {"method", row.method},
                               {"microseconds_per_sample", row.microseconds},
                               {"scene_bytes", row.sceneBytes},
                               {"surface_bytes", row.surfaceBytes},
                               {"pass_bytes", row.passBytes},
                               {"first_seconds", row.firstSeconds}});
  }
  return json;
}

std::string skipSection(const SkipTable& skip) {
  std::string html = heading("h2", "What is skipped");
  html +=
      note("Pass path: a scene that does without a feature, rendered without its code, as the renderer does, and "
           "with it, in turn. Two numbers: without, with. Time: with over without, with its 95 % interval; above 1, "
           "leaving it out pays. \"all\": everything that the scene may do without at once.");
  std::vector<std::vector<std::string>> rows{{"scene", "feature", skip.clock + " us per sample", "time", "device MB",
                                              "module kB", "compile s", "picture with it"}};
  for (const SkipRow& row : skip.features) {
    rows.push_back({row.scene, row.feature, shortText(row.microseconds), rangeText(row.time, skip.repeats),
                    pairText(1e-6 * row.without.deviceBytes, 1e-6 * row.with.deviceBytes),
                    pairText(1e-3 * row.without.moduleBytes, 1e-3 * row.with.moduleBytes),
                    pairText(row.without.compileSeconds, row.with.compileSeconds), row.pictures});
  }
  html += table(rows);
  html += heading("h3", "What methods keep on the device");
  rows = {{"scene", "method", skip.clock + " us per sample", "scene MB", "of that surfaces", "pass MB",
           "first dispatch s"}};
  for (const MethodRow& row : skip.methods) {
    rows.push_back({row.scene, row.method, shortText(row.microseconds), shortText(1e-6 * row.sceneBytes),
                    shortText(1e-6 * row.surfaceBytes), shortText(1e-6 * row.passBytes), shortText(row.firstSeconds)});
  }
  return html + table(rows);
}

} // namespace tyndall::bench

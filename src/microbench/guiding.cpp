// SPDX-License-Identifier: Apache-2.0
#include "microbench/guiding.h"

#include "base/error.h"
#include "base/file.h"
#include "microbench/bar_chart.h"
#include "microbench/guiding_ablation.h"
#include "microbench/guiding_run.h"
#include "microbench/text_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <map>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;

/// Variations that are rendered in turn, beside what they vary: each keeps a pipeline and a store.
constexpr std::size_t kVariationsAtOnce = 8;
constexpr const char* kUnchanged = "mcpg";

/// A row to be.
struct Contestant {
  std::string name;
  std::vector<scene::Override> overrides;
};
/// Rendered in turn; the first one is the reference.
using Field = std::vector<Contestant>;

Contestant contestant(const std::string& name, const std::string& integrator, const GuidingOptions& options) {
  Contestant result{name, {{"render.integrator", integrator}}};
  if (integrator != "path") {
    result.overrides.insert(result.overrides.end(), options.overrides.begin(), options.overrides.end());
  }
  return result;
}

std::string nameOf(const Variation& variation) {
  const std::string path = variation.path;
  return fmt::format("{}={}", path.substr(path.find('.') + 1), variation.value);
}

std::vector<Field> fieldsOf(const GuidingOptions& options) {
  std::vector<Field> fields;
  if (!options.ablate) {
    fields.emplace_back();
    for (const std::string& integrator : options.integrators) {
      fields.back().push_back(contestant(integrator, integrator, options));
    }
    return fields;
  }
  for (const Variation& variation : guideVariations()) {
    if (fields.empty() || fields.back().size() > kVariationsAtOnce) {
      fields.push_back({contestant(kUnchanged, kUnchanged, options)});
    }
    fields.back().push_back(contestant(nameOf(variation), kUnchanged, options));
    fields.back().back().overrides.push_back({variation.path, variation.value});
  }
  return fields;
}

/// Settings that a scene file refuses must come to light before hours of work.
void checkOverrides(const std::filesystem::path& file, const std::vector<Field>& fields) {
  for (const Field& field : fields) {
    for (const Contestant& each : field) {
      scene::loadScene(file, each.overrides);
    }
  }
}

/// Runs of all seeds, one contestant after the other for each seed, so that load hits all alike.
Race race(const gpu::Device& device, const GuidingScene& scene, const Field& field, bool lightSampling,
          const GuidingOptions& options) {
  std::vector<GuidingRun> runs;
  for (const Contestant& each : field) {
    std::vector<scene::Override> overrides = each.overrides;
    overrides.push_back({"render.light_sampling", lightSampling ? "true" : "false"});
    overrides.push_back({"render.samples", std::to_string(options.samples)});
    runs.emplace_back(each.name, device, scene, scene.with(overrides));
  }
  for (std::uint32_t seed = 1; seed <= options.seeds; ++seed) {
    for (GuidingRun& run : runs) {
      run.render(options.samples, seed);
    }
  }
  Race result{scene.name(), lightSampling, device.info().type != "cpu", {}};
  std::transform(runs.begin(), runs.end(), std::back_inserter(result.runs),
                 [](const GuidingRun& run) { return run.figures(); });
  return result;
}

/// Charts by the name of their file. What is compared with is the axis' 1, not a bar.
std::map<std::string, BarChart> chartsOf(const std::vector<GuidingRow>& rows, const GuidingOptions& options) {
  std::map<std::string, BarChart> charts;
  std::map<std::string, std::size_t> colours;
  const std::string reference = options.ablate ? "mcpg as it is" : "path";
  for (const GuidingRow& row : rows) {
    if (row.reference) {
      continue;
    }
    const std::string lights = row.lightSampling ? "on" : "off";
    BarChart& chart = charts[options.ablate ? fmt::format("ablation-{}-lights-{}", row.scene, lights)
                                            : fmt::format("guiding-lights-{}", lights)];
    chart.title =
        fmt::format("{}, light sampling {}", options.ablate ? "Settings changed alone" : "Guided paths", lights);
    chart.axis = fmt::format("gain in relMSE x time over {} (above 1: better)", reference);
    chart.note = fmt::format("{} samples per pixel; 95 % intervals of {} seeds; without the worst {:.1f} % of pixels",
                             options.samples, options.seeds, 100.0 * kTrimmedShare);
    const std::size_t colour = options.ablate ? 0 : colours.try_emplace(row.name, colours.size()).first->second;
    const Gain& gain = row.relative.gains.time;
    chart.bars.push_back({row.scene, row.name, gain.value, gain.range, colour});
  }
  return charts;
}

Json overridesJson(const std::vector<scene::Override>& overrides) {
  Json result = Json::object();
  for (const scene::Override& each : overrides) {
    result[each.path] = each.value;
  }
  return result;
}

void writeReport(const gpu::Device& device, const std::vector<GuidingRow>& rows, const GuidingOptions& options) {
  if (!options.json.empty()) {
    Json report{{"command", "guiding"},
                {"version", TYNDALL_VERSION},
                {"device", device.info().name},
                {"driver", device.info().driver},
                {"clock", device.info().type == "cpu" ? "process" : "wall"},
                {"size", {options.size.x, options.size.y}},
                {"samples", options.samples},
                {"seeds", options.seeds},
                {"trimmedShare", kTrimmedShare},
                {"ablation", options.ablate},
                {"set", overridesJson(options.overrides)},
                {"figures", Json::array()}};
    for (const GuidingRow& row : rows) {
      report["figures"].push_back(toJson(row));
    }
    writeTextFile(options.json, report.dump(2) + "\n");
  }
  if (!options.plots.empty()) {
    for (const auto& [name, chart] : chartsOf(rows, options)) {
      writeTextFile(options.plots / (name + ".svg"), svgText(chart));
    }
  }
}

/// Before hours of work.
void checkOutputs(const GuidingOptions& options) {
  if (!options.json.empty()) {
    checkWritable(options.json);
  }
  if (!options.plots.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.plots, failed);
    if (failed) {
      fail("{}: the folder cannot be made ({}); name another with --plots", options.plots.string(), failed.message());
    }
    checkWritable(options.plots / "guiding.svg");
  }
}

void printLines(const std::vector<GuidingRow>& rows) {
  for (const GuidingRow& row : rows) {
    fmt::print("{}", tableLine(row));
  }
  std::fflush(stdout);
}

} // namespace

void runGuiding(const GuidingOptions& options) {
  const std::vector<std::filesystem::path> files = sceneFiles(options);
  const std::vector<Field> fields = fieldsOf(options);
  checkOverrides(files.front(), fields);
  checkOutputs(options);
  const gpu::Device device({.select = options.device, .validation = false, .pipelineCache = {}});
  fmt::print(
      "{} on {}\n{}x{} pixels, {} samples per pixel, {} seeds; V: variance of a pixel's luminance; trimmed: without "
      "the worst {:.1f} % of pixels\n{}",
      device.info().name, device.info().driver, options.size.x, options.size.y, options.samples, options.seeds,
      100.0 * kTrimmedShare, tableHead());
  std::vector<GuidingRow> all;
  for (const std::filesystem::path& file : files) {
    const GuidingScene scene(device, file, options.size);
    for (const bool lightSampling : options.lightSampling) {
      for (const Field& field : fields) {
        const std::vector<GuidingRow> rows = rowsOf(race(device, scene, field, lightSampling, options));
        printLines(rows);
        all.insert(all.end(), rows.begin(), rows.end());
        writeReport(device, all, options);
      }
    }
  }
}

} // namespace tyndall::microbench

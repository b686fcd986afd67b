// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "microbench/commands.h"
#include "microbench/frames.h"
#include "microbench/frames_sheet.h"
#include "microbench/guiding.h"
#include "microbench/text_file.h"
#include "volume/load.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace tyndall::microbench {
namespace {

using Report = nlohmann::ordered_json (*)(const Session&);

struct Command {
  const char* name;
  const char* help;
  Report report;
  bool readsVolume = true;
};

constexpr Command kCommands[] = {
    {"tracking", "Speed of tracking under a sun, beside the bare lookup", trackingReport},
    {"estimators", "Variance times time of the march and of tracking", estimatorsReport},
    {"caches", "Light caches: memory, build time, and what small budgets cost", cachesReport},
    {"lanes", "Active lanes and cells per second of the march", lanesReport},
    {"rays", "Rays per second through surfaces, beside Embree", raysReport, false},
    {"paths", "Samples and rays per second of paths, beside the bare parts", pathsReport},
    {"lights", "Variance times time of the choice among many lights", lightsReport, false},
};

void addOptions(CLI::App& app, const Command& command, Options& options) {
  if (command.readsVolume) {
    app.add_option("volume", options.volume, "A .vdb file")->required();
  }
  app.add_option("--size", options.size, "Picture edge, pixels")->check(CLI::Range(16, 8192));
  app.add_option("--repeats", options.repeats, "Timed rounds, each with a seed of its own")
      ->check(CLI::Range(4, 10000));
  app.add_option("--optical-depth", options.opticalDepth, "Median optical depth")->check(CLI::PositiveNumber);
  app.add_option("--cache-bytes", options.cacheBytes, "Memory of light caches")->check(CLI::NonNegativeNumber);
  app.add_option("--largest-edge", options.largestEdge, "Voxels along an edge of the largest synthetic volume")
      ->check(CLI::Range(64, 1024));
  app.add_option("--device", options.device, "Index or part of the name");
  app.add_option("--json", options.json, "Writes the figures to this file as well");
}

volume::BrickGrid loadedGrid(const Options& options) {
  volume::BrickGrid grid = volume::loadGrid(options.volume, {});
  if (grid.empty()) {
    fail("{}: the grid \"{}\" is empty; name a volume that holds density", options.volume, grid.name);
  }
  return grid;
}

int run(const Command& command, const Options& options) {
  if (!options.json.empty()) {
    checkWritable(options.json);
  }
  const gpu::Device device({.select = options.device, .validation = false, .pipelineCache = {}});
  const volume::BrickGrid grid = command.readsVolume ? loadedGrid(options) : volume::BrickGrid{};
  fmt::print("{} on {}\n{}{}x{} pixels, {} repeats\n", device.info().name, device.info().driver,
             command.readsVolume ? fmt::format("{}, {} active voxels as {}, ", options.volume, grid.activeVoxels,
                                               volume::storageName(grid.storage))
                                 : "",
             options.size, options.size, options.repeats);
  nlohmann::ordered_json report{
      {"command", command.name},      {"version", TYNDALL_VERSION},
      {"device", device.info().name}, {"driver", device.info().driver},
      {"volume", options.volume},     {"size", options.size},
      {"repeats", options.repeats},   {"clock", device.info().type == "cpu" ? "process" : "wall"}};
  report["figures"] = command.report({options, device, grid});
  if (!options.json.empty()) {
    writeTextFile(options.json, report.dump(2) + "\n");
  }
  return 0;
}

} // namespace
} // namespace tyndall::microbench

int main(int argc, char** argv) {
  using namespace tyndall::microbench;
  Options options;
  CLI::App app("Measures Tyndall");
  app.require_subcommand(1);
  for (const Command& command : kCommands) {
    addOptions(*app.add_subcommand(command.name, command.help), command, options);
  }
  CLI::App& guiding = *app.add_subcommand(
      "guiding", "Variance times time of guided paths beside unguided ones, and whether their means agree");
  const std::shared_ptr<GuidingOptions> guidingOptions = addGuidingOptions(guiding);
  CLI::App& frames = *app.add_subcommand(
      "guiding-frames", "Errors of frames in which a lamp goes out, moves or jumps or the camera cuts, guided and not");
  const std::shared_ptr<FramesOptions> framesOptions = addFramesOptions(frames);
  CLI::App& sheet = *app.add_subcommand("guiding-sheet", "Frames of a sequence side by side, guided and not, as a PNG");
  const std::shared_ptr<SheetOptions> sheetOptions = addSheetOptions(sheet);
  CLI11_PARSE(app, argc, argv);
  try {
    if (app.got_subcommand(&guiding)) {
      runGuiding(*guidingOptions);
      return 0;
    }
    if (app.got_subcommand(&sheet)) {
      runSheet(*sheetOptions);
      return 0;
    }
    if (app.got_subcommand(&frames)) {
      runFrames(*framesOptions);
      return 0;
    }
    for (const Command& command : kCommands) {
      if (app.got_subcommand(command.name)) {
        return run(command, options);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 1;
}

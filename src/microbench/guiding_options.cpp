// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "microbench/guiding.h"
#include "microbench/option_values.h"

#include <algorithm>

namespace tyndall::microbench {
namespace fs = std::filesystem;
namespace {

/// The scenes of an ablation where none are named: a hidden light, a door ajar, many lamps.
const std::vector<std::string> kAblationScenes{"hidden", "door", "small-lamps"};

/// What is compared with comes first, whether it is named or not.
std::vector<std::string> pathFirst(std::vector<std::string> integrators) {
  std::erase(integrators, "path");
  integrators.insert(integrators.begin(), "path");
  return integrators;
}

void addWhat(CLI::App& command, GuidingOptions& options) {
  command.add_option("--folder", options.folder, "Where the scenes are");
  command.add_option("--scenes", options.scenes, "Names of its files, without .json; all of them else")
      ->delimiter(',')
      ->type_name("A,B");
  command
      .add_option_function<std::vector<std::string>>(
          "--integrators", [&options](const auto& names) { options.integrators = pathFirst(names); },
          "Beside path, which the others are compared with")
      ->delimiter(',')
      ->check(CLI::IsMember({"path", "screen-chains", "mcpg-paper", "mcpg"}));
  command
      .add_option_function<std::string>(
          "--light-sampling",
          [&options](const std::string& value) {
            options.lightSampling = value == "both" ? std::vector<bool>{false, true} : std::vector<bool>{value == "on"};
          },
          "Whether lights with a size are sampled")
      ->check(CLI::IsMember({"both", "on", "off"}));
  command.add_flag("--ablate", options.ablate,
                   "Each setting of mcpg changed alone, compared with mcpg as it is, instead of the integrators");
  addGuideOverrides(command, options.overrides);
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing)) {
    if (entry.path().extension() == ".json") {
      names.push_back(entry.path().stem().string());
    }
  }
  if (missing || names.empty()) {
    fail("{}: there are no scenes; name a folder of scene files with --folder", folder.string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

} // namespace

std::shared_ptr<GuidingOptions> addGuidingOptions(CLI::App& command) {
  auto shared = std::make_shared<GuidingOptions>();
  GuidingOptions& options = *shared;
  addWhat(command, options);
  addSize(command, options.size);
  command.add_option("--spp", options.samples, "Samples per pixel of a render")->check(CLI::Range(1, 1 << 20));
  command.add_option("--seeds", options.seeds, "Renders of each row")->check(CLI::Range(3, 1000));
  command.add_option("--device", options.device, "Index or part of the name");
  command.add_option("--json", options.json, "Writes the figures to this file as well");
  command.add_option("--plots", options.plots, "Writes bar charts (SVG) to this folder as well");
  return shared;
}

std::vector<fs::path> sceneFiles(const GuidingOptions& options) {
  const std::vector<std::string> there = namesIn(options.folder);
  const std::vector<std::string>& wanted =
      !options.scenes.empty() ? options.scenes : (options.ablate ? kAblationScenes : there);
  std::vector<fs::path> files;
  for (const std::string& name : wanted) {
    if (std::find(there.begin(), there.end(), name) == there.end()) {
      fail("{}: no scene \"{}\"; there are {}", options.folder.string(), name, joinNames(there));
    }
    files.push_back(options.folder / (name + ".json"));
  }
  return files;
}

} // namespace tyndall::microbench

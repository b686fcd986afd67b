// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/picture_files.h"
#include "base/error.h"
#include "base/file.h"
#include "film/checkpoint.h"
#include "film/merge.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <memory>
#include <optional>

namespace tyndall::app {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> parts;
  std::string output;
  bool mergeable = false;
  std::optional<double> exposure;
  std::optional<std::string> view;
};

/// Where `render --mergeable` and `merge --mergeable` put the film beside a picture.
fs::path partFile(const std::string& picture) { return picture + ".part"; }

film::Film loadPart(const std::string& path) {
  std::error_code ignored;
  if (!film::isCheckpoint(path) && film::isCheckpoint(partFile(path))) {
    fail("{}: is a picture; the part that can be merged is {}", path, partFile(path).string());
  }
  if (fs::is_regular_file(path, ignored) && !film::isCheckpoint(path)) {
    fail("{}: is not a part; `tyndall render --mergeable` writes one beside the picture, with .part at its end", path);
  }
  return film::loadCheckpoint(path);
}

film::View viewNamed(const std::string& name) {
  if (name != "standard" && name != "filmic") {
    fail("--view is \"{}\"; write standard or filmic", name);
  }
  return name == "filmic" ? film::View::Filmic : film::View::Standard;
}

double finiteStops(double exposure) {
  if (!std::isfinite(exposure)) {
    fail("--exposure is {}; write a number of stops, such as 1.5", exposure);
  }
  return exposure;
}

/// Outputs over inputs would lose a part if the run is cut off in between.
void checkOutputs(const MergeArguments& arguments) {
  if (fs::path(arguments.output).extension() != ".exr") {
    fail("-o {}: the name must end in .exr", arguments.output);
  }
  const fs::path part = partFile(arguments.output);
  for (const std::string& input : arguments.parts) {
    std::error_code ignored;
    if (fs::equivalent(input, arguments.output, ignored) ||
        (arguments.mergeable && fs::equivalent(input, part, ignored))) {
      fail("{}: is a part and would be overwritten; name another output with -o", input);
    }
  }
  checkWritable(arguments.output);
  checkWritable(fs::path(arguments.output).replace_extension(".png"));
}

int mergeCommand(const MergeArguments& arguments) {
  checkOutputs(arguments);
  std::vector<std::pair<std::string, film::Film>> parts;
  for (const std::string& path : arguments.parts) {
    parts.emplace_back(path, loadPart(path));
  }
  film::Film merged = film::merge(parts);
  PictureSettings settings = settingsOf(merged.metadata);
  settings.png.exposure = finiteStops(arguments.exposure.value_or(settings.png.exposure));
  if (arguments.view) {
    settings.png.view = viewNamed(*arguments.view);
  }
  noteSettings(settings, merged.metadata);
  const PictureFiles files = writePicture(arguments.output, merged, settings);
  if (arguments.mergeable) {
    film::saveCheckpoint(partFile(arguments.output), merged);
  }
  const film::ErrorEstimate error = film::estimateError(merged);
  const glm::uvec2 extent = merged.window().extent();
  fmt::print("{} parts: {}x{} pixels, estimated relative error {:.2f} % (90 % bound {:.2f} %)\n", parts.size(),
             extent.x, extent.y, 100.0 * error.relative, 100.0 * error.upper);
  fmt::print("wrote {} and {}\n", files.exr.string(), files.png.string());
  if (const auto biased = merged.metadata.find("estimator.biased");
      biased != merged.metadata.end() && biased->second != "0") {
    spdlog::warn("{}: is BIASED: its parts were rendered with --preview", arguments.output);
  }
  std::uint64_t unsound = 0;
  for (const char* count : {"nonFinite", "majorantExceeded", "cut"}) {
    unsound += film::countOf(merged.metadata, count);
  }
  if (files.report.nonFinitePixels > 0 || unsound > 0) {
    spdlog::error("{} pixels are not finite, {} samples of the parts were not sound; render the parts again",
                  files.report.nonFinitePixels, unsound);
    return kFailed;
  }
  return kDone;
}

} // namespace

void addMergeCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "merge", "Join parts of one picture, rendered with other seeds or crops or elsewhere, into one EXR and PNG");
  auto arguments = std::make_shared<MergeArguments>();
  command->add_option("parts", arguments->parts, "Files written by render --mergeable (PICTURE.exr.part)")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", arguments->output, "EXR to write; a PNG is written beside it")
      ->required()
      ->type_name("FILE");
  command->add_flag("--mergeable", arguments->mergeable, "Write OUTPUT.part too, which can be merged on");
  command->add_option("--exposure", arguments->exposure, "Stops, for the PNG (default: that of the parts)")
      ->type_name("STOPS");
  command->add_option("--view", arguments->view, "standard or filmic, for the PNG (default: that of the parts)")
      ->type_name("NAME");
  command->callback([arguments, &action] { action = [arguments] { return mergeCommand(*arguments); }; });
}

} // namespace tyndall::app

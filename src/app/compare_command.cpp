// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/quantities.h"
#include "base/file.h"
#include "film/compare.h"
#include "film/difference.h"

#include <fmt/format.h>

#include <memory>

namespace tyndall::app {
namespace {

struct CompareArguments {
  std::string image;
  std::string reference;
  std::string difference;
  std::string maxRrmse;
  std::string maxBias;
};

film::CompareOptions optionsOf(const CompareArguments& arguments) {
  film::CompareOptions options;
  if (!arguments.maxRrmse.empty()) {
    options.maxRrmse = parseFraction(arguments.maxRrmse, "--max-rrmse");
  }
  if (!arguments.maxBias.empty()) {
    options.maxBias = parseFraction(arguments.maxBias, "--max-bias");
  }
  return options;
}

int compareCommand(const CompareArguments& arguments) {
  const film::CompareOptions options = optionsOf(arguments);
  if (!arguments.difference.empty()) {
    checkWritable(arguments.difference);
  }
  const film::Image image = film::readExr(arguments.image);
  const film::Image reference = film::readExr(arguments.reference);
  const film::NamedImage a{arguments.image, image};
  const film::NamedImage b{arguments.reference, reference};
  const film::Comparison comparison = film::compare(a, b, options);
  fmt::print("{}", film::formatTable(comparison));
  if (!arguments.difference.empty()) {
    const film::DifferenceScale scale = film::writeDifferencePng(arguments.difference, a, b);
    fmt::print("{:<18}{} (full red: {} brighter by {:.4g} or more; blue: darker)\n", "difference", arguments.difference,
               arguments.image, scale.full);
  }
  const std::vector<std::string> failed = film::failures(comparison, options);
  for (const std::string& sentence : failed) {
    fmt::print("FAILED: {}\n", sentence);
  }
  if (failed.empty()) {
    fmt::print("passed\n");
  }
  return failed.empty() ? kDone : kFailed;
}

} // namespace

void addCompareCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "compare", "Differences of two EXR pictures, and whether they go beyond chance. Exit code 0: no; 1: yes, or "
                 "beyond a limit; 2: the pictures cannot be compared");
  auto arguments = std::make_shared<CompareArguments>();
  command->add_option("image", arguments->image, "Picture (.exr)")->required()->type_name("FILE");
  command->add_option("reference", arguments->reference, "Picture it is measured against (.exr)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--difference", arguments->difference,
                   "PNG to write: red where IMAGE is brighter, blue where darker")
      ->type_name("FILE");
  command
      ->add_option("--max-rrmse", arguments->maxRrmse,
                   "Largest relative RMS difference that passes, as 1% or 0.01 (default: no limit)")
      ->type_name("SHARE");
  command
      ->add_option("--max-bias", arguments->maxBias,
                   "Largest relative difference of the means of R, G or B that passes (default: no limit)")
      ->type_name("SHARE");
  command->callback([arguments, &action] { action = [arguments] { return compareCommand(*arguments); }; });
}

} // namespace tyndall::app

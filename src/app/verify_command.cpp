// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/verify_report.h"
#include "base/error.h"
#include "base/file.h"

#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>

namespace tyndall::app {
namespace {

/// Times as many replicates with --full: a quarter of the errors.
constexpr std::uint32_t kFullEffort = 16;

struct VerifyArguments {
  std::vector<std::string> names;
  std::string device;
  std::string json;
  std::uint32_t seed = 0;
  bool full = false;
  bool list = false;
};

int listChecks() {
  for (const verify::Check& check : verify::allChecks()) {
    fmt::print("{:<16} {:<38} {}\n", check.name, check.what, check.source);
  }
  return kDone;
}

void writeJson(const std::string& path, const VerifyRun& run) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream file(temporary);
    file << verifyJson(run).dump(2) << '\n';
    file.close();
    if (!file) {
      fail("{}: cannot be written", path);
    }
  });
}

int verifyCommand(const VerifyArguments& arguments) {
  if (arguments.list) {
    return listChecks();
  }
  const std::vector<const verify::Check*> checks = verify::chosenChecks(arguments.names);
  if (!arguments.json.empty()) {
    checkWritable(arguments.json);
  }
  const gpu::Device device(deviceOptions(arguments.device));
  VerifyRun run;
  run.device = device.info();
  run.conditions = {.effort = arguments.full ? kFullEffort : 1, .seed = arguments.seed};
  fmt::print("{}", verifyHeader());
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  run.results = verify::runChecks(checks, device, run.conditions, [](const verify::Result& result) {
    fmt::print("{}", verifyLine(result));
    std::fflush(stdout);
  });
  run.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  fmt::print("{}", verifyVerdict(run));
  if (!arguments.json.empty()) {
    writeJson(arguments.json, run);
  }
  return withValidation(device, run.passed() ? kDone : kFailed);
}

/// CLI11 turns what it returns into a mistake in the command line.
std::string unknownCheck(const std::string& name) {
  try {
    verify::chosenChecks({name});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

} // namespace

void addVerifyCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "verify", "Checks on this device that pictures are right: against closed forms, quadrature and each other. Exit "
                "code 0: all that the device can run pass; 1: one fails");
  auto arguments = std::make_shared<VerifyArguments>();
  command->add_option("checks", arguments->names, "Checks to run (default: all; --list names them)")
      ->type_name("NAME")
      ->check(CLI::Validator(unknownCheck, ""));
  command->add_flag("--list", arguments->list, "Only list the checks: name, what is checked, what against");
  command->add_flag("--full", arguments->full, "16 times the samples: sees a quarter of the bias");
  command->add_option("--seed", arguments->seed, "Other random numbers (default: 0)")->type_name("N");
  command->add_option("--json", arguments->json, "File to write: every test of every check, for scripts")
      ->type_name("FILE");
  command
      ->add_option("--device", arguments->device, "Vulkan device: number or part of the name (see `tyndall devices`)")
      ->type_name("NAME");
  command->callback([arguments, &action] { action = [arguments] { return verifyCommand(*arguments); }; });
}

} // namespace tyndall::app

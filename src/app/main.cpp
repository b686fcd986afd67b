// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/usage.h"
#include "base/error.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <new>

namespace {

using namespace tyndall::app;

/// Messages go to stderr without decoration: "warning: ...".
void setUpLog() {
  auto logger = spdlog::stderr_color_mt("tyndall");
  logger->set_pattern("%^%l%$: %v");
  spdlog::set_default_logger(logger);
}

/// @param failureCode set to what an Error of the command means for the exit code.
int run(int argc, char** argv, int& failureCode) {
  if (argc <= 1) {
    std::fputs(kShortHelp, stdout);
    return kWrongUsage;
  }
  CLI::App app("Tyndall renders fog, smoke, clouds and fire. `tyndall COMMAND --help` lists a command's options.",
               "tyndall");
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", "tyndall " TYNDALL_VERSION);
  app.add_flag_callback(
      "-v,--verbose", [] { spdlog::set_level(spdlog::level::debug); }, "Say more on stderr");
  Action action;
  for (const auto add :
       {addRenderCommand, addInfoCommand, addCheckCommand, addCompareCommand, addMergeCommand, addExportCommand,
        addVerifyCommand, addBenchCommand, addDevicesCommand}) {
    add(app, action);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error); // --help and --version
    }
    spdlog::error("{}", usageMessage(app, error));
    return kWrongUsage;
  }
  // To a script, pictures that differ and pictures that cannot be compared are two things.
  failureCode = app.got_subcommand("compare") ? kWrongUsage : kFailed;
  return action();
}

} // namespace

int main(int argc, char** argv) {
  setUpLog();
  int failureCode = kWrongUsage; // while the command line is read
  try {
    return run(argc, argv, failureCode);
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory; use a smaller picture, a \"clip\" box or \"storage\": \"unorm8\"");
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
  }
  return failureCode;
}

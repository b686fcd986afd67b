// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

/// One function per subcommand: it adds the subcommand's options to `app` and sets `action`, which main runs once the
/// command line has been parsed and whose result is the exit code (device_options.h has their names).
namespace tyndall::app {

using Action = std::function<int()>;

void addRenderCommand(CLI::App& app, Action& action);
void addInfoCommand(CLI::App& app, Action& action);
void addCheckCommand(CLI::App& app, Action& action);
void addCompareCommand(CLI::App& app, Action& action);
void addMergeCommand(CLI::App& app, Action& action);
void addBenchCommand(CLI::App& app, Action& action);
void addExportCommand(CLI::App& app, Action& action);
void addDevicesCommand(CLI::App& app, Action& action);
void addVerifyCommand(CLI::App& app, Action& action);

} // namespace tyndall::app

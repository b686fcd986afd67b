// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

/// One function per subcommand: it adds the subcommand's options to `app` and sets `action`, which main runs once the
/// command line has been parsed and whose result is the exit code.
namespace tyndall::app {

using Action = std::function<int()>;

void addRenderCommand(CLI::App& app, Action& action);

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tyndall::app {

/// What `tyndall` alone prints.
inline constexpr const char* kShortHelp =
    "Tyndall renders fog, smoke, clouds and fire.\n"
    "\n"
    "  tyndall render scenes/first.json    a scene, as first.exr and first.png\n"
    "  tyndall render cloud.vdb            a volume: framed, lit and exposed by itself\n"
    "\n"
    "Other commands: info, check, compare, merge, export, verify, bench, devices.\n"
    "`tyndall COMMAND --help` lists a command's options, `tyndall --help` all commands.\n";

/// What is wrong with the command line that gave `error`, and the fix: the nearest known command or option for one
/// that is not known.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error);

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/render_request.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace tyndall::app {

/// Adds the option --set, which can be repeated.
void addSet(CLI::App& command, RenderRequest& request);

/// Adds the subcommand `render` with its options. Parsing fills the request in.
/// @throws Error, while parsing, naming the option, the text and the right form.
std::shared_ptr<RenderRequest> addRenderOptions(CLI::App& app);

} // namespace tyndall::app

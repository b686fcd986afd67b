// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/load.h"

#include <CLI/CLI.hpp>

#include <vector>

/// Options that several commands have.
namespace tyndall::microbench {

/// --size WxH
void addSize(CLI::App& command, glm::uvec2& size);

/// --set guide.key=value, can be repeated.
void addGuideOverrides(CLI::App& command, std::vector<scene::Override>& overrides);

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/findings.h"
#include "scene/json.h"
#include "scene/load.h"

#include <vector>

namespace tyndall::scene {

/// "--set path=value", as it stands in messages.
std::string inWords(const Override& override);

/// Changes the tree as the command line asks, before anything is validated. Objects on the way are made; lists are
/// not lengthened. What cannot be done is reported at the override's position.
void applyOverrides(const std::vector<Override>& overrides, json::Value& root, Findings& findings);

} // namespace tyndall::scene

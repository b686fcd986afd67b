// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/findings.h"
#include "scene/json.h"
#include "scene/load.h"

#include <string>
#include <vector>

namespace tyndall::scene {

/// "--set path=value", as it stands in messages.
std::string inWords(const Override& override);

/// Changes the tree as the command line asks, before anything is validated. Objects on the way are made; lists are
/// not lengthened. What cannot be done is reported at the override's position.
void applyOverrides(const std::vector<Override>& overrides, json::Value& root, Findings& findings);

/// Puts a value at a path. Where that leads nowhere, `position` and `about` are where the finding says so.
void assign(json::Value& root, const std::string& path, json::Value value, const json::Position& position,
            const std::string& about, Findings& findings);

/// The path with numbers for the names of list elements, as far as it leads anywhere.
std::string numberedPath(const json::Value& root, const std::string& path);

/// What stands at a path of numbers and keys; nullptr if nothing does.
const json::Value* valueAt(const json::Value& root, const std::string& path);

} // namespace tyndall::scene

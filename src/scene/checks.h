// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/findings.h"
#include "scene/json.h"
#include "scene/scene.h"

namespace tyndall::scene {

/// What no single key can show: values that contradict each other, and pictures that would be black.
/// `root` tells where things were written. Whatever already has an error is left alone.
void checkScene(const Scene& scene, const json::Value& root, Findings& findings);

} // namespace tyndall::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/findings.h"
#include "scene/json.h"
#include "scene/scene.h"

namespace tyndall::scene {

/// Puts the camera of a glTF file in the place of one of kind File; leaves others alone. Reports a file that cannot be
/// read, one without cameras, and a name that it does not have, with those that it has.
void resolveFileCamera(Camera& camera, double seconds, const json::Value& root, Findings& findings);

} // namespace tyndall::scene

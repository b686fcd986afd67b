// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace tyndall::verify {

/// Phase function in 1/sr, in double, from the papers; `cosine` is that of the angle between the light's directions
/// before and after, +1 straight on.
double phaseOracle(const scene::Phase& phase, double cosine);

} // namespace tyndall::verify

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/replicates.h"
#include "bench/suite.h"

#include <optional>

namespace tyndall::bench {

/// The picture of a scene by quadrature in double, pixels as means over their squares: scenes without objects and
/// grids, one event, lit by points, suns and constant environments. Nothing for any other scene, or one whose
/// arguments change it. Pixels that an edge crosses are not sure, and count for nothing.
std::optional<ExactPicture> exactPicture(const SuiteScene& scene);

} // namespace tyndall::bench

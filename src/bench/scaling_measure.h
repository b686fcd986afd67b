// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/measure.h"
#include "bench/scaling.h"
#include "bench/scaling_scenes.h"

namespace tyndall::bench {

/// Renders every value of an axis by runs of the program, in turn seed by seed, each with few and with many samples. A
/// value that would take more than the options' seconds, or more memory than is free, or that fails, is left out, and so
/// are those above it.
/// @param options seeds at least 2; the scenes are made in its folder. @param arguments of `tyndall render`, for all.
/// @throws Error if a run fails that did not at first.
ScalingCurve measureScaling(const ScalingPlan& plan, const MeasureOptions& options,
                            const std::vector<std::string>& arguments, const Say& say);

} // namespace tyndall::bench

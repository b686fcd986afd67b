// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/line_chart.h"
#include "bench/scaling.h"

namespace tyndall::bench {

/// Microseconds of a sample over the axis, and what theory says, dashed.
LineChart scalingChart(const ScalingCurve& curve);

/// A section of the page for all curves.
std::string scalingSection(const std::vector<ScalingCurve>& curves);

} // namespace tyndall::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/line_chart.h"
#include "bench/results.h"

#include <string>

namespace tyndall::bench {

/// The report as one HTML page with nothing from elsewhere: tables, charts, pictures with maps of their errors.
std::string htmlPage(const Report& report);

/// Error over CPU time of a scene, with intervals.
LineChart errorChart(const SceneResult& scene);

/// "1.2 s", "~34 s" where it is extrapolated, "< 0.4 s" where the least effort is better, "never".
std::string crossingText(const Crossing& crossing);

/// What a bound costs a contender, over what it costs the first one; empty where one of them never gets there.
std::string ratioText(const Crossing& theirs, const Crossing& ours, std::size_t runs);

} // namespace tyndall::bench

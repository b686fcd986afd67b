// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/measure.h"

#include <string>
#include <vector>

/// Benchmarks whose scenes are made for them: no suite file says what they render.
namespace tyndall::app {

struct MadeBenchmark {
  std::string name;
  std::string title;
};

/// By name; null: it is none of these.
const MadeBenchmark* findMade(const std::string& name);

/// Says what `tyndall bench` can make by itself.
void listMade(const MadeBenchmark& benchmark);

struct MadeOptions {
  bench::MeasureOptions measure;  ///< with its folder
  std::vector<std::string> parts; ///< names of those to take; empty: all
  std::string device;
};

/// Puts what was measured into the report. @throws Error for a part that it does not have.
void measureMade(const MadeBenchmark& benchmark, const MadeOptions& options, const bench::Say& say,
                 bench::Report& report);

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microbench/guiding_statistics.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tyndall::microbench {

/// What the renders of one contestant gave, seed by seed.
struct RunFigures {
  std::string name;
  Pictures pictures;         ///< luminance
  std::vector<double> cpu;   ///< process time [s]
  std::vector<double> wall;  ///< [s]
  double guidedShare = 0.0;  ///< of directions
  double bytes = 0.0;        ///< that guiding takes on the device
  std::uint64_t unsound = 0; ///< samples and states that were not finite, lookups beyond majorants: there must be none
};

/// Of the contestants, all on the same scene and in turn; the first one is the reference.
struct Race {
  std::string scene;
  bool lightSampling = true;
  bool byWall = false; ///< seconds are wall time: on devices that are no CPU
  std::vector<RunFigures> runs;
};

/// Variance of a pixel and what it is worth.
struct Noise {
  double variance = 0.0; ///< mean over the pixels
  Gains gains;           ///< over the reference
};

struct GuidingRow {
  std::string scene;
  bool lightSampling = true;
  std::string name;
  bool reference = false;
  Mean mean;      ///< of the image
  double z = 0.0; ///< of the mean against the reference's, in standard errors of their difference
  Noise trimmed;  ///< worst pixels of the race left out
  Noise all;
  Noise relative;   ///< as trimmed, of relMSE: dim places count as much as bright ones
  double cpu = 0.0; ///< seconds of a render, median
  double wall = 0.0;
  double guidedShare = 0.0;
  double bytes = 0.0;
  std::uint64_t unsound = 0;
};

/// Of the pixels: a variance over few seeds is that of its worst ones, and they differ from run to run.
inline constexpr double kTrimmedShare = 0.001;

std::vector<GuidingRow> rowsOf(const Race& race);

/// What is not a number becomes null.
nlohmann::ordered_json toJson(const GuidingRow& row);

/// Heading of the table, and a line of it.
std::string tableHead();
std::string tableLine(const GuidingRow& row);

} // namespace tyndall::microbench

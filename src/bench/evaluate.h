// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/contender.h"
#include "bench/results.h"

/// From what was rendered to what is reported.
namespace tyndall::bench {

/// What an effort of a contender has given so far.
struct Measured {
  LevelPlan plan;
  Replicates pictures;
  std::vector<double> cpu;
  std::vector<double> wall;
  double peakBytes = 0.0;
  std::vector<Json> statistics; ///< of ours
  std::filesystem::path first;  ///< picture of the first seed
};

/// What a contender has given of a scene.
struct Rendered {
  const Contender* contender = nullptr;
  std::vector<Measured> levels;
  std::string refusal; ///< why there is nothing
};

/// How pictures are shown: as the scene says.
struct Showing {
  double exposureStops = 0.0;
  std::string view;
};

/// @param against the pictures that made the reference; none where it is exact
ContenderResult evaluate(const Rendered& rendered, const Reference& reference, const Replicates& against,
                         const Showing& showing);

} // namespace tyndall::bench

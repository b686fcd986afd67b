// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/figure.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// Cost against the size of what is rendered, as plain values.
namespace tyndall::bench {

struct ScalingPoint {
  double value = 0.0;        ///< on the curve's axis
  double theory = 0.0;       ///< what the cost ought to be, relative to other points
  std::string leftOut;       ///< why there are no figures; empty: there are
  double samples = 0.0;      ///< per pixel, of the greater effort
  Figure cost;               ///< [us] of a sample beyond start-up
  Figure errorTime;          ///< relative variance of the pixels times the seconds that their samples took
  double startSeconds = 0.0; ///< of a picture without samples
  double deviceBytes = 0.0;
  double hostBytes = 0.0;
};

struct ScalingCurve {
  std::string name;
  std::string title;
  std::string axis;
  std::string clock;   ///< what its seconds are: "CPU" or "wall"
  std::string theory;  ///< what the points' theory says, in words
  double anchor = 0.0; ///< the measured point nearest to this value is where theory is made equal
  std::size_t seeds = 0;
  std::vector<ScalingPoint> points; ///< by rising value
};

/// The points that have been measured.
std::vector<ScalingPoint> measuredPoints(const ScalingCurve& curve);

/// What theory says of each measured point [us], made equal to the measurement at the anchor.
std::vector<double> theoryCosts(const ScalingCurve& curve);

/// What is seen, in words: how much cost, error and memory grow from the first point to the last, and what is left out.
std::string findingOf(const ScalingCurve& curve);

nlohmann::ordered_json toJson(const ScalingCurve& curve);

} // namespace tyndall::bench

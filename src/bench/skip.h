// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/figure.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// What features cost where a scene does not need them, as plain values.
namespace tyndall::bench {

/// Of a pipeline of pass `path`.
struct PipelineCost {
  double deviceBytes = 0.0;    ///< the scene and all that the pass keeps
  double moduleBytes = 0.0;    ///< specialised, as the driver gets it
  double compileSeconds = 0.0; ///< and a first dispatch of one sample of 64 pixels
};

/// A scene that does without a feature, rendered without its code, as the renderer does, and with it.
struct SkipRow {
  std::string scene;
  std::string feature;
  double microseconds = 0.0; ///< of a sample without it
  Figure time;               ///< with it over without it, in turn
  PipelineCost without;
  PipelineCost with;
  std::string pictures; ///< of the same seeds: "same bits", or how many standard errors their means are apart
};

/// A whole method on a scene.
struct MethodRow {
  std::string scene;
  std::string method;
  double microseconds = 0.0; ///< of a sample
  double sceneBytes = 0.0;
  double surfaceBytes = 0.0; ///< of those
  double passBytes = 0.0;    ///< pixels, sums, suspended states, light caches
  double firstSeconds = 0.0; ///< of making the estimator, and a first dispatch
};

struct SkipTable {
  std::string clock; ///< what its seconds are: "CPU" or "wall"
  std::size_t repeats = 0;
  std::vector<SkipRow> features;
  std::vector<MethodRow> methods;
};

nlohmann::ordered_json toJson(const SkipTable& table);

/// A section of the page.
std::string skipSection(const SkipTable& table);

} // namespace tyndall::bench

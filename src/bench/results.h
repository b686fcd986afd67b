// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bare_rates.h"
#include "bench/crossing.h"
#include "bench/replicates.h"
#include "bench/scaling.h"
#include "bench/skip.h"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

/// What a benchmark found, as plain values: all that the page shows and the JSON file holds.
namespace tyndall::bench {

using Json = nlohmann::ordered_json;

/// Work that the device counted, of one picture. It does not depend on how busy the machine is.
struct Work {
  double samples = 0.0;
  double lookups = 0.0;  ///< of densities, by tracking and paths
  double segments = 0.0; ///< walks and rays from a point to a point
  double pieces = 0.0;   ///< of rays through cells, by the march
  double dispatches = 0.0;
};

/// Parts of a run of ours. Wall seconds, medians; bytes.
struct Parts {
  double start = 0.0; ///< the program and the device
  double load = 0.0;  ///< scene and volumes
  double upload = 0.0;
  double pipeline = 0.0; ///< the estimator: light caches, pipelines, what of compiling is done ahead
  double first = 0.0;    ///< the first dispatch, with the rest of compiling
  double render = 0.0;   ///< all dispatches
  double write = 0.0;
  double deviceBytes = 0.0;
  double kernelBytes = 0.0;
};

/// A contender's pictures of a scene at one effort.
struct Level {
  std::string label;    ///< "16", or the settings of a program that takes no samples
  double samples = 0.0; ///< per pixel; 0: the program takes none
  std::size_t runs = 0;
  Errors errors;
  Figure cpu;  ///< [s] of the whole process
  Figure wall; ///< [s]
  double peakBytes = 0.0;
  std::optional<Work> work;
  std::optional<Parts> parts;
};

/// Seconds until a picture is right to a bound.
struct Target {
  std::string measure; ///< "relMSE" or "rRMSE"
  double bound = 0.0;
  Crossing cpu;
  Crossing wall;
};

struct ContenderResult {
  std::string name;
  std::string title;
  bool ours = false;
  std::string refusal; ///< why it has no pictures; empty: it has
  std::vector<Level> levels;
  std::vector<Target> targets;
  Bias bias;
  /// relMSE times CPU seconds without those that the smallest effort takes too: what a second more buys.
  std::optional<Figure> efficiency;
  std::string picture; ///< of one seed at the highest effort, PNG; not in the JSON
  std::string map;     ///< relative error of its pixels after a CPU second, PNG; not in the JSON
};

struct SceneResult {
  std::string name;
  std::string title;
  glm::uvec2 size{0};
  std::string estimator; ///< of the first contender of ours, and why it was chosen
  std::string device;    ///< that ours ran on, and its driver
  std::string reference; ///< what errors are measured against
  std::vector<ContenderResult> contenders;
};

struct Report {
  std::string suite;
  std::string title;
  std::string command;
  std::string date;
  std::map<std::string, std::string> machine; ///< processor, device, driver, versions
  std::size_t seeds = 0;
  std::vector<SceneResult> scenes;
  std::optional<BareRates> bare = {};
  std::vector<ScalingCurve> scaling = {};
  std::optional<SkipTable> skip = {};
};

Json toJson(const Report& report);

/// What a regression is told by, read back. @throws Error naming `file` if it is not such a report.
Report reportFromJson(const std::string& text, const std::string& file);

/// Of the same name, or null.
const ContenderResult* findContender(const SceneResult& scene, const std::string& name);

} // namespace tyndall::bench

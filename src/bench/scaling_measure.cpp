// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling_measure.h"

#include "base/error.h"
#include "base/file.h"
#include "bench/process.h"
#include "bench/replicates.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

constexpr std::uint32_t kFewSamples = 16; ///< a batch, which has its own strata
constexpr std::uint32_t kMostSamples = 1u << 20;
/// That many samples take longer than few: well above the noise of start-up, and by the clock of what else runs.
constexpr double kWantedSeconds = 0.4;
constexpr double kWantedWallSeconds = 2.0;
constexpr double kWantedShare = 0.5; ///< of a long start-up, whose noise is as long
constexpr double kLeastGrowth = 4.0; ///< of the number of samples
constexpr double kMostGrowth = 64.0;
constexpr double kMemoryShare = 0.7; ///< of what is free that a run may take

struct Outcome {
  double seconds = 0.0;
  double deviceBytes = 0.0;
  double hostBytes = 0.0;
  bool onCpu = true;
  std::string problem; ///< why there is no picture
};

/// A value on its way.
struct Value {
  ScalingRun run;
  std::uint32_t many = 0; ///< samples
  std::vector<double> fewSeconds;
  std::vector<double> manySeconds;
  Replicates pictures;

  double pixels() const { return double(run.size.x) * double(run.size.y); }
};

double freeBytes() { return double(sysconf(_SC_AVPHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)); }

Figure meanOf(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double each : values) {
    mean += each / double(values.size());
  }
  double variance = 0.0;
  for (const double each : values) {
    variance += (each - mean) * (each - mean) / (double(values.size()) - 1.0);
  }
  return {mean, std::sqrt(variance / double(values.size())) / mean};
}

class CurveRun {
public:
  CurveRun(const ScalingPlan& plan, const MeasureOptions& options, const std::vector<std::string>& arguments)
      : plan_(plan), options_(options), arguments_(arguments) {
    TYNDALL_CHECK(options.seeds >= 2);
    curve_ = {plan.name,   plan.title,  plan.axis,     plan.wallClock ? "wall" : "CPU",
              plan.theory, plan.anchor, options.seeds, {}};
  }

  ScalingCurve run() {
    for (const double value : plan_.values) {
      curve_.points.push_back({});
      curve_.points.back().value = value;
      curve_.points.back().theory = plan_.cost(value);
      curve_.points.back().leftOut = tooMuch();
      values_.emplace_back();
      if (curve_.points.back().leftOut.empty()) {
        prepare(curve_.points.back(), values_.back());
      }
    }
    for (std::uint32_t seed = 0; seed < options_.seeds; ++seed) {
      for (std::size_t i = 0; i < values_.size(); ++i) {
        if (curve_.points[i].leftOut.empty()) {
          renderBoth(values_[i], seed);
        }
      }
    }
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (curve_.points[i].leftOut.empty()) {
        evaluate(curve_.points[i], values_[i]);
      }
    }
    return curve_;
  }

private:
  /// Why the last point is not even tried, from the one before it: it ought to take the same, times theory.
  std::string tooMuch() const {
    const std::size_t count = curve_.points.size();
    if (count < 2) {
      return {};
    }
    const ScalingPoint& before = curve_.points[count - 2];
    if (!before.leftOut.empty()) {
      return before.leftOut;
    }
    const ScalingPoint& last = curve_.points.back();
    if (fewSeconds_ * last.theory / before.theory > options_.limitSeconds) {
      return fmt::format("would take more than the {} s of --limit", shortText(options_.limitSeconds));
    }
    const double first = curve_.points.front().hostBytes;
    const double growth = plan_.size(last.value) / plan_.size(before.value);
    const double expected = before.hostBytes + growth * (before.hostBytes - first);
    if (expected > kMemoryShare * freeBytes()) {
      return fmt::format("would take about {} MB of memory, of {} MB that are free", shortText(1e-6 * expected),
                         shortText(1e-6 * freeBytes()));
    }
    return {};
  }

  /// Makes the scene, warms the shader caches and finds how many samples take long enough.
  void prepare(ScalingPoint& point, Value& value) {
    value.run = plan_.make(point.value, options_.folder);
    const Outcome few = render(value, kFewSamples, 0);
    fewSeconds_ = few.seconds;
    point.leftOut = plan_.wallClock && !few.onCpu ? "threads are the CPU device's" : few.problem;
    point.deviceBytes = few.deviceBytes;
    point.hostBytes = few.hostBytes;
    if (point.leftOut.empty()) {
      chooseMany(point, value, few.seconds);
    }
  }

  /// The first run may have met cold caches: then samples seem to take less, and there are more than wanted.
  void chooseMany(ScalingPoint& point, Value& value, double few) const {
    const double wanted = std::max(plan_.wallClock ? kWantedWallSeconds : kWantedSeconds, kWantedShare * few);
    double growth = kLeastGrowth;
    for (value.many = kFewSamples; value.many < kMostSamples;) {
      const std::uint32_t before = value.many;
      value.many *= std::uint32_t(growth);
      const Outcome outcome = render(value, value.many, 0);
      if (!outcome.problem.empty()) {
        point.leftOut = before > kFewSamples ? std::string() : outcome.problem;
        value.many = before;
        return;
      }
      const double spent = outcome.seconds;
      if (spent - few >= wanted || kLeastGrowth * spent > options_.limitSeconds) {
        return;
      }
      const double missing = std::clamp(wanted / std::max(spent - few, 1e-3), kLeastGrowth, kMostGrowth);
      growth = std::exp2(std::ceil(std::log2(std::min(missing, options_.limitSeconds / spent))));
    }
  }

  void renderBoth(Value& value, std::uint32_t seed) {
    for (const bool many : {false, true}) {
      const Outcome outcome = render(value, many ? value.many : kFewSamples, seed);
      if (!outcome.problem.empty()) {
        fail("{}: {}, which it did not before; let the machine rest, or raise --limit", value.run.scene.string(),
             outcome.problem);
      }
      (many ? value.manySeconds : value.fewSeconds).push_back(outcome.seconds);
    }
    value.pictures.push_back(readPicture(outputOf(value)));
  }

  void evaluate(ScalingPoint& point, const Value& value) const {
    const double more = value.pixels() * double(value.many - kFewSamples);
    std::vector<double> slopes;
    std::vector<double> starts;
    for (std::size_t i = 0; i < value.fewSeconds.size(); ++i) {
      const double slope = (value.manySeconds[i] - value.fewSeconds[i]) / more;
      slopes.push_back(1e6 * slope);
      starts.push_back(value.fewSeconds[i] - slope * value.pixels() * kFewSamples);
    }
    point.samples = value.many;
    point.cost = meanOf(slopes);
    point.startSeconds = median(starts);
    const Errors errors = errorsOf(value.pictures, referenceOf(bench::meanOf(value.pictures), false));
    const Figure squared{errors.rRmse.value * errors.rRmse.value, 2.0 * errors.rRmse.logError};
    point.errorTime = squared * point.cost;
    point.errorTime.value *= 1e-6 * value.pixels() * double(value.many);
    if (point.cost.value <= 0.0) {
      point.leftOut = "too quick to be told from start-up";
    }
  }

  std::filesystem::path outputOf(const Value& value) const {
    return options_.folder / (value.run.scene.stem().string() + ".exr");
  }

  Outcome render(const Value& value, std::uint32_t samples, std::uint32_t seed) const {
    const std::filesystem::path output = outputOf(value);
    const std::filesystem::path statistics = options_.folder / (value.run.scene.stem().string() + ".stats.json");
    std::vector<std::string> command{options_.program.string(), "render", value.run.scene.string(), "--quiet"};
    const auto add = [&](const std::vector<std::string>& words) {
      command.insert(command.end(), words.begin(), words.end());
    };
    add({"-o", output.string(), "--stats", statistics.string(), "--aov", "transmittance"});
    add({"--size", fmt::format("{}x{}", value.run.size.x, value.run.size.y), "--spp", std::to_string(samples)});
    add({"--seed", std::to_string(options_.firstSeed + seed)});
    add(plan_.arguments);
    add(arguments_);
    std::vector<std::string> environment;
    if (const unsigned threads = value.run.threads > 0 ? value.run.threads : options_.threads; threads > 0) {
      environment.push_back(fmt::format("LP_NUM_THREADS={}", threads)); // read by the CPU device
    }
    const ProcessOutcome outcome = runProcess(command, environment, options_.limitSeconds);
    if (outcome.timedOut) {
      return {.problem = fmt::format("takes more than the {} s of --limit", shortText(options_.limitSeconds))};
    }
    if (outcome.exitCode != 0) {
      return {.problem = "fails: " + lastLine(outcome.errors)};
    }
    const Json json = Json::parse(readTextFile(statistics));
    const bool onCpu = json.at("/device/type"_json_pointer) == "cpu";
    return Outcome{plan_.wallClock || !onCpu ? outcome.wall : outcome.cpu,
                   json.at("/device_bytes/peak"_json_pointer).get<double>(),
                   double(outcome.peakBytes),
                   onCpu,
                   {}};
  }

  const ScalingPlan& plan_;
  const MeasureOptions& options_;
  const std::vector<std::string>& arguments_;
  ScalingCurve curve_;
  std::vector<Value> values_;
  double fewSeconds_ = 0.0; ///< of the last value that was prepared
};

} // namespace

ScalingCurve measureScaling(const ScalingPlan& plan, const MeasureOptions& options,
                            const std::vector<std::string>& arguments, const Say& say) {
  ScalingCurve curve = CurveRun(plan, options, arguments).run();
  say(fmt::format("{}: {}", curve.name, findingOf(curve)));
  return curve;
}

} // namespace tyndall::bench

// SPDX-License-Identifier: Apache-2.0
#include "microbench/commands.h"
#include "microbench/contender.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;
using render::Method;

constexpr std::array<std::uint32_t, 3> kPassSamples{16, 4, 1};

/// One scene with all estimators on it. Members are destroyed after what borrows them.
struct Trial {
  Trial(std::string title, BenchScene made, const Session& session)
      : name(std::move(title)), scene(std::move(made)), pixels(measuredPixels(scene)),
        atlas(session.device, scene.scene, scene.volumes, render::layoutOf(Method::Tracking)),
        cells(session.device, scene.scene, scene.volumes, render::layoutOf(Method::March)),
        build(buildCaches(session.device, cells, scene.volumes, session.options.cacheBytes, 3)) {
    render::EstimatorOptions march;
    march.method = Method::March;
    march.cacheBytes = session.options.cacheBytes;
    render::EstimatorOptions preview = march;
    preview.preview = true;
    render::EstimatorOptions delta;
    delta.deltaTracking = true;
    contenders.emplace_back("tracking", session.device, scene, atlas, render::EstimatorOptions{});
    contenders.emplace_back("delta tracking", session.device, scene, atlas, delta);
    contenders.emplace_back("march", session.device, scene, cells, march);
    contenders.emplace_back("preview", session.device, scene, cells, preview);
  }

  const Contender& tracking() const { return contenders[0]; }
  const Contender& march() const { return contenders[2]; }

  std::string name;
  BenchScene scene;
  std::vector<std::uint32_t> pixels;
  gpu_scene::GpuScene atlas;
  gpu_scene::GpuScene cells;
  CacheBuild build;
  std::vector<Contender> contenders;
};

/// Every contender in turn, so that what else the machine does meets all alike.
void runAll(Trial& trial, std::uint32_t repeats) {
  for (std::uint32_t repeat = 0; repeat <= repeats; ++repeat) {
    for (Contender& contender : trial.contenders) {
      for (const std::uint32_t samples : kPassSamples) {
        contender.run(trial.pixels, samples, repeat, repeat == 0); // the first round compiles
      }
    }
  }
}

struct Row {
  const Contender& contender;
  std::uint32_t samples;
  Figure seconds;
  Figure variance;
  Figure product{};
  Figure gain{};       ///< tracking's product over this one's, at the same sample count
  double square = 0.0; ///< mean square of the reference
  double build = 0.0;  ///< seconds
  Difference bias{};   ///< against the march
};

Row rowFor(const Trial& trial, const Contender& contender, std::uint32_t samples,
           const std::vector<std::size_t>& covered, const gpu::Device& device) {
  const Pictures& longRun = trial.march().passes(16).pictures;
  const auto productOf = [&](const Contender& each) {
    return meanVariance(each.passes(samples).pictures, covered) * medianTime(each.passes(samples).seconds);
  };
  Row row{.contender = contender,
          .samples = samples,
          .seconds = medianTime(contender.passes(samples).seconds),
          .variance = meanVariance(contender.passes(samples).pictures, covered)};
  row.product = productOf(contender);
  row.gain = productOf(trial.tracking()) / row.product;
  if (&contender == &trial.tracking()) {
    row.gain = {1.0, 0.0};
  }
  row.square = meanSquare(meanPicture(longRun), covered);
  const bool march = contender.options().method == Method::March;
  row.build = march ? secondsOf(trial.build.cost, device) : 0.0;
  if (&contender != &trial.march()) {
    row.bias = difference(contender.passes(16).pictures, longRun, covered, contender.options().preview);
  }
  return row;
}

/// Time to a relative error, as if batches of this pass were added up: asymptotic, and never below one pass.
double secondsTo(const Row& row, double error) { return row.product.value / (error * error * row.square); }

std::string range(const Figure& figure, std::size_t repeats) {
  const Interval ends = interval(figure, repeats);
  return fmt::format("[{}, {}]", shortText(ends.low), shortText(ends.high));
}

Json toJson(const Row& row, std::size_t repeats) {
  const Passes& passes = row.contender.passes(row.samples);
  const double samples = double(passes.spent.samples);
  double seconds = 0.0;
  for (const double each : passes.seconds) {
    seconds += each;
  }
  const Interval product = interval(row.product, repeats);
  const Interval gain = interval(row.gain, repeats);
  return {{"estimator", row.contender.name()},
          {"samplesPerPixel", row.samples},
          {"buildSeconds", row.build},
          {"secondsPerPass", row.seconds.value},
          {"variance", row.variance.value},
          {"varianceTimesSeconds", row.product.value},
          {"varianceTimesSecondsInterval", {product.low, product.high}},
          {"gainOverTracking", row.gain.value},
          {"gainInterval", {gain.low, gain.high}},
          {"rRmse", std::sqrt(row.variance.value / row.square)},
          {"secondsTo5Percent", secondsTo(row, 0.05)},
          {"secondsTo1Percent", secondsTo(row, 0.01)},
          {"readsPerSample", double(passes.spent.lookups) / samples},
          {"readsPerSecond", double(passes.spent.lookups) / seconds},
          {"samplesPerSecond", samples / seconds},
          {"biasOfMean", row.bias.mean},
          {"biasError", row.bias.meanError},
          {"biasRms", row.bias.rms},
          {"nonFinite", passes.spent.nonFinite},
          {"cut", passes.spent.cut}};
}

std::string biasText(const Row& row) {
  if (row.contender.options().method == Method::March && !row.contender.options().preview) {
    return "";
  }
  const std::string mean = fmt::format("{:+.3f} % (error {:.3f})", 100.0 * row.bias.mean, 100.0 * row.bias.meanError);
  // Of an unbiased estimator the rms over pixels is nothing but what its noise leaves.
  return row.contender.options().preview ? fmt::format("{}, rms {:.2f} %", mean, 100.0 * row.bias.rms) : mean;
}

void printWide(const std::vector<Row>& rows, std::size_t repeats) {
  fmt::print("{:<15}{:>9}{:>9}{:>10}{:>10} {:<21}{:>8} {:<16}{:>9}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}  {}\n", "16 spp",
             "build s", "s", "V", "V s", "", "gain", "", "rRMSE %", "s to 5 %", "to 1 %", "5 % + b", "1 % + b",
             "reads/n", "Mreads/s", "Mn/s", "mean against the march");
  for (const Row& row : rows) {
    const Json j = toJson(row, repeats);
    const auto number = [&](const char* key, double scale) { return shortText(scale * j.at(key).get<double>()); };
    fmt::print("{:<15}{:>9}{:>9}{:>10}{:>10} {:<21}{:>8} {:<16}{:>9}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}  {}\n",
               row.contender.name(), shortText(row.build), shortText(row.seconds.value), shortText(row.variance.value),
               shortText(row.product.value), range(row.product, repeats), shortText(row.gain.value),
               range(row.gain, repeats), number("rRmse", 100.0), number("secondsTo5Percent", 1.0),
               number("secondsTo1Percent", 1.0), shortText(secondsTo(row, 0.05) + row.build),
               shortText(secondsTo(row, 0.01) + row.build), number("readsPerSample", 1.0),
               number("readsPerSecond", 1e-6), number("samplesPerSecond", 1e-6), biasText(row));
    const render::Totals& spent = row.contender.passes(row.samples).spent;
    if (spent.nonFinite > 0 || spent.cut > 0) {
      fmt::print("  {} samples were not finite, {} rays were cut\n", spent.nonFinite, spent.cut);
    }
  }
}

void printShort(const std::vector<Row>& rows, std::size_t repeats) {
  fmt::print("\n{:<15}{:>8}{:>8}{:>10}{:>10}{:>8} {:<16}{:>8}{:>8}\n", "", "spp", "s", "V", "V s", "gain", "",
             "rRMSE %", "s to 1%");
  for (const Row& row : rows) {
    fmt::print("{:<15}{:>8}{:>8}{:>10}{:>10}{:>8} {:<16}{:>8}{:>8}\n", row.contender.name(), row.samples,
               shortText(row.seconds.value), shortText(row.variance.value), shortText(row.product.value),
               shortText(row.gain.value), range(row.gain, repeats),
               shortText(100.0 * std::sqrt(row.variance.value / row.square)), shortText(secondsTo(row, 0.01)));
  }
}

Json runTrial(Trial& trial, const Session& session) {
  runAll(trial, session.options.repeats);
  const std::vector<std::size_t> covered = coveredPixels(trial.march().passes(16));
  Json report{{"scene", trial.name},
              {"coveredPixels", covered.size()},
              {"measuredPixels", trial.pixels.size()},
              {"cacheBytes", trial.build.bytes},
              {"rows", Json::array()}};
  fmt::print("\n{}: {} pixels, {} of them count; caches: {:.2f} MB\n", trial.name, trial.pixels.size(), covered.size(),
             trial.build.bytes * 1e-6);
  std::vector<Row> wide;
  std::vector<Row> narrow;
  for (const std::uint32_t samples : kPassSamples) {
    for (const Contender& contender : trial.contenders) {
      std::vector<Row>& rows = samples == 16 ? wide : narrow;
      rows.push_back(rowFor(trial, contender, samples, covered, session.device));
      report["rows"].push_back(toJson(rows.back(), session.options.repeats));
    }
  }
  printWide(wide, session.options.repeats);
  printShort(narrow, session.options.repeats);
  std::fflush(stdout);
  return report;
}

} // namespace

Json estimatorsReport(const Session& session) {
  Json report = Json::array();
  const Options& options = session.options;
  const auto take = [&](const std::string& name, BenchScene scene) {
    Trial trial(name, std::move(scene), session);
    report.push_back(runTrial(trial, session));
  };
  for (const double factor : {0.1, 1.0, 10.0}) {
    const double depth = factor * options.opticalDepth;
    take(fmt::format("sun, optical depth {}", depth), sunScene(session.grid, depth, options.size));
  }
  take(fmt::format("point light in fog, optical depth {}", options.opticalDepth),
       foggyPointScene(session.grid, options.opticalDepth, options.size));
  return report;
}

} // namespace tyndall::microbench

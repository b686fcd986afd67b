// SPDX-License-Identifier: Apache-2.0
#include "microbench/guiding_rows.h"

#include "base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numeric>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kLine =
    "{:<18}{:<7}{:<22}{:>8}{:>8}{:>10}  {:<26}{:<26}{:>10}  {:<26}{:<26}{:>10}  {:<26}{:<26}{:>19}{:>6}{:>8}{:>8}\n";

std::vector<std::size_t> allPixels(const Race& race) {
  std::vector<std::size_t> pixels(race.runs.front().pictures.front().size());
  std::iota(pixels.begin(), pixels.end(), std::size_t{0});
  return pixels;
}

std::vector<std::size_t> trimmedPixels(const Race& race) {
  std::vector<std::vector<double>> variances;
  for (const RunFigures& run : race.runs) {
    variances.push_back(pixelVariances(run.pictures));
  }
  return withoutWorst(variances, kTrimmedShare);
}

/// The pictures over the root of r^2 + eps^2, of which variances are relMSEs: r is the mean of all that raced, eps 1 %
/// of its mean.
Race relativeTo(const Race& race) {
  constexpr double kEpsilon = 0.01;
  std::vector<double> mean(race.runs.front().pictures.front().size(), 0.0);
  for (const RunFigures& run : race.runs) {
    const std::vector<double> own = meanPicture(run.pictures);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] += own[i] / double(race.runs.size());
    }
  }
  const double epsilon = kEpsilon * std::accumulate(mean.begin(), mean.end(), 0.0) / double(mean.size());
  Race result = race;
  for (RunFigures& run : result.runs) {
    for (std::vector<double>& picture : run.pictures) {
      for (std::size_t i = 0; i < picture.size(); ++i) {
        const double scale = std::hypot(mean[i], epsilon);
        picture[i] = scale > 0.0 ? picture[i] / scale : 0.0;
      }
    }
  }
  return result;
}

const std::vector<double>& secondsOf(const Race& race, const RunFigures& run) {
  return race.byWall ? run.wall : run.cpu;
}

Noise noiseOf(const Race& race, const RunFigures& run, const std::vector<std::size_t>& pixels) {
  const RunFigures& first = race.runs.front();
  const RunProducts own(run.pictures, pixels);
  if (&run == &first) {
    constexpr Gain kNone{1.0, {1.0, 1.0}};
    return {own.variance(), {kNone, kNone}};
  }
  const RunProducts reference(first.pictures, pixels);
  return {own.variance(), gainsOver({reference, secondsOf(race, first)}, {own, secondsOf(race, run)})};
}

double deviation(const Mean& mean, const Mean& reference) {
  return (mean.value - reference.value) / std::hypot(mean.error, reference.error);
}

Json toJson(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json toJson(const Gain& gain) {
  return {{"value", toJson(gain.value)}, {"interval", {toJson(gain.range.low), toJson(gain.range.high)}}};
}

Json toJson(const Noise& noise) {
  return {{"variance", toJson(noise.variance)},
          {"gainAtEqualSamples", toJson(noise.gains.samples)},
          {"gainInVarianceTimesTime", toJson(noise.gains.time)}};
}

std::string gainText(const GuidingRow& row, const Gain& gain) {
  if (row.reference) {
    return "1";
  }
  if (!std::isfinite(gain.value)) {
    return "-";
  }
  return fmt::format("{} [{}, {}]", shortText(gain.value), shortText(gain.range.low), shortText(gain.range.high));
}

} // namespace

std::vector<GuidingRow> rowsOf(const Race& race) {
  TYNDALL_CHECK(!race.runs.empty());
  const std::vector<std::size_t> all = allPixels(race);
  const std::vector<std::size_t> trimmed = trimmedPixels(race);
  const Race relative = relativeTo(race);
  const std::vector<std::size_t> trimmedRelative = trimmedPixels(relative);
  const Mean reference = imageMean(race.runs.front().pictures);
  std::vector<GuidingRow> rows;
  for (const RunFigures& run : race.runs) {
    const bool first = rows.empty();
    const RunFigures& relativeRun = relative.runs[rows.size()];
    const Mean mean = imageMean(run.pictures);
    rows.push_back({.scene = race.scene,
                    .lightSampling = race.lightSampling,
                    .name = run.name,
                    .reference = first,
                    .mean = mean,
                    .z = first ? 0.0 : deviation(mean, reference),
                    .trimmed = noiseOf(race, run, trimmed),
                    .all = noiseOf(race, run, all),
                    .relative = noiseOf(relative, relativeRun, trimmedRelative),
                    .cpu = median(run.cpu),
                    .wall = median(run.wall),
                    .guidedShare = run.guidedShare,
                    .bytes = run.bytes,
                    .unsound = run.unsound});
  }
  return rows;
}

Json toJson(const GuidingRow& row) {
  return {{"scene", row.scene},
          {"lightSampling", row.lightSampling},
          {"name", row.name},
          {"reference", row.reference},
          {"mean", toJson(row.mean.value)},
          {"meanError", toJson(row.mean.error)},
          {"z", toJson(row.z)},
          {"trimmed", toJson(row.trimmed)},
          {"untrimmed", toJson(row.all)},
          {"relative", toJson(row.relative)},
          {"cpuSeconds", row.cpu},
          {"wallSeconds", row.wall},
          {"guidedShare", row.guidedShare},
          {"guidingBytes", row.bytes},
          {"unsound", row.unsound}};
}

std::string tableHead() {
  return fmt::format(kLine, "scene", "lights", "directions", "CPU s", "wall s", "V trimmed", "gain, equal samples",
                     "gain, V s", "V all", "gain, equal samples", "gain, V s", "relMSE", "gain, equal samples",
                     "gain, relMSE s", "mean (error)", "z", "guided", "MB");
}

std::string tableLine(const GuidingRow& row) {
  return fmt::format(kLine, row.scene, row.lightSampling ? "on" : "off", row.name, shortText(row.cpu),
                     shortText(row.wall), shortText(row.trimmed.variance), gainText(row, row.trimmed.gains.samples),
                     gainText(row, row.trimmed.gains.time), shortText(row.all.variance),
                     gainText(row, row.all.gains.samples), gainText(row, row.all.gains.time),
                     shortText(row.relative.variance), gainText(row, row.relative.gains.samples),
                     gainText(row, row.relative.gains.time),
                     fmt::format("{} ({})", shortText(row.mean.value), shortText(row.mean.error)),
                     row.reference || !std::isfinite(row.z) ? "-" : fmt::format("{:+.1f}", row.z),
                     fmt::format("{:.0f} %", 100.0 * row.guidedShare), shortText(row.bytes * 1e-6)) +
         (row.unsound > 0
              ? fmt::format("  NOT SOUND: {} samples, lookups or states are not finite or beyond their bound\n",
                            row.unsound)
              : "");
}

} // namespace tyndall::microbench

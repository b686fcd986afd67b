// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tyndall::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string growth(const Figure& last, const Figure& first, std::size_t seeds) {
  const Figure ratio = last / first;
  return seeds >= 2 ? rangeText(ratio, seeds) : shortText(ratio.value);
}

Json toJson(const Figure& figure) { return {{"value", figure.value}, {"log_error", figure.logError}}; }

} // namespace

std::vector<ScalingPoint> measuredPoints(const ScalingCurve& curve) {
  std::vector<ScalingPoint> points;
  std::ranges::copy_if(curve.points, std::back_inserter(points),
                       [](const ScalingPoint& point) { return point.leftOut.empty(); });
  return points;
}

std::vector<double> theoryCosts(const ScalingCurve& curve) {
  const std::vector<ScalingPoint> points = measuredPoints(curve);
  std::vector<double> costs;
  if (points.empty()) {
    return costs;
  }
  const ScalingPoint& anchor = *std::ranges::min_element(
      points, {}, [&](const ScalingPoint& point) { return std::abs(point.value - curve.anchor); });
  for (const ScalingPoint& point : points) {
    costs.push_back(anchor.cost.value * point.theory / anchor.theory);
  }
  return costs;
}

std::string findingOf(const ScalingCurve& curve) {
  const std::vector<ScalingPoint> points = measuredPoints(curve);
  std::string text;
  if (points.size() >= 2) {
    const ScalingPoint& first = points.front();
    const ScalingPoint& last = points.back();
    text = fmt::format("From {} to {} {}: {} time of a sample times {}; theory ({}) says times {}. Error times time: "
                       "times {}. Device memory: {} to {} MB.",
                       shortText(first.value), shortText(last.value), curve.axis, curve.clock,
                       growth(last.cost, first.cost, curve.seeds), curve.theory, shortText(last.theory / first.theory),
                       growth(last.errorTime, first.errorTime, curve.seeds), shortText(1e-6 * first.deviceBytes),
                       shortText(1e-6 * last.deviceBytes));
  }
  for (const ScalingPoint& point : curve.points) {
    if (!point.leftOut.empty()) {
      text += fmt::format("{}{} left out: {}.", text.empty() ? "" : " ", shortText(point.value), point.leftOut);
    }
  }
  return text;
}

Json toJson(const ScalingCurve& curve) {
  Json json{{"name", curve.name},     {"title", curve.title}, {"axis", curve.axis},     {"clock", curve.clock},
            {"theory", curve.theory}, {"seeds", curve.seeds}, {"points", Json::array()}};
  for (const ScalingPoint& point : curve.points) {
    if (!point.leftOut.empty()) {
      json["points"].push_back({{"value", point.value}, {"left_out", point.leftOut}});
      continue;
    }
    json["points"].push_back({{"value", point.value},
                              {"samples", point.samples},
                              {"microseconds_per_sample", toJson(point.cost)},
                              {"relative_variance_times_seconds", toJson(point.errorTime)},
                              {"start_seconds", point.startSeconds},
                              {"device_bytes", point.deviceBytes},
                              {"peak_host_bytes", point.hostBytes},
                              {"theory", point.theory}});
  }
  json["finding"] = findingOf(curve);
  return json;
}

} // namespace tyndall::bench

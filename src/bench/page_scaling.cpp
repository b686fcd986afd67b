// SPDX-License-Identifier: Apache-2.0
#include "bench/page_scaling.h"

#include "bench/html.h"

#include <fmt/format.h>

namespace tyndall::bench {
namespace {

std::string figureText(const Figure& figure, std::size_t seeds) {
  return seeds >= 2 ? rangeText(figure, seeds) : shortText(figure.value);
}

LineChart errorTimeChart(const ScalingCurve& curve) {
  ChartLine line{"measured", {}, false};
  for (const ScalingPoint& point : measuredPoints(curve)) {
    line.points.push_back(
        {point.value, point.errorTime.value, curve.seeds >= 2 ? interval(point.errorTime, curve.seeds) : Interval{}});
  }
  return {"Error times time", curve.axis, "relative variance x s", {line}};
}

std::string pointTable(const ScalingCurve& curve) {
  std::vector<std::vector<std::string>> rows{{curve.axis, "samples", curve.clock + " us per sample", "theory",
                                              "relative variance x s", "start-up s", "device MB", "peak host MB"}};
  const std::vector<ScalingPoint> points = measuredPoints(curve);
  const std::vector<double> theory = theoryCosts(curve);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ScalingPoint& point = points[i];
    rows.push_back({shortText(point.value), fmt::format("{:.0f}", point.samples), figureText(point.cost, curve.seeds),
                    shortText(theory[i]), figureText(point.errorTime, curve.seeds), shortText(point.startSeconds),
                    shortText(1e-6 * point.deviceBytes), shortText(1e-6 * point.hostBytes)});
  }
  return table(rows);
}

} // namespace

LineChart scalingChart(const ScalingCurve& curve) {
  LineChart chart{
      "Cost", curve.axis, curve.clock + " us per sample", {{"measured", {}, false}, {curve.theory, {}, true}}};
  const std::vector<ScalingPoint> points = measuredPoints(curve);
  const std::vector<double> theory = theoryCosts(curve);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ScalingPoint& point = points[i];
    chart.lines[0].points.push_back(
        {point.value, point.cost.value, curve.seeds >= 2 ? interval(point.cost, curve.seeds) : Interval{}});
    chart.lines[1].points.push_back({point.value, theory[i], {}});
  }
  return chart;
}

std::string scalingSection(const std::vector<ScalingCurve>& curves) {
  std::string html = heading("h2", "Scaling");
  html +=
      note("Cost of a sample: slope between two numbers of samples, so that start-up does not count; the intercept is "
           "the start-up, shader caches warm. Dashed: theory, made equal at one point. Relative variance: of "
           "the pixels that see something, over their mean square, after the seconds it is multiplied by.");
  for (const ScalingCurve& curve : curves) {
    html += heading("h3", curve.title);
    html += note(findingOf(curve));
    html += svgText(scalingChart(curve)) + svgText(errorTimeChart(curve));
    html += pointTable(curve);
  }
  return html;
}

} // namespace tyndall::bench

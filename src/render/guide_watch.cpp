// SPDX-License-Identifier: Apache-2.0
#include "render/guide_watch.h"

#include "film/film.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace tyndall::render {
namespace {

/// Pixels come in an order that keeps neighbours together.
constexpr std::size_t kGroup = 64;

constexpr std::uint32_t kGuidedBatch = 1;
constexpr std::uint32_t kPlainBatch = 2;

double luminance(const interop::PixelSums& sums) {
  return 0.2126 * double(sums.moments[0]) + 0.7152 * double(sums.moments[1]) + 0.0722 * double(sums.moments[2]);
}

} // namespace

void GuideWatch::take(Trial trial, std::span<const interop::PixelSums> first,
                      std::span<const interop::PixelSums> second, double seconds) {
  Measure& measure = trial == Trial::Guided ? guided_ : plain_;
  for (std::size_t begin = 0; begin < first.size(); begin += kGroup) {
    const std::size_t end = std::min(begin + kGroup, first.size());
    double squares = 0.0;
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double difference = luminance(first[i]) - luminance(second[i]);
      squares += 0.5 * difference * difference;
      sum += 0.5 * (luminance(first[i]) + luminance(second[i]));
    }
    measure.variance.push_back(squares / double(end - begin));
    measure.mean.push_back(sum / double(end - begin));
  }
  measure.seconds += seconds;
}

std::vector<double> GuideWatch::relative(const Measure& own, const Measure& other) {
  std::vector<double> result(own.mean.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double mean = 0.5 * (own.mean[i] + other.mean[i]);
    result[i] = mean > 0.0 ? own.variance[i] / (mean * mean) : 0.0;
  }
  return result;
}

std::optional<double> GuideWatch::gain() const {
  if (!complete() || guided_.mean.size() != plain_.mean.size()) {
    return std::nullopt;
  }
  const std::vector<double> guided = relative(guided_, plain_);
  const std::vector<double> plain = relative(plain_, guided_);
  // No group is left out: where light is found by rare chance, all of the variance lies in a few.
  const double costGuided = std::accumulate(guided.begin(), guided.end(), 0.0) * guided_.seconds;
  const double costPlain = std::accumulate(plain.begin(), plain.end(), 0.0) * plain_.seconds;
  return costGuided > 0.0 && std::isfinite(costPlain) ? costPlain / costGuided : 1.0;
}

bool GuideTrial::watched(SampleRange samples) const {
  const std::uint32_t batch = samples.first / film::kBatchSamples;
  return wanted_ && begun_ && samples.count == film::kBatchSamples && (batch == kGuidedBatch || batch == kPlainBatch);
}

bool GuideTrial::guided(SampleRange samples) const {
  if (watched(samples)) {
    return samples.first / film::kBatchSamples == kGuidedBatch;
  }
  return !wanted_ || !begun_ || samples.first / film::kBatchSamples <= kPlainBatch ||
         watch_.gain().value_or(1.0) >= 1.0;
}

void GuideTrial::take(SampleRange samples, std::span<const interop::PixelSums> first,
                      std::span<const interop::PixelSums> second, double seconds) {
  watch_.take(guided(samples) ? GuideWatch::Trial::Guided : GuideWatch::Trial::Plain, first, second, seconds);
}

void addTo(interop::PixelSums& sum, const interop::PixelSums& term) {
  std::transform(std::begin(sum.moments), std::end(sum.moments), term.moments, sum.moments, std::plus<>());
  std::transform(std::begin(sum.extras), std::end(sum.extras), term.extras, sum.extras, std::plus<>());
}

} // namespace tyndall::render

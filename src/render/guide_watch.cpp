// SPDX-License-Identifier: Apache-2.0
#include "render/guide_watch.h"

#include "film/film.h"
#include "math/colour.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>

namespace tyndall::render {
namespace {

/// Pixels come in an order that keeps neighbours together.
constexpr std::size_t kGroup = 64;

/// A trial's part of the samples: guided ones and twice as many that learn cost a tenth where they take three times as
/// long.
constexpr std::uint32_t kTrialPart = 64;
/// Each trial is two halves, and a longer one knows no more that matters.
constexpr std::uint32_t kLeastTrial = 2;
constexpr std::uint32_t kMostTrial = film::kBatchSamples;
/// Below, the least trial would be too large a part.
constexpr std::uint32_t kLeastPlanned = 64;

double luminance(const interop::PixelSums& sums) {
  return tyndall::luminance({sums.moments[0], sums.moments[1], sums.moments[2]});
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

GuideTrial::GuideTrial(bool wanted, std::uint32_t planned) {
  const std::uint32_t part = std::clamp(planned / kTrialPart, kLeastTrial, kMostTrial);
  length_ = wanted && planned >= kLeastPlanned ? std::bit_floor(part) : 0;
}

void GuideTrial::begin(SampleRange samples) {
  if (samples.first == 0) {
    begun_ = true;
    watch_ = {};
  }
}

GuideTrial::Phase GuideTrial::phase(std::uint32_t sample) const {
  if (length_ == 0 || !begun_) {
    return Phase::Settled;
  }
  // Learning takes two lengths, each trial one.
  return static_cast<Phase>(std::min(std::max(sample / length_, 1u), std::uint32_t(Phase::Settled)));
}

SampleRange GuideTrial::leading(SampleRange samples) const {
  SampleRange result{samples.first, 1};
  while (result.count < samples.count && phase(samples.first + result.count) == phase(samples.first)) {
    ++result.count;
  }
  return result;
}

bool GuideTrial::watched(SampleRange samples) const {
  const Phase now = phase(samples.first);
  return (now == Phase::Guided || now == Phase::Plain) && samples.count == length_;
}

bool GuideTrial::guided(SampleRange samples) const {
  const Phase now = phase(samples.first);
  return now == Phase::Settled ? watch_.gain().value_or(1.0) >= 1.0 : now != Phase::Plain;
}

void GuideTrial::take(SampleRange samples, std::span<const interop::PixelSums> first,
                      std::span<const interop::PixelSums> second, double seconds) {
  watch_.take(guided(samples) ? GuideWatch::Trial::Guided : GuideWatch::Trial::Plain, first, second, seconds);
}

void addTo(std::span<interop::PixelSums> sums, std::span<const interop::PixelSums> terms) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    std::ranges::transform(sums[i].moments, terms[i].moments, sums[i].moments, std::plus<>());
    std::ranges::transform(sums[i].extras, terms[i].extras, sums[i].extras, std::plus<>());
  }
}

} // namespace tyndall::render

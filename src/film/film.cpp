// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include "base/error.h"

#include <algorithm>
#include <limits>

namespace tyndall::film {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Sums of one channel over `batches` batches with `samples` samples in all.
struct ChannelSums {
  double sum = 0.0;
  double sumOfSquares = 0.0;
  double samples = 0.0;
  double batches = 0.0;
};

ChannelSums halfSums(const PixelState& state, int half, int moment) {
  return {state.sum[half][moment], state.sumOfSquares[half][moment], double(state.samples[half]),
          double(state.batches[half])};
}

ChannelSums pooledSums(const PixelState& state, int moment) {
  const ChannelSums even = halfSums(state, 0, moment);
  const ChannelSums odd = halfSums(state, 1, moment);
  return {even.sum + odd.sum, even.sumOfSquares + odd.sumOfSquares, even.samples + odd.samples,
          even.batches + odd.batches};
}

double meanOf(const ChannelSums& channel) { return channel.samples > 0.0 ? channel.sum / channel.samples : 0.0; }

// With S_b the sum of batch b, E[sum_b S_b^2 / n_b - S^2 / N] = (k - 1) sigma^2 for any batch sizes n_b: each of the
// k + 1 terms carries its own n_b mu^2 + sigma^2, so that a shorter last batch needs no correction.
double varianceOfMeanOf(const ChannelSums& channel) {
  if (channel.batches < 2.0) {
    return kUnknown;
  }
  const double scatter = channel.sumOfSquares - channel.sum * channel.sum / channel.samples;
  // Equal batches give a difference of equal numbers, whose rounding can fall below zero; the exact value cannot.
  return std::max(0.0, scatter / (channel.batches - 1.0) / channel.samples);
}

} // namespace

Film::Film(const glm::uvec2& imageSize, const Window& window)
    : imageSize_(imageSize), window_(window), pixels_(window.pixelCount()) {
  TYNDALL_CHECK(window.min.x <= window.max.x && window.min.y <= window.max.y);
  TYNDALL_CHECK(window.max.x <= imageSize.x && window.max.y <= imageSize.y);
}

void Film::add(std::size_t pixel, std::uint32_t batch, std::uint32_t sampleCount, const BatchSums& sums) {
  TYNDALL_CHECK(pixel < pixels_.size());
  TYNDALL_CHECK(sampleCount > 0 && sampleCount <= kBatchSamples);
  PixelState& state = pixels_[pixel];
  const std::size_t half = batch & 1u;
  for (int moment = 0; moment < kMomentCount; ++moment) {
    const double sum = double(sums.moments[moment]);
    state.sum[half][moment] += sum;
    state.sumOfSquares[half][moment] += sum * sum / double(sampleCount);
  }
  for (int extra = 0; extra < kExtraCount; ++extra) {
    state.extra[extra] += double(sums.extras[extra]);
  }
  state.samples[half] += sampleCount;
  state.batches[half] += 1;
}

std::uint32_t Film::samples(std::size_t pixel) const { return pixels_[pixel].samples[0] + pixels_[pixel].samples[1]; }

double Film::mean(std::size_t pixel, int moment) const {
  const PixelState& state = pixels_[pixel];
  const bool bothHalves = state.samples[0] > 0 && state.samples[1] > 0;
  if (!independentHalves || !bothHalves) {
    return meanOf(pooledSums(state, moment));
  }
  return 0.5 * (meanOf(halfSums(state, 0, moment)) + meanOf(halfSums(state, 1, moment)));
}

double Film::varianceOfMean(std::size_t pixel, int moment) const {
  const PixelState& state = pixels_[pixel];
  const bool bothHalves = state.samples[0] > 0 && state.samples[1] > 0;
  if (!independentHalves || !bothHalves) {
    return varianceOfMeanOf(pooledSums(state, moment));
  }
  return 0.25 * (varianceOfMeanOf(halfSums(state, 0, moment)) + varianceOfMeanOf(halfSums(state, 1, moment)));
}

double Film::extraMean(std::size_t pixel, int extra) const {
  const std::uint32_t count = samples(pixel);
  return count > 0 ? pixels_[pixel].extra[extra] / double(count) : 0.0;
}

HalfEstimate Film::halfEstimate(std::size_t pixel, int half, int moment) const {
  const ChannelSums channel = halfSums(pixels_[pixel], half, moment);
  return {meanOf(channel), varianceOfMeanOf(channel)};
}

} // namespace tyndall::film

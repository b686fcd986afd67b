// SPDX-License-Identifier: Apache-2.0
#include "render/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tyndall::render {
namespace {

/// Batches of a half below which an estimate of its error means nothing.
constexpr std::uint32_t kMinHalfBatches = 64 / film::kBatchSamples;

std::string stopKey(int half) { return fmt::format("stop.half{}", half); }

} // namespace

Schedule::Schedule(const StopRule& rule, const film::Film& film) : rule_(rule) {
  for (int half = 0; half < 2; ++half) {
    const auto entry = film.metadata.find(stopKey(half));
    if (rule.error && entry != film.metadata.end()) {
      stopped_[static_cast<std::size_t>(half)] = true;
      stoppedBatches_[static_cast<std::size_t>(half)] = static_cast<std::uint32_t>(std::stoul(entry->second));
    }
  }
}

void Schedule::note(film::Film& film) const {
  for (int half = 0; half < 2; ++half) {
    if (stopped_[static_cast<std::size_t>(half)]) {
      film.metadata[stopKey(half)] = std::to_string(stoppedBatches_[static_cast<std::size_t>(half)]);
    }
  }
}

std::uint32_t Schedule::batchSamples(std::uint32_t batch) const {
  const std::uint64_t first = std::uint64_t(batch) * film::kBatchSamples;
  return first >= rule_.samples ? 0 : static_cast<std::uint32_t>(std::min<std::uint64_t>(film::kBatchSamples, rule_.samples - first));
}

std::optional<std::uint32_t> Schedule::next(const film::Film& film) {
  if (rule_.error && batch_ % 2 == 0) {
    decide(film);
  }
  while (batchSamples(batch_) > 0) {
    if (stopped_[0] && stopped_[1]) {
      reason_ = "error";
      return std::nullopt;
    }
    const std::uint32_t batch = batch_++;
    if (!stopped_[batch % 2]) {
      return batch;
    }
    if (rule_.error && batch_ % 2 == 0) {
      decide(film);
    }
  }
  return std::nullopt;
}

void Schedule::decide(const film::Film& film) {
  const std::uint32_t perHalf = batch_ / 2;
  if (perHalf < kMinHalfBatches || !std::has_single_bit(perHalf)) {
    return;
  }
  const std::array<bool, 2> before = stopped_;
  for (int half = 0; half < 2; ++half) {
    const auto other = static_cast<std::size_t>(1 - half);
    // A half that has stopped judges by the variance it knows, scaled to the samples that this one has by now.
    const double scale = before[other] ? std::sqrt(double(stoppedBatches_[other]) / perHalf) : 1.0;
    if (!before[static_cast<std::size_t>(half)] && scale * film::estimateErrorFromHalf(film, 1 - half).upper <= *rule_.error) {
      stopped_[static_cast<std::size_t>(half)] = true;
      stoppedBatches_[static_cast<std::size_t>(half)] = perHalf;
    }
  }
}

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#include "render/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace tyndall::render {
namespace {

/// Batches of a half below which an estimate of its error means nothing.
constexpr std::uint32_t kMinHalfBatches = 64 / film::kBatchSamples;

std::string stopKey(int half) { return fmt::format("stop.half{}", half); }

std::uint32_t mostBatches(const film::Film& film) {
  std::uint32_t most = 0;
  for (const film::PixelState& pixel : film.pixels()) {
    most = std::max({most, pixel.batches[0], pixel.batches[1]});
  }
  return most;
}

} // namespace

Schedule::Schedule(const StopRule& rule, const film::Film& film) : rule_(rule), passed_(mostBatches(film)) {
  for (int half = 0; half < 2; ++half) {
    const auto entry = film.metadata.find(stopKey(half)); // the target that it stopped for
    stopped_[static_cast<std::size_t>(half)] =
        rule.error && entry != film.metadata.end() && std::stod(entry->second) <= *rule.error;
  }
}

void Schedule::note(film::Film& film) const {
  for (int half = 0; half < 2; ++half) {
    if (stopped_[static_cast<std::size_t>(half)]) {
      film.metadata.try_emplace(stopKey(half), fmt::format("{:.17g}", *rule_.error));
    } else {
      film.metadata.erase(stopKey(half));
    }
  }
}

std::uint32_t Schedule::batchSamples(std::uint32_t batch) const {
  const std::uint64_t first = std::uint64_t(batch) * film::kBatchSamples;
  return first >= rule_.samples
             ? 0
             : static_cast<std::uint32_t>(std::min<std::uint64_t>(film::kBatchSamples, rule_.samples - first));
}

std::optional<std::uint32_t> Schedule::next(const film::Film& decisions) {
  if (rule_.error && batch_ % 2 == 0) {
    decide(decisions);
  }
  if (stopped_[0] && stopped_[1]) {
    reason_ = "error";
    return std::nullopt;
  }
  if (batchSamples(batch_) == 0) {
    return std::nullopt;
  }
  return batch_++;
}

void Schedule::decide(const film::Film& decisions) {
  const std::uint32_t perHalf = batch_ / 2;
  if (perHalf < std::max(kMinHalfBatches, passed_) || !std::has_single_bit(perHalf)) {
    return;
  }
  for (int half = 0; half < 2; ++half) {
    if (film::estimateErrorFromHalf(decisions, 1 - half).upper <= *rule_.error) {
      stopped_[static_cast<std::size_t>(half)] = true;
    }
  }
}

} // namespace tyndall::render

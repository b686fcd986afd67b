// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"

#include <array>
#include <cstdint>
#include <optional>

namespace tyndall::render {

/// When a picture is done. Whatever comes first.
struct StopRule {
  std::uint32_t samples = 64;    ///< per pixel
  std::optional<double> seconds; ///< of rendering
  std::optional<double> error;   ///< estimated rRMSE (film::estimateError)
};

/// Which batches to run next. By sample count: 0, 1, 2, ... By error: all of them, until both half-buffers (even and
/// odd batches) have stopped; a half stops when the *other* one's estimate says that the picture is good. Decisions
/// fall when each half has a power of two of batches, 64 samples at least. Batches of a half that has stopped serve
/// decisions only and must not enter the picture: then its count depends on the other half's samples alone, and the
/// mean of each half, and their average, stay unbiased.
class Schedule {
public:
  /// Takes up where a film, maybe of an earlier run, stands: decisions that it has passed are not taken again, and
  /// stops count unless the target has become stricter.
  Schedule(const StopRule& rule, const film::Film& film);

  /// The next batch, or nothing: done. @param decisions the film that holds every batch so far.
  std::optional<std::uint32_t> next(const film::Film& decisions);
  /// Samples of batch `batch` within the limit.
  std::uint32_t batchSamples(std::uint32_t batch) const;
  bool stopped(std::uint32_t half) const { return stopped_[half]; }
  bool anyStopped() const { return stopped_[0] || stopped_[1]; }
  /// Why it ended: "samples" or "error".
  const char* reason() const { return reason_; }
  /// Notes stops in the film's metadata.
  void note(film::Film& film) const;

private:
  void decide(const film::Film& decisions);

  StopRule rule_;
  std::uint32_t batch_ = 0;
  std::uint32_t passed_ = 0; ///< batches per half that the film had at the start
  std::array<bool, 2> stopped_{};
  const char* reason_ = "samples";
};

} // namespace tyndall::render

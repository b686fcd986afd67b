// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"
#include "render/tracer.h"

#include <array>
#include <cstdint>
#include <optional>

namespace tyndall::render {

/// When a picture is done. Whatever comes first.
struct StopRule {
  std::uint32_t samples = 64;         ///< per pixel
  std::optional<double> seconds;      ///< of rendering
  std::optional<double> error;        ///< estimated rRMSE (film::estimateError)
};

/// Which batches to run next. By sample count: 0, 1, 2, ... By error: the two half-buffers (even and odd batches) in
/// turn, each until the *other* one's estimate says that the picture is good: a half never stops because of its own
/// samples, so both means, and their average, stay unbiased. Decisions fall when each half has a power of two of
/// batches, 64 samples at least.
class Schedule {
public:
  /// Takes up where a film, maybe of an earlier run, stands.
  Schedule(const StopRule& rule, const film::Film& film);

  /// The next batch, or nothing: done. Asks the film for error estimates where a decision is due.
  std::optional<std::uint32_t> next(const film::Film& film);
  /// Samples of batch `batch` within the limit.
  std::uint32_t batchSamples(std::uint32_t batch) const;
  /// Why it ended: "samples" or "error".
  const char* reason() const { return reason_; }
  /// Notes stopped halves in the film's metadata, so that a resumed picture goes on with the same ones.
  void note(film::Film& film) const;

private:
  void decide(const film::Film& film);

  StopRule rule_;
  std::uint32_t batch_ = 0;
  std::array<bool, 2> stopped_{};
  std::array<std::uint32_t, 2> stoppedBatches_{};  ///< batches that a stopped half has
  const char* reason_ = "samples";
};

} // namespace tyndall::render

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interop/pixel_sums.h"
#include "render/sample_range.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tyndall::render {

/// Whether guiding pays on a picture: relative variance times time with it over that without. Each of the two takes a
/// batch of the picture in two halves, whose difference says how much noise there is.
class GuideWatch {
public:
  enum class Trial { Guided, Plain };

  /// Both halves of one trial's batch: sums over the samples of a half, the same pixels in the same order in each.
  void take(Trial trial, std::span<const interop::PixelSums> first, std::span<const interop::PixelSums> second,
            double seconds);

  bool complete() const { return guided_.seconds > 0.0 && plain_.seconds > 0.0; }
  /// How many times less variance times time guiding has; nullopt while a trial is missing. 1 where there is no noise.
  std::optional<double> gain() const;

private:
  /// Of groups of pixels that are neighbours.
  struct Measure {
    std::vector<double> variance; ///< of one half's mean
    std::vector<double> mean;
    double seconds = 0.0;
  };
  static std::vector<double> relative(const Measure& own, const Measure& other);

  Measure guided_;
  Measure plain_;
};

/// When a render tries what: its first batch learns, the second is the guided trial, the third the plain one, and from
/// the fourth on it does what has won. A render that is shorter, or goes on from a later batch, stays guided.
class GuideTrial {
public:
  explicit GuideTrial(bool wanted) : wanted_(wanted) {}

  /// Before each run: without the first batch there is nothing learnt to be tried.
  void begin(SampleRange samples) { begun_ = begun_ || samples.first == 0; }

  /// Whether these samples are a trial's: a whole batch.
  bool watched(SampleRange samples) const;
  bool guided(SampleRange samples) const;
  void take(SampleRange samples, std::span<const interop::PixelSums> first, std::span<const interop::PixelSums> second,
            double seconds);
  std::optional<double> gain() const { return watch_.gain(); }

private:
  bool wanted_;
  bool begun_ = false;
  GuideWatch watch_;
};

void addTo(interop::PixelSums& sum, const interop::PixelSums& term);

} // namespace tyndall::render

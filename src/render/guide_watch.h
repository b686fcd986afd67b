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
/// number of its samples in two halves, whose difference says how much noise there is.
class GuideWatch {
public:
  enum class Trial { Guided, Plain };

  /// Both halves of one trial: sums over the samples of a half, the same pixels in the same order in each.
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

/// When a render tries what: a thirty-second of its samples learn, half as many are the guided trial, as many the plain
/// one, and from there on it does what has won. A render that is too short for that, or goes on behind it, stays
/// guided.
class GuideTrial {
public:
  /// @param planned samples per pixel.
  GuideTrial(bool wanted, std::uint32_t planned);

  /// Before each run: without the first samples there is nothing learnt to be tried.
  void begin(SampleRange samples);

  /// The first of these samples that belong together: to one trial, to learning, or to what follows.
  SampleRange leading(SampleRange samples) const;
  /// Whether these samples are a whole trial.
  bool watched(SampleRange samples) const;
  bool guided(SampleRange samples) const;
  void take(SampleRange samples, std::span<const interop::PixelSums> first, std::span<const interop::PixelSums> second,
            double seconds);
  std::optional<double> gain() const { return watch_.gain(); }

private:
  enum class Phase : std::uint32_t { Learning = 1, Guided, Plain, Settled };
  Phase phase(std::uint32_t sample) const;

  std::uint32_t length_; ///< of a trial [samples]; 0: there is none
  bool begun_ = false;
  GuideWatch watch_;
};

void addTo(std::span<interop::PixelSums> sums, std::span<const interop::PixelSums> terms);

} // namespace tyndall::render

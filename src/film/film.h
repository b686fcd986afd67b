// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tyndall::film {

/// Consecutive sample indices of a pixel whose sum is one draw of the batch statistics. Fixed: error bars, resume
/// and merge rest on it, whatever a dispatch runs.
inline constexpr std::uint32_t kBatchSamples = 16;

/// Pixels [min, max) of an image of `size`.
struct Window {
  glm::uvec2 min{0};
  glm::uvec2 max{0};
  glm::uvec2 extent() const { return max - min; }
  std::size_t pixelCount() const { return std::size_t(extent().x) * extent().y; }
  bool operator==(const Window&) const = default;
};

/// Channels with second moments: the picture (R, G, B) and transmittance T.
enum Moment : int { R = 0, G = 1, B = 2, T = 3 };
inline constexpr int kMomentCount = 4;
/// Channels with a mean only: background seen through the media (R, G, B), depth * opacity, opacity weight
/// of depth and albedo, albedo * opacity (R, G, B).
enum Extra : int { BackgroundR = 0, BackgroundG, BackgroundB, Depth, Opacity, AlbedoR, AlbedoG, AlbedoB };
inline constexpr int kExtraCount = 8;

/// What a dispatch returns for one pixel: sums over the samples of one batch.
struct BatchSums {
  std::array<float, kMomentCount> moments{};
  std::array<float, kExtraCount> extras{};
};

/// Sums in double of one pixel. `half` is the parity of the batch index: two independent half-buffers, so that a
/// decision to stop can rest on the half that it does not stop.
struct PixelState {
  std::array<std::array<double, kMomentCount>, 2> sum{};         ///< sum over samples
  std::array<std::array<double, kMomentCount>, 2> sumOfSquares{}; ///< sum over batches of (batch sum)^2 / samples
  std::array<double, kExtraCount> extra{};
  std::array<std::uint32_t, 2> samples{};
  std::array<std::uint32_t, 2> batches{};
};

/// Key and value pairs for EXR headers, in key order.
using Metadata = std::map<std::string, std::string>;

/// Mean of one half of the samples and its variance (+infinity below two batches).
struct HalfEstimate {
  double mean = 0.0;
  double variance = 0.0;
};

/// The picture as moments. A value: can be copied, saved (checkpoint.h), merged (merge.h).
class Film {
public:
  Film() = default;
  Film(const glm::uvec2& imageSize, const Window& window);

  const glm::uvec2& imageSize() const { return imageSize_; }
  const Window& window() const { return window_; }

  /// `pixel` indexes the window, x fastest. Batches of one pixel must come in ascending order.
  void add(std::size_t pixel, std::uint32_t batch, std::uint32_t sampleCount, const BatchSums& sums);

  std::uint32_t samples(std::size_t pixel) const;
  /// Mean of a moment channel: all samples pooled, or the average of the two halves' means if halves were stopped
  /// independently (independentHalves). 0 without samples.
  double mean(std::size_t pixel, int moment) const;
  /// Variance of mean(): (sumOfSquares - sum^2 / n) / (k - 1) / n over k batches; needs k >= 2, else +infinity.
  double varianceOfMean(std::size_t pixel, int moment) const;
  double extraMean(std::size_t pixel, int extra) const;
  HalfEstimate halfEstimate(std::size_t pixel, int half, int moment) const;

  std::vector<PixelState>& pixels() { return pixels_; }
  const std::vector<PixelState>& pixels() const { return pixels_; }

  bool independentHalves = false;
  Metadata metadata;

private:
  glm::uvec2 imageSize_{0};
  Window window_;
  std::vector<PixelState> pixels_;
};

/// rRMSE of the picture, sqrt(sum var / sum mean^2) over covered pixels (1 - T > 0.01) and R, G, B.
struct ErrorEstimate {
  double relative = 0.0;      ///< the estimate; infinity while there are too few batches
  /// One-sided bound that the picture's true error stays below in at least 90 % of runs: from the spread over 16x16
  /// tiles (smaller ones in a small picture) and the chance in this picture's own errors.
  double upper = 0.0;
  std::size_t coveredPixels = 0;
};
/// From both halves: what is printed and written. No covered pixel or no noise: 0. Noise above the picture: infinity.
ErrorEstimate estimateError(const Film& film);
/// From one half alone, of the whole picture's error if both halves had this half's sample count: what decides
/// whether the *other* half stops. Ask a film that goes on collecting both halves, and keep the picture in a second one
/// (independentHalves) whose stopped half gets no more batches: else the first stop leaks into the second.
ErrorEstimate estimateErrorFromHalf(const Film& film, int half);

} // namespace tyndall::film

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"
#include "film/statistics.h"
#include "gpu_scene/volumes.h"
#include "interop/planted_bugs.h"
#include "render/estimator.h"
#include "scene/scene.h"

#include <array>
#include <string>
#include <vector>

/// Pictures as statistics: means with standard errors over independent seeds, and tests of them against references.
namespace tyndall::test {

/// False-alarm rate of one test (a family of pixels, channels or tiles), Sidak-corrected inside.
inline constexpr double kFamilyRate = 1e-4;

/// How much longer than in the fast suite tests may take: the environment's TYNDALL_TEST_EFFORT, 1 without it.
/// Multiplies the replicates of renderMoments, so that errors shrink by its root.
std::uint32_t effort();

/// Channels of the moments below.
inline constexpr int kTransmittance = 3;

struct MomentOptions {
  std::uint32_t replicates = 32; ///< independent seeds, times effort()
  std::uint32_t samples = 16;    ///< per pixel and replicate; a multiple of 16 if above it
  std::uint32_t firstSeed = 1;
  render::EstimatorOptions estimator{};
  std::vector<bool> skip{}; ///< pixels (x fastest) that are not rendered and stay 0; empty: none
};

/// `options` for every method: as they are for the tracking, with a quarter of the replicates (8 at least) for the
/// march, whose pictures vary far less.
std::vector<MomentOptions> eachMethod(const MomentOptions& options = {});
/// The same with both trackers of the tracking: weighted walk and delta tracking.
std::vector<MomentOptions> eachTracker(const MomentOptions& options = {});
MomentOptions withBug(MomentOptions options, std::uint32_t bug);
/// "march", "tracking" or "delta tracking".
std::string nameOf(const MomentOptions& options);
inline bool marches(const MomentOptions& options) { return options.estimator.method == render::Method::March; }

/// Mean and standard error over the replicates, for every pixel (x fastest) of the whole image.
/// Channels R, G, B (background included) and T.
struct Moments {
  glm::uvec2 size{0};
  std::uint32_t replicates = 0;
  std::vector<std::array<film::SampleSummary, 4>> pixels;
  /// Per replicate and 16x16 tile (x fastest), the tile's share of the image's mean: pixels need not be independent,
  /// because sky directions are shared by all of a batch.
  std::vector<std::vector<std::array<double, 4>>> tileMeans;
  render::Totals totals;

  double mean(std::size_t pixel, int channel = 0) const {
    return pixels[pixel][static_cast<std::size_t>(channel)].mean;
  }
  film::SampleSummary image(int channel = 0) const;
  film::SampleSummary tile(std::size_t tile, int channel) const;
};

/// Renders every pixel, also those that the coverage mask would leave out. Validation messages, samples that are not
/// finite and lookups above their majorant are test failures, the latter two only without a planted bug.
Moments renderMoments(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes = {},
                      const MomentOptions& options = {});

/// What a test of a family found.
struct Verdict {
  double familyP = 1.0;    ///< Sidak; below kFamilyRate: different
  double worstT = 0.0;     ///< in standard errors
  std::size_t worst = 0;   ///< pixel or tile
  double bias = 0.0;       ///< (estimate - reference) / reference of the worst
  double resolution = 0.0; ///< relative bias of the image mean (or of the worst one) that is one standard error

  bool agrees() const { return familyP >= kFamilyRate; }
  std::string text() const;
};

/// Student's t of every pixel against its reference value. `tolerance` is a relative error that float arithmetic is
/// granted; pixels whose reference is NaN are left out.
Verdict pixelTest(const Moments& moments, const std::vector<double>& reference, int channel = 0,
                  double tolerance = 2e-6);
/// The mean over the image against `reference`: what sees the smallest bias.
Verdict imageTest(const Moments& moments, double reference, int channel = 0, double tolerance = 2e-6);
/// Welch's t of 16x16 tiles of two configurations (the image itself if it is smaller), all four channels.
Verdict tileTest(const Moments& a, const Moments& b, double tolerance = 2e-6);

/// The mean of references that are not NaN.
double meanOf(const std::vector<double>& values);

} // namespace tyndall::test

#define EXPECT_AGREES(verdict) EXPECT_TRUE((verdict).agrees()) << (verdict).text()
#define EXPECT_DIFFERS(verdict) EXPECT_FALSE((verdict).agrees()) << "the planted bug was not seen: " << (verdict).text()

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/statistics.h"
#include "gpu_scene/volumes.h"
#include "interop/planted_bugs.h"
#include "render/estimator.h"
#include "scene/scene.h"

#include <array>
#include <vector>

/// Pictures as statistics: means with standard errors over independent seeds.
namespace tyndall::verify {

/// Channels of the moments below.
inline constexpr int kTransmittance = 3;

struct MomentOptions {
  std::uint32_t replicates = 32; ///< independent seeds
  std::uint32_t samples = 16;    ///< per pixel and replicate; a multiple of 16 if above it
  std::uint32_t firstSeed = 1;
  render::EstimatorOptions estimator{};
  std::vector<bool> skip{}; ///< pixels (x fastest) that are not rendered and stay 0; empty: none
};

/// Mean and standard error over the replicates, for every pixel (x fastest) of the whole image.
/// Channels R, G, B (background included) and T.
struct Moments {
  glm::uvec2 size{0};
  std::uint32_t replicates = 0;
  render::Method method = render::Method::Tracking;
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

/// Renders every pixel, also those that the coverage mask would leave out.
Moments renderMoments(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                      const MomentOptions& options);

} // namespace tyndall::verify

// SPDX-License-Identifier: Apache-2.0
#include "verify/moments.h"

#include "film/film.h"
#include "gpu_scene/gpu_scene.h"

#include <algorithm>

namespace tyndall::verify {
namespace {

constexpr std::uint32_t kTile = 16;

std::vector<std::uint32_t> pixelsOf(const glm::uvec2& size, const std::vector<bool>& skip) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t y = 0; y < size.y; ++y) {
    for (std::uint32_t x = 0; x < size.x; ++x) {
      if (skip.empty() || !skip[x + std::size_t(size.x) * y]) {
        pixels.push_back(x | y << 16);
      }
    }
  }
  return pixels;
}

/// Means of the pixels over the samples of one seed.
std::vector<std::array<double, 4>> renderReplicate(render::Estimator& estimator,
                                                   const std::vector<std::uint32_t>& pixels, std::uint32_t samples,
                                                   std::uint32_t seed) {
  std::vector<std::array<double, 4>> means(pixels.size(), std::array<double, 4>{});
  for (std::uint32_t first = 0; first < samples; first += film::kBatchSamples) {
    const std::uint32_t count = std::min(film::kBatchSamples, samples - first);
    for (std::size_t begin = 0; begin < pixels.size(); begin += estimator.chunkPixels()) {
      const std::size_t chunk = std::min<std::size_t>(estimator.chunkPixels(), pixels.size() - begin);
      const auto sums = estimator.run(std::span(pixels).subspan(begin, chunk), {first, count}, seed);
      for (std::size_t i = 0; i < chunk; ++i) {
        for (std::size_t channel = 0; channel < 4; ++channel) {
          const double background = channel < 3 ? double(sums[i].extras[channel]) : 0.0;
          means[begin + i][channel] += (double(sums[i].moments[channel]) + background) / samples;
        }
      }
    }
  }
  return means;
}

/// Tiles across and down; the last ones may be cut off.
glm::uvec2 tilesOf(const glm::uvec2& size) { return (size + kTile - 1u) / kTile; }

/// Sums over the pixels of each tile, divided by the pixels of the image.
std::vector<std::array<double, 4>> tileMeans(const glm::uvec2& size, std::span<const std::uint32_t> pixels,
                                             const std::vector<std::array<double, 4>>& means) {
  const glm::uvec2 tiles = tilesOf(size);
  std::vector<std::array<double, 4>> result(std::size_t(tiles.x) * tiles.y);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    std::array<double, 4>& tile = result[(pixels[i] & 0xffffu) / kTile + tiles.x * ((pixels[i] >> 16) / kTile)];
    for (std::size_t channel = 0; channel < 4; ++channel) {
      tile[channel] += means[i][channel] / double(pixels.size());
    }
  }
  return result;
}

} // namespace

film::SampleSummary Moments::image(int channel) const {
  std::vector<double> values;
  for (const auto& replicate : tileMeans) {
    values.push_back(0.0);
    for (const auto& tile : replicate) {
      values.back() += tile[static_cast<std::size_t>(channel)];
    }
  }
  return film::summarise(values);
}

film::SampleSummary Moments::tile(std::size_t tile, int channel) const {
  std::vector<double> values;
  for (const auto& replicate : tileMeans) {
    values.push_back(replicate[tile][static_cast<std::size_t>(channel)]);
  }
  return film::summarise(values);
}

Moments renderMoments(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                      const MomentOptions& options) {
  gpu_scene::VolumeSet set = volumes;
  set.uses.resize(scene.media.size());
  const gpu_scene::GpuScene gpuScene(device, scene, set, render::layoutOf(options.estimator.method));
  const std::unique_ptr<render::Estimator> estimator = render::makeEstimator(device, gpuScene, set, options.estimator);
  const std::vector<std::uint32_t> pixels = pixelsOf(scene.film.size, options.skip);
  Moments result;
  result.size = scene.film.size;
  result.replicates = options.replicates;
  result.method = options.estimator.method;
  result.pixels.resize(std::size_t(scene.film.size.x) * scene.film.size.y);
  // Welford's running moments: the values of all replicates would not fit for big pictures.
  for (std::uint32_t replicate = 0; replicate < result.replicates; ++replicate) {
    const auto means = renderReplicate(*estimator, pixels, options.samples, options.firstSeed + replicate);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      for (std::size_t channel = 0; channel < 4; ++channel) {
        film::SampleSummary& summary =
            result.pixels[(pixels[i] & 0xffffu) + scene.film.size.x * (pixels[i] >> 16)][channel];
        const double delta = means[i][channel] - summary.mean;
        summary.count += 1.0;
        summary.mean += delta / summary.count;
        summary.variance += delta * (means[i][channel] - summary.mean);
      }
    }
    result.tileMeans.push_back(tileMeans(scene.film.size, pixels, means));
  }
  for (auto& pixel : result.pixels) {
    for (film::SampleSummary& summary : pixel) {
      summary.variance /= std::max(1.0, summary.count - 1.0);
    }
  }
  result.totals = estimator->totals();
  return result;
}

} // namespace tyndall::verify

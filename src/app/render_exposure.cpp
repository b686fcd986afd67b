// SPDX-License-Identifier: Apache-2.0
#include "app/render_exposure.h"

#include "film/picture.h"
#include "film/tone.h"

#include <algorithm>
#include <cmath>

namespace tyndall::app {
namespace {

constexpr std::uint32_t kLongerEdge = 96; // pixels of the preview
constexpr std::uint32_t kTrackingSamples = 16;
constexpr std::uint32_t kMarchSamples = 4; // the first 4 of a batch are a set of their own
/// A filmic curve darkens what lies between grey and white; a picture under a sky wants to be a little brighter.
constexpr double kFilmicStops = 1.0;

/// Means over 3x3 pixels: a few samples leave sparks that are not in the picture.
std::vector<float> smoothed(const std::vector<float>& channel, const glm::ivec2& size) {
  std::vector<float> result(channel.size());
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      double sum = 0.0;
      int count = 0;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, size.y - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, size.x - 1); ++u, ++count) {
          sum += double(channel[static_cast<std::size_t>(u + v * size.x)]);
        }
      }
      result[static_cast<std::size_t>(x + y * size.x)] = static_cast<float>(sum / count);
    }
  }
  return result;
}

} // namespace

double chooseExposure(const scene::Scene& scene, render::Estimator& estimator, render::Method method) {
  const std::uint32_t samples = method == render::Method::March ? kMarchSamples : kTrackingSamples;
  const glm::uvec2 size = scene.film.size;
  const std::uint32_t stride = std::max(1u, (std::max(size.x, size.y) + kLongerEdge - 1) / kLongerEdge);
  const glm::uvec2 previewSize = (size + stride - 1u) / stride;
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t y = 0; y < previewSize.y; ++y) {
    for (std::uint32_t x = 0; x < previewSize.x; ++x) {
      pixels.push_back(std::min(x * stride + stride / 2, size.x - 1) | std::min(y * stride + stride / 2, size.y - 1)
                                                                           << 16);
    }
  }
  film::Film film(previewSize, {glm::uvec2(0), previewSize});
  for (std::size_t first = 0; first < pixels.size(); first += estimator.chunkPixels()) {
    const std::size_t count = std::min<std::size_t>(estimator.chunkPixels(), pixels.size() - first);
    const auto sums = estimator.run(std::span(pixels).subspan(first, count), {0, samples}, scene.render.seed);
    for (std::size_t i = 0; i < count; ++i) {
      film::BatchSums batch;
      std::copy(std::begin(sums[i].moments), std::end(sums[i].moments), batch.moments.begin());
      std::copy(std::begin(sums[i].extras), std::end(sums[i].extras), batch.extras.begin());
      film.add(first + i, 0, samples, batch);
    }
  }
  film::Image image = film::makeImage(film, {.transparent = true});
  for (auto& [name, channel] : image.channels) {
    channel = smoothed(channel, glm::ivec2(previewSize));
  }
  const double stops = film::autoExposure(image);
  const double brighter = scene.film.view == scene::View::Filmic ? kFilmicStops : 0.0;
  return std::round(10.0 * (stops + brighter)) / 10.0;
}

} // namespace tyndall::app

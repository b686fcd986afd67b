// SPDX-License-Identifier: Apache-2.0
#include "app/render_exposure.h"

#include "film/picture.h"
#include "film/tone.h"

#include <algorithm>
#include <cmath>

namespace tyndall::app {
namespace {

constexpr std::uint32_t kLongerEdge = 112; // pixels of the preview
constexpr std::uint32_t kSamples = 8;
/// A filmic curve darkens what lies between grey and white; a picture under a sky wants to be a little brighter.
constexpr double kFilmicStops = 0.6;

} // namespace

double chooseExposure(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::GpuScene& gpuScene,
                      const render::TracerOptions& options) {
  const glm::uvec2 size = scene.film.size;
  const std::uint32_t stride = std::max(1u, (std::max(size.x, size.y) + kLongerEdge - 1) / kLongerEdge);
  const glm::uvec2 previewSize = (size + stride - 1u) / stride;
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t y = 0; y < previewSize.y; ++y) {
    for (std::uint32_t x = 0; x < previewSize.x; ++x) {
      pixels.push_back(std::min(x * stride + stride / 2, size.x - 1) | std::min(y * stride + stride / 2, size.y - 1) << 16);
    }
  }
  film::Film film(previewSize, {glm::uvec2(0), previewSize});
  render::Tracer tracer(device, gpuScene, options);
  for (std::size_t first = 0; first < pixels.size(); first += tracer.chunkPixels()) {
    const std::size_t count = std::min<std::size_t>(tracer.chunkPixels(), pixels.size() - first);
    const auto sums = tracer.run(std::span(pixels).subspan(first, count), {0, kSamples}, scene.render.seed);
    for (std::size_t i = 0; i < count; ++i) {
      film::BatchSums batch;
      std::copy(std::begin(sums[i].moments), std::end(sums[i].moments), batch.moments.begin());
      std::copy(std::begin(sums[i].extras), std::end(sums[i].extras), batch.extras.begin());
      film.add(first + i, 0, kSamples, batch);
    }
  }
  const double stops = film::autoExposure(film::makeImage(film, {.transparent = true}));
  const double brighter = scene.film.view == scene::View::Filmic ? kFilmicStops : 0.0;
  return std::round(10.0 * (stops + brighter)) / 10.0;
}

} // namespace tyndall::app

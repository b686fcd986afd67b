// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/pixel_order.h"
#include "render/renderer.h"
#include "support/probe.h"
#include "support/render_scenes.h"

namespace tyndall::test {

/// The film that the program would make of a scene, coverage mask and stopping included.
inline film::Film renderFilm(const TestScene& test, const render::RenderOptions& options,
                             render::RenderReport* report = nullptr) {
  const gpu_scene::GpuScene gpuScene(probeDevice(), test.scene, test.volumes,
                                     render::layoutOf(options.estimator.method));
  render::RenderReport own;
  return render::renderFilm(probeDevice(), test.scene, test.volumes, gpuScene, options,
                            report != nullptr ? *report : own);
}

/// Films of one scene for many seeds with one pipeline: the renderer's loop over batches without mask and progress.
class FilmRunner {
public:
  explicit FilmRunner(const TestScene& test, const render::EstimatorOptions& options = {})
      : size_(test.scene.film.size),
        gpuScene_(probeDevice(), test.scene, test.volumes, render::layoutOf(options.method)),
        estimator_(render::makeEstimator(probeDevice(), gpuScene_, test.volumes, options)),
        pixels_(render::dispatchOrder({glm::uvec2(0), size_})) {}

  film::Film run(const render::StopRule& rule, std::uint32_t seed, std::string& stoppedBy) {
    film::Film film(size_, {glm::uvec2(0), size_});
    film.independentHalves = rule.error.has_value();
    render::Schedule schedule(rule, film);
    while (const std::optional<std::uint32_t> batch = schedule.next(film)) {
      const std::uint32_t count = schedule.batchSamples(*batch);
      const auto sums = estimator_->run(pixels_, {*batch * film::kBatchSamples, count}, seed);
      for (std::size_t i = 0; i < pixels_.size(); ++i) {
        film::BatchSums values;
        std::copy(std::begin(sums[i].moments), std::end(sums[i].moments), values.moments.begin());
        std::copy(std::begin(sums[i].extras), std::end(sums[i].extras), values.extras.begin());
        film.add((pixels_[i] & 0xffffu) + size_.x * (pixels_[i] >> 16), *batch, count, values);
      }
    }
    stoppedBy = schedule.reason();
    return film;
  }

private:
  glm::uvec2 size_;
  gpu_scene::GpuScene gpuScene_;
  std::unique_ptr<render::Estimator> estimator_;
  std::vector<std::uint32_t> pixels_;
};

} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
#include "microbench/guiding_run.h"

#include "gpu_scene/meshes.h"
#include "math/colour.h"
#include "render/pixel_order.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace tyndall::microbench {
namespace {

/// Of the device's memory, for volumes.
constexpr double kVolumeShare = 0.5;
/// Of the device's memory, for chains at most.
constexpr double kStoreShare = 0.2;
constexpr std::size_t kWarmPixels = 64;

/// Since it was made.
class Clock {
public:
  Cost elapsed() const {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(),
            double(std::clock() - cpu_) / CLOCKS_PER_SEC};
  }

private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

std::vector<double> luminances(const film::Film& film) {
  std::vector<double> picture;
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    picture.push_back(luminance({film.mean(pixel, film::R), film.mean(pixel, film::G), film.mean(pixel, film::B)}));
  }
  return picture;
}

render::EstimatorOptions estimatorOptions(const scene::Scene& settings) {
  render::EstimatorOptions options;
  options.method = render::Method::Path;
  options.techniques = settings.render.lightSampling ? interop::kTechniqueLight | interop::kTechniqueDirection
                                                     : interop::kTechniqueDirection;
  // Where the device casts rays as well, each would time both and might choose otherwise.
  options.rays = render::RayCaster::Tree;
  return options;
}

} // namespace

GuidingScene::GuidingScene(const gpu::Device& device, const std::filesystem::path& path, glm::uvec2 size)
    : path_(path), scene_(scene::loadScene(path)) {
  scene_.film.size = size;
  volumes_ = gpu_scene::loadVolumes(scene_, kVolumeShare * double(device.info().memoryBytes));
  gpu_scene::addModelLights(scene_, volumes_.meshes);
  gpuScene_ = std::make_unique<gpu_scene::GpuScene>(device, scene_, volumes_, render::layoutOf(render::Method::Path));
}

scene::Scene GuidingScene::with(const std::vector<scene::Override>& overrides) const {
  const scene::Scene changed = scene::loadScene(path_, overrides);
  scene::Scene result = scene_;
  result.render = changed.render;
  result.guide = changed.guide;
  return result;
}

GuidingRun::GuidingRun(std::string name, const gpu::Device& device, const GuidingScene& scene, scene::Scene settings)
    : device_(&device), scene_(&scene), settings_(std::move(settings)) {
  figures_.name = std::move(name);
  render::EstimatorOptions options = estimatorOptions(settings_);
  if (settings_.render.integrator != scene::Integrator::Path) {
    makeStore();
    options.guide = plan();
  }
  estimator_ = render::makeEstimator(device, scene.gpuScene(), scene.volumes(), options);
  std::vector<std::uint32_t> pixels = render::dispatchOrder({glm::uvec2(0), settings_.film.size});
  pixels.resize(std::min(pixels.size(), kWarmPixels));
  estimator_->run(pixels, {0, 1}, 0); // drivers compile at the first dispatch
}

render::GuidePlan GuidingRun::plan() const {
  return {.settings = settings_.guide,
          .store = store_,
          .origin = scene_->gpuScene().centre(),
          .samples = settings_.render.samples,
          .deterministic = settings_.render.deterministic};
}

void GuidingRun::makeStore() {
  store_ =
      std::make_shared<guide::Store>(*device_, guide::storeSize(settings_.guide, settings_.film.size,
                                                                kStoreShare * double(device_->info().memoryBytes)));
}

void GuidingRun::render(std::uint32_t samples, std::uint32_t seed) {
  render::GuideTotals before;
  if (store_) {
    store_->clear();
    before = estimator_->guiding()->totals();
  }
  const Clock clock;
  Cost cost;
  render::RenderOptions options;
  options.stop.samples = samples;
  options.seed = seed;
  // After the last chunk the store is read back and counted, which is no part of a picture.
  options.progress = [&](const render::Progress&) { cost = clock.elapsed(); };
  render::RenderReport report;
  const film::Film film = render::renderFilm(*device_, settings_, scene_->volumes(), *estimator_, options, report);
  figures_.pictures.push_back(luminances(film));
  figures_.cpu.push_back(cost.cpu);
  figures_.wall.push_back(cost.wall);
  figures_.unsound += report.totals.nonFinite + report.totals.majorantExceeded;
  if (report.guide) {
    guided_ += report.guide->totals.guided - before.guided;
    vertices_ += report.guide->totals.vertices - before.vertices;
    keep(report);
  }
}

void GuidingRun::keep(const render::RenderReport& report) {
  figures_.guidedShare = vertices_ > 0 ? double(guided_) / double(vertices_) : 0.0;
  figures_.bytes = report.guide->bytes + render::guidingBytes(plan(), estimator_->chunkPixels());
  figures_.unsound += report.guide->occupancy.unsound;
}

} // namespace tyndall::microbench

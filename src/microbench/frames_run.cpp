// SPDX-License-Identifier: Apache-2.0
#include "microbench/frames_run.h"

#include "base/error.h"
#include "render/renderer.h"

namespace tyndall::microbench {
namespace {

/// Of the device's memory, for volumes.
constexpr double kVolumeShare = 0.5;
/// Of the device's memory, for chains at most.
constexpr double kStoreShare = 0.2;
/// Between the seeds of frames: no random numbers come twice.
constexpr std::uint32_t kFrameSeeds = 0x9e3779b9u;

} // namespace

scene::Scene sceneAt(const Sequence& sequence, int frame, const std::vector<scene::Override>& overrides) {
  scene::LoadResult loaded = scene::parseScene(sequence.text, sequence.name, sequence.folder, overrides, frame);
  if (!loaded.ok()) {
    std::string text;
    for (const scene::Problem& problem : loaded.problems) {
      text += fmt::format("{}:{}: {}\n", sequence.name, problem.location.line, problem.message);
    }
    fail("{}", text);
  }
  return std::move(loaded.scene);
}

std::string momentOf(const scene::Scene& scene) {
  scene::Scene still = scene;
  still.animation = {};
  return scene::toJson(still, ".");
}

void FrameRun::recall(FrameMemory memory) {
  memory_ = std::move(memory);
  moment_.clear();
}

void FrameRun::prepare(const Sequence& sequence, int frame) {
  scene_ = sceneAt(sequence, frame, contender_.overrides);
  scene_.film.size = options_.size;
  std::string moment = momentOf(scene_);
  if (moment_ == moment) {
    return; // nothing has moved, and neither constants nor code know the time
  }
  estimator_.reset(); // borrows what follows
  volumes_ = gpu_scene::loadVolumes(scene_, kVolumeShare * double(device_->info().memoryBytes));
  gpu_scene::addModelLights(scene_, volumes_.meshes);
  gpuScene_ = std::make_unique<gpu_scene::GpuScene>(*device_, scene_, volumes_, render::layoutOf(render::Method::Path),
                                                    memory_.pose ? &*memory_.pose : nullptr);
  makeEstimator(frame);
  const bool moves =
      gpuScene_->features().motion || (memory_.camera && memory_.camera->position != scene_.camera.position);
  moment_ = moves ? std::string() : std::move(moment);
}

void FrameRun::makeStore() {
  if (memory_.unit == 0.0) {
    memory_.unit = render::guideUnit(scene_.guide, *gpuScene_);
    memory_.origin = gpuScene_->centre();
    memory_.chains.clear();
  }
  if (!store_) {
    store_ = std::make_shared<guide::Store>(
        *device_, guide::storeSize(scene_.guide, options_.size, kStoreShare * double(device_->info().memoryBytes)));
  }
}

void FrameRun::makeEstimator(int frame) {
  render::EstimatorOptions options;
  options.method = render::Method::Path;
  options.techniques = scene_.render.lightSampling ? interop::kTechniqueLight | interop::kTechniqueDirection
                                                   : interop::kTechniqueDirection;
  options.rays = render::RayCaster::Tree;
  if (scene_.render.integrator != scene::Integrator::Path) {
    makeStore();
    scene::GuideSettings settings = scene_.guide;
    settings.unit = memory_.unit;
    const double frameTime = 1.0 / scene_.animation.framesPerSecond;
    options.guide = render::GuidePlan{.settings = settings,
                                      .store = store_,
                                      .origin = memory_.origin,
                                      .time = frame * frameTime,
                                      .frameTime = frameTime,
                                      .before = memory_.camera};
  }
  estimator_ = render::makeEstimator(*device_, *gpuScene_, volumes_, options);
}

film::Film FrameRun::renderSeed(std::uint32_t seed, int frame) {
  if (store_) {
    memory_.chains.resize(options_.seeds);
    guide::StoreContent& chains = memory_.chains[seed];
    chains.size == store_->size() ? store_->restore(chains) : store_->clear();
  }
  render::RenderOptions options;
  options.stop.samples = options_.samples;
  options.seed = options_.firstSeed + seed + kFrameSeeds * static_cast<std::uint32_t>(frame);
  render::RenderReport report;
  film::Film film = render::renderFilm(*device_, scene_, volumes_, *estimator_, options, report);
  if (store_) {
    memory_.chains[seed] = store_->content();
  }
  return film;
}

std::vector<film::Film> FrameRun::render(const Sequence& sequence, int frame) {
  prepare(sequence, frame);
  std::vector<film::Film> films;
  for (std::uint32_t seed = 0; seed < options_.seeds; ++seed) {
    films.push_back(renderSeed(seed, frame));
  }
  memory_.pose = gpu_scene::poseOf(scene_, volumes_.meshes);
  memory_.camera = scene_.camera;
  return films;
}

} // namespace tyndall::microbench

// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/quantities.h"
#include "app/render_exposure.h"
#include "app/render_interrupt.h"
#include "app/render_options.h"
#include "app/render_picture.h"
#include "app/render_text.h"
#include "base/error.h"
#include "render/distance_frames.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace tyndall::app {
namespace fs = std::filesystem;
namespace {

constexpr double kDefaultMemoryShare = 0.8;
/// Of the memory allowed, for chains at most.
constexpr double kGuideMemoryShare = 0.25;
/// Between the seeds of guided frames.
constexpr std::uint32_t kFrameSeeds = 0x9e3779b9u;

/// Device bytes that the render may take.
double allowedBytes(const RenderRequest& request, const gpu::Device& device) {
  return request.memoryBytes.value_or(kDefaultMemoryShare * double(device.info().memoryBytes));
}

/// Those of them that are left for volumes and light caches.
double volumeBudget(const RenderRequest& request, const gpu::Device& device) {
  const double all = allowedBytes(request, device);
  const double estimator = render::plannedBytes(device, {.method = request.method.value_or(render::Method::Tracking)});
  if (all <= estimator) {
    fail("--memory: rendering alone needs {} on this device; allow more", inBytes(estimator));
  }
  return all - estimator;
}

std::vector<std::optional<int>> framesOf(const RenderRequest& request) {
  if (!request.frames) {
    return {std::nullopt};
  }
  std::vector<std::optional<int>> frames;
  for (int frame = request.frames->first; frame <= request.frames->last; ++frame) {
    frames.emplace_back(frame);
  }
  return frames;
}

/// Renders the pictures of a request, one after the other, on one device.
class RenderSession {
public:
  explicit RenderSession(const RenderRequest& request)
      : request_(request), interrupted_(catchInterrupts()), device_(deviceOptions(request.device)),
        budget_(volumeBudget(request, device_)) {
    timings_.start = watch_.seconds();
    source_ = readSource(request_, budget_, say());
    timings_.load = watch_.seconds() - timings_.start;
    checkCrop();
    checkNothingOverwritten();
  }

  int run() {
    settleExposure();
    if (!request_.writeScene.empty()) {
      const fs::path folder = fs::absolute(request_.writeScene).parent_path();
      writeText(request_.writeScene, scene::toJson(source_.scene, folder));
      say()(fmt::format("wrote the scene {}", request_.writeScene.string()));
    }
    int exitCode = kDone;
    for (const std::optional<int>& frame : framesOf(request_)) {
      const std::unique_ptr<Prepared> prepared = takeOrPrepare(frame);
      const int code = renderPicture({request_, device_, interrupted_, say()}, *prepared, outputFiles(request_, frame));
      exitCode = std::max(exitCode, code);
      if (interrupted_) {
        exitCode = std::max(exitCode, frame == framesOf(request_).back() ? kDone : kInterrupted);
        break;
      }
    }
    return withValidation(device_, exitCode);
  }

private:
  Say say() const {
    return [quiet = request_.quiet](const std::string& text) {
      if (!quiet) {
        fmt::print("{}\n", text);
      }
    };
  }

  /// A picture must not be written over a volume or a map that it is made of.
  void checkNothingOverwritten() const {
    std::vector<std::string> read;
    for (const scene::Medium& medium : source_.scene.media) {
      read.push_back(medium.file);
    }
    for (const scene::NamedLight& light : source_.scene.lights) {
      if (const auto* map = std::get_if<scene::MapEnvironment>(&light.light)) {
        read.push_back(map->file);
      }
    }
    const OutputFiles files = outputFiles(request_, framesOf(request_).front());
    for (const std::string& input : read) {
      for (const fs::path& output : {files.exr, files.png, files.checkpoint, files.part, files.statistics}) {
        std::error_code missing;
        if (!output.empty() && fs::equivalent(output, input, missing) && !missing) {
          fail("{}: is read by the scene; name another output with -o", input);
        }
      }
    }
  }

  void checkCrop() const {
    const glm::uvec2 size = source_.scene.film.size;
    if (request_.crop && (request_.crop->max.x > size.x || request_.crop->max.y > size.y)) {
      fail("--crop: reaches beyond the picture of {}x{} pixels", size.x, size.y);
    }
  }

  std::unique_ptr<Prepared> prepare(const std::optional<int>& frame) {
    const Stopwatch load;
    auto result = std::make_unique<Prepared>();
    Prepared& prepared = *result;
    prepared.scene = sceneOfFrame(source_, request_, frame);
    prepared.timings = timings_;
    if (source_.volumes && (!frame || frame == source_.exposureFrame)) {
      prepared.volumes = std::move(*source_.volumes);
      source_.volumes.reset();
    } else {
      prepared.volumes = gpu_scene::loadVolumes(prepared.scene, budget_);
    }
    gpu_scene::addModelLights(prepared.scene, prepared.volumes.meshes);
    prepared.timings.load += load.seconds();
    const Stopwatch upload;
    chooseMethod(prepared);
    prepared.gpuScene = std::make_unique<gpu_scene::GpuScene>(
        device_, prepared.scene, prepared.volumes, render::layoutOf(prepared.choice.method), poseBefore(frame));
    pose_ = gpu_scene::poseOf(prepared.scene, prepared.volumes.meshes);
    poseFrame_ = frame;
    prepared.timings.upload = upload.seconds();
    prepared.guide = guidePlan(prepared, frame);
    if (prepared.guide) { // likewise: frames share a store
      prepared.scene.render.seed += kFrameSeeds * static_cast<std::uint32_t>(frame.value_or(0));
    }
    const Stopwatch estimator;
    prepared.estimator =
        render::makeEstimator(device_, *prepared.gpuScene, prepared.volumes, estimatorOptions(request_, prepared));
    prepared.timings.estimator = estimator.seconds();
    tellAbout(prepared);
    return result;
  }

  /// The chains of the frames before go on, where there are any.
  std::optional<render::GuidePlan> guidePlan(const Prepared& prepared, const std::optional<int>& frame) {
    if (prepared.scene.render.integrator == scene::Integrator::Path) {
      if (request_.guideViews) {
        fail("--guide-views: shows what guides the paths, and none are guided; give --integrator mcpg with it, or leave "
             "it away");
      }
      return std::nullopt;
    }
    if (request_.error) {
      fail(
          "--error: rests on two halves of the samples that know nothing of each other, and guided ones learn from the "
          "same chains; stop by --spp or --time, or give --integrator path");
    }
    scene::GuideSettings settings = prepared.scene.guide;
    settings.watch = settings.watch && !request_.moments; // whose rounds are shorter than a trial
    const gpu_scene::Features& features = prepared.gpuScene->features();
    if (scene::guidesDistances(settings) && (features.chromatic || features.mediumTree)) {
      spdlog::warn("guide.distance_share: distances are not guided where {}; leave it away",
                   features.chromatic ? "extinction differs by channel" : "there are so many media");
      settings.distanceShare = 0.0;
    }
    const guide::StoreSize size =
        guide::storeSize(settings, prepared.scene.film.size, kGuideMemoryShare * allowedBytes(request_, device_));
    if (!guide_ || !(guide_->store->size() == size)) {
      guide_ = render::GuidePlan{settings, std::make_shared<guide::Store>(device_, size), prepared.gpuScene->centre()};
      guide_->settings.unit = render::guideUnit(settings, *prepared.gpuScene);
      guideCamera_.reset();
    }
    guide_->before = std::exchange(guideCamera_, prepared.scene.camera);
    if (guide_->before) {
      render::moveDistances(*guide_->store, settings,
                            {*guide_->before, prepared.scene.camera, prepared.scene.film.size});
    }
    settings.unit = guide_->settings.unit; // cells stay what they are where bounds move
    guide_->settings = settings;
    guide_->samples = stopRule(request_, prepared.scene).samples;
    guide_->deterministic = prepared.scene.render.deterministic;
    guide_->frameTime = 1.0 / prepared.scene.animation.framesPerSecond;
    guide_->time = double(frame.value_or(0)) * guide_->frameTime;
    return guide_;
  }

  /// nullptr if the frame before was not prepared last.
  const gpu_scene::Pose* poseBefore(const std::optional<int>& frame) const {
    return frame && poseFrame_ && *poseFrame_ == *frame - 1 ? &pose_ : nullptr;
  }

  void chooseMethod(Prepared& prepared) const {
    prepared.choice = render::chooseMethod(prepared.scene, prepared.volumes, request_.method, budget_);
    if (request_.preview && prepared.choice.method != render::Method::March) {
      fail("--preview is the march without its correction, and {}; leave --preview away", prepared.choice.reason);
    }
  }

  void tellAbout(const Prepared& prepared) const {
    for (const std::string& note : prepared.volumes.notes) {
      say()(note);
    }
    for (const std::string& note : prepared.gpuScene->notes()) {
      say()(note);
    }
    tellAboutEstimator(prepared);
    if (prepared.guide) {
      say()(fmt::format("guided by {}: one unit of its lengths is {:.4g} scene units, chains take {}{}",
                        scene::integratorName(prepared.scene.render.integrator),
                        render::guideUnit(prepared.guide->settings, *prepared.gpuScene),
                        inBytes(prepared.guide->store->bytes()),
                        prepared.guide->deterministic ? "; deterministic, so it goes on whether it pays or not" : ""));
    }
    say()(fmt::format("device memory: {} of {} allowed, on {}", inBytes(double(device_.allocatedBytes())),
                      inBytes(allowedBytes(request_, device_)), device_.info().name));
    const std::vector<volume::BrickGrid>& grids = prepared.volumes.grids;
    const bool empty = std::all_of(grids.begin(), grids.end(), [](const auto& grid) { return grid.empty(); });
    if (!grids.empty() && empty) {
      spdlog::warn("{}: the volume is empty; the picture shows what is around it", prepared.scene.media.front().file);
    }
  }

  void tellAboutEstimator(const Prepared& prepared) const {
    say()(fmt::format("estimator: {} ({})", render::methodName(prepared.choice.method), prepared.choice.reason));
    if (request_.preview) {
      say()("preview: BIASED, light caches are taken for true");
    }
    const render::CacheReport caches = prepared.estimator->caches();
    if (caches.count + caches.dropped > 0) {
      say()(fmt::format("light caches of suns and lamps: {} of {}, {}, built in {:.2f} s", caches.count,
                        caches.count + caches.dropped, inBytes(caches.bytes), caches.seconds));
    }
    if (caches.dropped > 0) {
      say()(fmt::format("{} light caches do not fit into the device memory allowed: {} (--memory allows more)",
                        caches.dropped, request_.preview ? "the preview lacks their shadows" : "expect more noise"));
    }
  }

  void settleExposure() {
    if (!source_.chooseExposure) {
      return;
    }
    prepared_ = prepare(source_.exposureFrame);
    preparedFrame_ = source_.exposureFrame;
    const Stopwatch watch;
    source_.scene.film.exposure = chooseExposure(prepared_->scene, *prepared_->estimator, prepared_->choice.method);
    if (prepared_->guide) {
      // The picture draws the same random numbers again: what they have taught must not meet them.
      prepared_->guide->store->clear();
    }
    timings_.exposure = watch.seconds();
    prepared_->timings.exposure = timings_.exposure;
    if (preparedFrame_ != framesOf(request_).front()) {
      prepared_.reset(); // the budget is for one frame
    }
    say()(fmt::format("exposure {:+.1f} stops (override with --exposure)", source_.scene.film.exposure));
  }

  std::unique_ptr<Prepared> takeOrPrepare(const std::optional<int>& frame) {
    if (!prepared_ || preparedFrame_ != frame) {
      return prepare(frame);
    }
    prepared_->scene.film.exposure = source_.scene.film.exposure;
    return std::move(prepared_);
  }

  Stopwatch watch_;
  const RenderRequest& request_;
  const std::atomic<bool>& interrupted_;
  gpu::Device device_;
  double budget_;
  Timings timings_;
  Source source_;
  std::optional<render::GuidePlan> guide_; ///< of the last frame
  std::optional<scene::Camera> guideCamera_; ///< likewise
  std::unique_ptr<Prepared> prepared_;     ///< what the exposure was chosen from
  std::optional<int> preparedFrame_;
  gpu_scene::Pose pose_; ///< of the frame that was prepared last
  std::optional<int> poseFrame_;
};

} // namespace

void addRenderCommand(CLI::App& app, Action& action) {
  const std::shared_ptr<RenderRequest> request = addRenderOptions(app);
  app.get_subcommand("render")->callback([request, &action] {
    action = [request] {
      settle(*request);
      return RenderSession(*request).run();
    };
  });
}

} // namespace tyndall::app

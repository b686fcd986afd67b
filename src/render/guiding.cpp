// SPDX-License-Identifier: Apache-2.0
#include "render/guiding.h"

#include "base/error.h"
#include "gpu_scene/raster.h"

#include <algorithm>
#include <cmath>

namespace tyndall::render {
namespace {

constexpr double kUnitsOfDiagonal = 1000.0;
/// Where targets at infinity stand.
constexpr double kFarUnits = 10000.0;
/// A tenth of the scene from one frame to the next.
constexpr double kJumpUnits = 100.0;
/// Difference in distance from the camera at which a state in screen space counts for 1/e.
constexpr double kScreenDepthUnits = 10.0;

interop::GuideLevels levels(const scene::GuideLevels& settings, double unit) {
  return {.angle = float(settings.angle),
          .finest = float(settings.finest * unit),
          .ratioLog = float(std::log(settings.ratio)),
          .spread = float(settings.spread)};
}

} // namespace

double guideUnit(const scene::GuideSettings& settings, const gpu_scene::GpuScene& scene) {
  if (settings.unit > 0.0) {
    return settings.unit;
  }
  const double diagonal = scene.bounds().empty() ? 0.0 : glm::length(scene.bounds().size());
  const double fromCamera = glm::length(scene.cameraPosition() - scene.centre());
  return (diagonal > 0.0 ? diagonal : fromCamera > 0.0 ? fromCamera : 1.0) / kUnitsOfDiagonal;
}

bool looksBack(const GuidePlan& plan, const gpu_scene::GpuScene& scene) {
  return plan.settings.previousLookup && plan.settings.preset != scene::Integrator::ScreenChains && plan.before &&
         (scene.features().motion || plan.before->position != scene.cameraPosition());
}

void setGuideSpec(const GuidePlan& plan, const gpu_scene::Features& features, passes::PathSpec& spec) {
  const scene::GuideSettings& settings = plan.settings;
  // A mixture has room for no more: lobes beyond would be lost, and the picture biased.
  TYNDALL_CHECK(settings.loads * settings.states <= interop::kMostLobes);
  spec.kGuide = true;
  spec.kGuideScreen = settings.preset == scene::Integrator::ScreenChains;
  spec.kGuideLoads = settings.loads;
  spec.kGuideStates = spec.kGuideScreen ? 1 : settings.states;
  spec.kGuideStatic = settings.staticGrid;
  spec.kGuideNormals = settings.normals;
  spec.kGuideCache = !spec.kGuideScreen && settings.score == scene::GuideScore::Cache;
  spec.kGuideShare = !spec.kGuideScreen && settings.learnShare;
  spec.kGuideWeight = static_cast<std::uint32_t>(settings.weight);
  spec.kGuideFit = !spec.kGuideScreen && settings.fit;
  spec.kGuideLearn = settings.learn;
  spec.kGuideMotion = features.motion;
  spec.kGuideOrdered = plan.ordered();
  // Channels of their own would need densities of their own, and many media a walk over them at every event.
  spec.kGuideDistances = scene::guidesDistances(settings) && !features.chromatic && !features.mediumTree;
}

Guiding::Guiding(const gpu::Device& device, const gpu_scene::GpuScene& scene, const GuidePlan& plan,
                 const passes::PathSpec& spec, std::uint32_t pixels)
    : plan_(plan), unit_(guideUnit(plan.settings, scene)),
      records_(device, std::size_t(pixels) * plan.settings.records, gpu::Memory::Device),
      distanceRecords_(device, spec.kGuideDistances ? pixels : 0, gpu::Memory::Device),
      counters_(device, 1, gpu::Memory::Host), header_(device, 1, gpu::Memory::Host) {
  if (plan.settings.learn && !spec.kGuideScreen) {
    log_.emplace(device, plan.settings, plan.store->size(), spec, pixels);
  }
  header_.mapped()[0] = describe(scene);
}

interop::Guide Guiding::describe(const gpu_scene::GpuScene& scene) const {
  const scene::GuideSettings& settings = plan_.settings;
  interop::Guide guide{};
  plan_.store->describe(guide);
  guide.records = records_.ptr();
  guide.counters = counters_.ptr();
  guide.distance.records = distanceRecords_.ptr();
  guide.distance.loads = settings.distanceLoads;
  guide.distance.width = float(settings.distanceWidth);
  guide.distance.mostShare = float(settings.distanceShare);
  guide.distance.priorSigma = float(settings.distanceSigma * unit_);
  if (log_) {
    log_->describe(guide);
  }
  guide.camera = glm::vec3(scene.cameraPosition() - plan_.origin);
  guide.shift = glm::vec3(scene.centre() - plan_.origin);
  guide.levels = levels(settings.cells, unit_);
  guide.radianceLevels = levels(settings.radiance, unit_);
  guide.screenSize = scene.imageSize();
  guide.screenDepth = float(kScreenDepthUnits * unit_);
  if (plan_.before) {
    guide.rasterBefore = gpu_scene::rasterFromWorld(*plan_.before, scene.imageSize(), plan_.origin);
    guide.cameraBefore = glm::vec3(plan_.before->position - plan_.origin);
    guide.frameRound = plan_.store->round() + 1;
  }
  guide.staticWidth = float(settings.staticWidth * unit_);
  guide.adaptiveShare = float(settings.adaptiveShare);
  guide.window = settings.window;
  guide.priorArea = float(settings.priorRadius * settings.priorRadius * unit_ * unit_);
  guide.priorLeast = float(settings.priorLeast);
  guide.mostKappa = float(settings.mostKappa);
  guide.kappaGrowth = float(settings.kappaGrowth);
  guide.scatterShare = float(settings.scatterShare);
  guide.leastShare = float(settings.leastShare);
  guide.mostShare = float(settings.mostShare);
  guide.shareSamples = settings.shareSamples;
  guide.newbornShare = float(settings.newbornShare);
  guide.fitSamples = settings.fitSamples;
  guide.leastRate = float(settings.leastRate);
  guide.forgetBelow = float(settings.forgetBelow);
  guide.forgetRate = float(settings.forgetRate);
  guide.radianceLimit = float(settings.radianceLimit);
  guide.time = float(plan_.time);
  guide.frameTime = float(plan_.frameTime);
  guide.mostTime = float(settings.mostTime);
  guide.mostStep = float(kJumpUnits * unit_);
  guide.farDistance = float(kFarUnits * unit_);
  guide.mostRecords = settings.records;
  return guide;
}

std::uint32_t Guiding::roundSamples(std::uint32_t samples) const {
  if (plan_.ordered()) {
    return 1; // what the log has room for
  }
  return plan_.settings.roundSamples == 0 ? samples : std::min(plan_.settings.roundSamples, samples);
}

void Guiding::begin() {
  counters_.fillZero();
  plan_.store->nextRound();
  header_.mapped()[0].round = plan_.store->round();
}

void Guiding::collect() {
  const interop::GuideCounters& counters = counters_.mapped()[0];
  totals_.vertices += counters.vertices;
  totals_.states += counters.states;
  totals_.guided += counters.guided;
  totals_.accepted += counters.accepted;
  totals_.forgotten += counters.forgotten;
  totals_.evicted += counters.evicted;
  totals_.unsound += counters.unsound;
  totals_.distanceRays += counters.distanceRays;
  totals_.distanceGuided += counters.distanceGuided;
  totals_.lost += log_ ? log_->takeLost() : 0;
  counters_.fillZero();
}

GuideReport Guiding::report() const {
  return {totals_, plan_.store->size(), plan_.store->bytes(), plan_.store->occupancy()};
}

std::string Guiding::space() const {
  return fmt::format("{} {} {}, unit {}", plan_.origin.x, plan_.origin.y, plan_.origin.z, unit_);
}

double guidingBytes(const GuidePlan& plan, std::uint32_t pixels) {
  const bool logs = plan.settings.learn && plan.settings.preset != scene::Integrator::ScreenChains;
  const double log = logs ? guideLogBytes(plan.settings, plan.ordered(), pixels) : 0.0;
  const double distances = scene::guidesDistances(plan.settings) ? sizeof(interop::DistanceRecord) : 0.0;
  return double(pixels) * (plan.settings.records * sizeof(interop::GuideRecord) + distances) + log +
         sizeof(interop::Guide) + sizeof(interop::GuideCounters);
}

} // namespace tyndall::render

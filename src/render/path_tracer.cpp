// SPDX-License-Identifier: Apache-2.0
#include "render/path_tracer.h"

#include "render/pixel_order.h"

#include <algorithm>
#include <chrono>

namespace tyndall::render {
namespace {

/// What a ray through the surfaces counts for.
constexpr std::uint32_t kCastSteps = 16;
/// Of the picture, for timing: they fill a GPU for some milliseconds.
constexpr std::size_t kProbePixels = 65536;
/// Random numbers that no picture is likely to draw: a guided probe may teach the store.
constexpr std::uint32_t kProbeSeed = 0xb5297a4du;

} // namespace

passes::PathSpec pathSpecFor(const gpu_scene::Features& features, const EstimatorOptions& options) {
  passes::PathSpec spec;
  spec.kPhaseMask = features.phaseMask;
  spec.kFormatMask = features.formatMask;
  spec.kHomogeneous = features.homogeneous;
  spec.kGrids = features.grids;
  spec.kGridEmission = features.gridEmission;
  spec.kHomogeneousEmission = features.homogeneousEmission;
  spec.kChromatic = features.chromatic;
  spec.kSurfaces = features.surfaces;
  spec.kMaterialMask = features.materialMask;
  spec.kTextures = features.textures;
  spec.kSpheres = features.spheres;
  spec.kInstances = features.instances;
  spec.kPassing = features.passing;
  spec.kInteriors = features.interiors;
  spec.kEmitters = features.emitters;
  spec.kEmissiveSurfaces = features.emissiveSurfaces;
  spec.kVolumeEmitters = features.volumeEmitters;
  spec.kDistantDeltas = features.distantDeltas;
  spec.kDistantAreas = features.distantAreas;
  spec.kOrthographic = features.orthographic;
  spec.kLens = features.lens;
  spec.kBackground = features.background;
  spec.kAovs = options.aovs;
  spec.kLightSelection = options.lightSelection;
  spec.kTechniques = options.techniques;
  // Aiming is light sampling's: where one technique alone is asked for, as tests do, each stays what it is.
  spec.kAimed =
      features.aimed && options.aim && options.techniques == (interop::kTechniqueLight | interop::kTechniqueDirection);
  spec.kMediumTree = features.mediumTree;
  if (options.guide) {
    setGuideSpec(*options.guide, features, spec);
  }
  spec.kPlantedBug = options.plantedBug;
  return spec;
}

PathTracer::PathTracer(const gpu::Device& device, const gpu_scene::GpuScene& scene, const EstimatorOptions& options)
    : device_(device), scene_(scene), spec_(pathSpecFor(scene.features(), options)), runner_(device, options),
      trial_(options.guide && options.guide->settings.watch && options.guide->settings.learn &&
                 !options.guide->deterministic,
             options.guide ? options.guide->samples : 0u) {
  if (options.guide) {
    spec_.kGuidePrevious = looksBack(*options.guide, scene);
    guiding_ = std::make_unique<Guiding>(device, scene, *options.guide, spec_, chunkPixels());
  }
  choosePass(device, options.rays);
}

void PathTracer::choosePass(const gpu::Device& device, RayCaster wanted) {
  std::unique_ptr<passes::PathPass> tree;
  const auto makeTreePass = [&] { tree = std::make_unique<passes::PathPass>(device, spec_, scene_.images()); };
  rayChoice_ = chooseRays(wanted, device, scene_, [&](bool query) {
    if (query && !pass_) {
      makeQueryPass(device);
    } else if (!query && !tree) {
      makeTreePass();
    }
    return probeSeconds(query ? *pass_ : *tree);
  });
  if (rayChoice_.query) {
    if (!pass_) {
      makeQueryPass(device);
    }
    return;
  }
  if (!tree) {
    makeTreePass();
  }
  pass_ = std::move(tree);
  rays_.reset();
}

void PathTracer::makeQueryPass(const gpu::Device& device) {
  rays_.emplace(device, scene_.surfaces());
  pass_ = std::make_unique<passes::PathPass>(device, spec_, scene_.images(), &rays_->top());
}

interop::PathInputs PathTracer::inputs() const {
  interop::PathInputs inputs{};
  inputs.scene = scene_.ptr();
  if (guiding_) {
    inputs.guide = guiding_->ptr();
  }
  return inputs;
}

std::uint32_t PathTracer::stageCost() const { return kCastSteps + scene_.loopCount(); }

/// Of a sample each of pixels from all over the picture.
double PathTracer::probeSeconds(const passes::PathPass& pass) {
  std::vector<std::uint32_t> pixels = dispatchOrder({glm::uvec2(0), scene_.imageSize()});
  pixels.resize(std::min({pixels.size(), std::size_t{chunkPixels()}, kProbePixels}));
  const auto start = std::chrono::steady_clock::now();
  runner_.run(pass, inputs(), pixels, {0, 1}, kProbeSeed, stageCost(), [](const interop::PathCounters&) {});
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::map<std::string, std::string> PathTracer::pipeline() const {
  std::map<std::string, std::string> result;
#define SPEC(type, name, id, value) result.insert(specText(#name, spec_.name));
  TYNDALL_PATH_SPEC(SPEC)
#undef SPEC
  result.insert({"Rays", rayChoice_.reason});
  return result;
}

void PathTracer::collect(const interop::PathCounters& counters) {
  totals_.lookups += counters.lookups;
  totals_.segments += counters.segments;
  totals_.resumed += counters.suspended;
  totals_.nonFinite += counters.nonFinite;
  totals_.negative += counters.negative;
  totals_.majorantExceeded += counters.majorantExceeded;
  totals_.events += counters.events;
  totals_.longest = std::max<std::uint64_t>(totals_.longest, counters.maxEvents);
  ++totals_.dispatches;
}

std::span<const interop::PixelSums> PathTracer::run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                                    std::uint32_t seed) {
  totals_.samples += std::uint64_t(pixels.size()) * samples.count;
  trial_.begin(samples);
  const SampleRange leading = trial_.leading(samples);
  if (leading.count == samples.count) {
    return runPhase(pixels, samples, seed);
  }
  phaseSums_.assign(pixels.size(), {});
  for (SampleRange left = samples; left.count > 0;) {
    const SampleRange next = trial_.leading(left);
    addTo(phaseSums_, runPhase(pixels, next, seed));
    left = {left.first + next.count, left.count - next.count};
  }
  return phaseSums_;
}

/// Samples that belong together by the trial's plan.
std::span<const interop::PixelSums> PathTracer::runPhase(std::span<const std::uint32_t> pixels, SampleRange samples,
                                                         std::uint32_t seed) {
  return trial_.watched(samples) ? runTrial(pixels, samples, seed)
                                 : runWith(trial_.guided(samples), pixels, samples, seed);
}

/// In rounds, where the guide asks for them: each knows what those before it have found.
std::span<const interop::PixelSums> PathTracer::runWith(bool guided, std::span<const std::uint32_t> pixels,
                                                        SampleRange samples, std::uint32_t seed) {
  const std::uint32_t each = guided && guiding_ ? guiding_->roundSamples(samples.count) : samples.count;
  if (each == samples.count) {
    return runRound(guided, pixels, samples, seed);
  }
  roundSums_.assign(pixels.size(), {});
  for (std::uint32_t done = 0; done < samples.count; done += each) {
    addTo(roundSums_, runRound(guided, pixels, {samples.first + done, std::min(each, samples.count - done)}, seed));
  }
  return roundSums_;
}

std::span<const interop::PixelSums> PathTracer::runRound(bool guided, std::span<const std::uint32_t> pixels,
                                                         SampleRange samples, std::uint32_t seed) {
  if (guiding_) {
    guiding_->begin();
  }
  GuideLog* log = guided && guiding_ ? guiding_->log() : nullptr;
  if (log != nullptr) {
    log->begin(pixels.size());
  }
  const auto collectThem = [this](const interop::PathCounters& counters) {
    collect(counters);
    if (guiding_) {
      guiding_->collect();
    }
  };
  const passes::PathPass& pass = guided ? *pass_ : plainPass();
  const auto sums = runner_.run(pass, inputs(), pixels, samples, seed, stageCost(), collectThem);
  if (log != nullptr) {
    log->carryOut(guiding_->ptr());
    guiding_->collect();
  }
  return sums;
}

/// The samples in two halves, timed.
std::span<const interop::PixelSums> PathTracer::runTrial(std::span<const std::uint32_t> pixels, SampleRange samples,
                                                         std::uint32_t seed) {
  const bool guided = trial_.guided(samples);
  if (!guided) {
    plainPass();
  }
  const SampleRange half{samples.first, samples.count / 2};
  const auto start = std::chrono::steady_clock::now();
  const auto first = runWith(guided, pixels, half, seed);
  trialSums_.assign(first.begin(), first.end());
  // Samples of a batch share stratified sets; the halves must be independent, for their difference is the noise.
  constexpr std::uint32_t kApart = 0x80000000u;
  const auto second = runWith(guided, pixels, {half.first + half.count, samples.count - half.count}, seed ^ kApart);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  trial_.take(samples, trialSums_, second, seconds);
  addTo(trialSums_, second);
  return trialSums_;
}

/// The pass without guiding. Drivers compile at the first dispatch: a trial must not be timed with it.
const passes::PathPass& PathTracer::plainPass() {
  if (!plain_) {
    passes::PathSpec spec = spec_;
    spec.kGuide = false;
    plain_ = std::make_unique<passes::PathPass>(device_, spec, scene_.images(), rays_ ? &rays_->top() : nullptr);
    const std::uint32_t pixel = 0;
    runner_.run(*plain_, inputs(), std::span(&pixel, 1), {0, 1}, 0, stageCost(), [](const interop::PathCounters&) {});
  }
  return *plain_;
}

std::span<const interop::GuideView> PathTracer::viewGuide(std::span<const std::uint32_t> pixels) {
  if (!view_) {
    passes::PathSpec spec = spec_;
    spec.kGuideView = true;
    spec.kGuideLearn = false;
    spec.kGuideDistances = false;
    spec.kCount = false;
    view_ = std::make_unique<passes::PathPass>(device_, spec, scene_.images(), rays_ ? &rays_->top() : nullptr);
    views_ = gpu::Buffer<interop::GuideView>(device_, chunkPixels(), gpu::Memory::Host);
  }
  interop::PathInputs viewing = inputs();
  viewing.views = views_.ptr();
  runner_.run(*view_, viewing, pixels, {0, 1}, 0, stageCost(), [](const interop::PathCounters&) {});
  return views_.mapped().subspan(0, pixels.size());
}

void PathTracer::resetTotals() {
  Estimator::resetTotals();
  if (guiding_) {
    guiding_->resetTotals();
  }
}

const Guiding* PathTracer::guiding() const { return guiding_.get(); }

std::optional<double> PathTracer::guideGain() const { return trial_.gain(); }

} // namespace tyndall::render

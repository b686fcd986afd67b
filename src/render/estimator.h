// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"
#include "interop/pixel_sums.h"
#include "passes/path/path_io.h"
#include "render/guiding.h"
#include "render/ray_choice.h"
#include "render/sample_range.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace tyndall::render {

/// How the light along a camera ray is computed. All are unbiased; where more than one serves, they have the same
/// expectation.
enum class Method {
  March,    ///< exact march, light caches, a few corrections per ray (passes/march): media alone, one event
  Tracking, ///< null-collision tracking (passes/trace): media alone, one event
  Path      ///< paths of any length, between surfaces too (passes/path)
};
const char* methodName(Method method);

/// What a method reads grids as.
gpu_scene::GridLayout layoutOf(Method method);

struct EstimatorOptions {
  Method method = Method::Tracking;
  bool aovs = false;
  bool deltaTracking = false;    ///< tracking: delta tracking even where the weighted walk would serve
  std::uint32_t corrections = 4; ///< march: exact walks to lights per ray, at least 1
  bool preview = false;          ///< march: the light caches taken for true. Biased
  double cacheBytes = 256e6;     ///< march: for light caches at most
  std::uint32_t chunkPixels = 0; ///< pixels of one dispatch; 0 = by the device's kind
  std::uint32_t stepBound = 0;   ///< tracking: steps of one invocation in one dispatch; 0 = by the device's kind
  std::uint32_t lightSelection = interop::kSelectTree; ///< paths: interop::kSelect*
  std::uint32_t techniques =
      interop::kTechniqueLight | interop::kTechniqueDirection; ///< paths: interop::kTechnique*, one or both
  RayCaster rays = RayCaster::Auto; ///< paths
  bool aim = true; ///< paths: distances in homogeneous media drawn towards small lights as well
  std::optional<GuidePlan> guide{}; ///< paths: directions are guided
  std::uint32_t plantedBug = 0;                                ///< tests only: interop::kBug*
};

/// Counters over all dispatches so far.
struct Totals {
  std::uint64_t samples = 0;
  std::uint64_t dispatches = 0;
  std::uint64_t lookups =
      0; ///< density lookups; march: cells, whose 8 voxels are read together, and regions that corrections skip
  std::uint64_t segments =
      0;                   ///< tracking: camera, transmittance and shadow segments; march: camera rays and corrections
  std::uint64_t steps = 0; ///< march: pieces of camera rays, skipped regions included
  std::uint64_t resumed = 0; ///< tracking: invocations that reached the step bound and went on in a next dispatch
  std::uint64_t nonFinite = 0;
  std::uint64_t negative = 0;         ///< tracking
  std::uint64_t majorantExceeded = 0; ///< tracking
  std::uint64_t events = 0;           ///< paths: scattering events
  std::uint64_t longest = 0;          ///< paths: most events of one
  std::uint64_t cut = 0;              ///< march: rays that were not walked to their end
};

/// Light caches of a march.
struct CacheReport {
  std::uint32_t count = 0;
  std::uint32_t dropped = 0; ///< for want of memory; their lights are corrected from nothing
  double bytes = 0.0;
  double seconds = 0.0; ///< to build
};

/// Runs batches of samples on the device. Borrows the device, the scene and the volumes.
class Estimator {
public:
  virtual ~Estimator() = default;

  /// @param pixels x | y << 16, absolute; at most chunkPixels(). @return one entry per pixel, valid until the next
  /// call. They depend on pixel, sample indices and seed alone.
  virtual std::span<const interop::PixelSums> run(std::span<const std::uint32_t> pixels, SampleRange samples,
                                                  std::uint32_t seed) = 0;
  virtual std::uint32_t chunkPixels() const = 0;
  virtual std::size_t kernelBytes() const = 0;
  /// Flags and numbers of the pipeline by name: what was left out.
  virtual std::map<std::string, std::string> pipeline() const = 0;
  virtual CacheReport caches() const { return {}; }
  /// Null where nothing is guided.
  virtual const Guiding* guiding() const { return nullptr; }
  /// What the store says of first vertices; nothing is learnt or rendered. Only where guiding() is not null.
  /// @param pixels at most chunkPixels(). @return one entry per pixel, valid until the next call.
  virtual std::span<const interop::GuideView> viewGuide(std::span<const std::uint32_t> /*pixels*/) { return {}; }
  /// How many times less variance times time guiding has; below 1 it has been switched off. nullopt: not measured.
  virtual std::optional<double> guideGain() const { return std::nullopt; }

  const Totals& totals() const { return totals_; }
  /// Starts counting anew.
  virtual void resetTotals() { totals_ = {}; }

protected:
  Totals totals_;
};

/// @param volumes what the scene was uploaded from. @param scene uploaded with layoutOf(options.method).
std::unique_ptr<Estimator> makeEstimator(const gpu::Device& device, const gpu_scene::GpuScene& scene,
                                         const gpu_scene::VolumeSet& volumes, const EstimatorOptions& options);

/// Device bytes that an estimator will allocate beside the scene and light caches.
double plannedBytes(const gpu::Device& device, const EstimatorOptions& options);

/// Name and value of a specialization constant, as the statistics show it: "on", "left out" or a number.
template <class T>
std::pair<std::string, std::string> specText(const char* name, T value) {
  if constexpr (std::is_same_v<T, bool>) {
    return {name + 1, value ? "on" : "left out"}; // without the k
  } else {
    return {name + 1, std::to_string(value)};
  }
}

/// Pixels of one dispatch where the options do not say.
std::uint32_t chunkFor(const gpu::Device& device, const EstimatorOptions& options);

} // namespace tyndall::render

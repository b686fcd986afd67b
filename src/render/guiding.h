// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"
#include "guide/store.h"
#include "passes/path/path_pass.h"
#include "render/guide_log.h"

#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace tyndall::render {

/// What guides the paths of a render. The store outlives estimators: it goes from frame to frame.
struct GuidePlan {
  scene::GuideSettings settings;
  std::shared_ptr<guide::Store> store;
  glm::dvec3 origin{0.0};                ///< of the store's space, in the world
  double time = 0.0;                     ///< of the frame [s]
  double frameTime = 1.0;                ///< since the frame before [s]
  std::optional<scene::Camera> before{}; ///< of the frame before, in whose picture the store's chains lie
  std::uint32_t samples = std::numeric_limits<std::uint32_t>::max(); ///< per pixel that the picture will have at most
  bool deterministic = false;            ///< the store is written in a fixed order; nothing is decided by time

  bool ordered() const { return deterministic && settings.learn && settings.preset != scene::Integrator::ScreenChains; }
};

/// Counters over all dispatches so far.
struct GuideTotals {
  std::uint64_t vertices = 0; ///< that asked for a direction
  std::uint64_t states = 0;   ///< loaded that were not empty
  std::uint64_t guided = 0;   ///< directions that lobes drew
  std::uint64_t accepted = 0; ///< samples that became states
  std::uint64_t forgotten = 0;
  std::uint64_t evicted = 0;
  std::uint64_t unsound = 0;
  std::uint64_t lost = 0;           ///< updates that the log had no room for
  std::uint64_t distanceRays = 0;   ///< camera rays that found distance chains
  std::uint64_t distanceGuided = 0; ///< ... whose distance they drew
};

/// What guiding came to.
struct GuideReport {
  GuideTotals totals;
  guide::StoreSize size;
  double bytes = 0.0; ///< of the store
  guide::Occupancy occupancy;
};

/// One unit of the guide's lengths, in scene units.
double guideUnit(const scene::GuideSettings& settings, const gpu_scene::GpuScene& scene);

/// Whether cells are looked up where surfaces and camera were in the frame before: where something has moved.
bool looksBack(const GuidePlan& plan, const gpu_scene::GpuScene& scene);

/// Specialization of the path pass for the settings.
void setGuideSpec(const GuidePlan& plan, const gpu_scene::Features& features, passes::PathSpec& spec);

/// Device side of a plan for one estimator: its constants, and the records of paths in flight.
class Guiding {
public:
  /// @param pixels of a dispatch.
  Guiding(const gpu::Device& device, const gpu_scene::GpuScene& scene, const GuidePlan& plan,
          const passes::PathSpec& spec, std::uint32_t pixels);

  interop::Ptr<interop::Guide> ptr() const { return header_.ptr(); }
  /// Samples of a pixel in a round of `samples` at most.
  std::uint32_t roundSamples(std::uint32_t samples) const;
  /// Before the dispatches of a call: counters at zero, the store in a round of its own.
  void begin();
  /// After each of them: counters are added up, and at zero again.
  void collect();
  bool deterministic() const { return plan_.deterministic; }
  /// Null where nothing is learnt.
  GuideLog* log() { return log_ ? &*log_ : nullptr; }
  const GuideTotals& totals() const { return totals_; }
  void resetTotals() { totals_ = {}; }
  GuideReport report() const;
  guide::Store& store() const { return *plan_.store; }
  /// What targets and cells of the store are relative to, as text: another one makes them worthless.
  std::string space() const;

private:
  interop::Guide describe(const gpu_scene::GpuScene& scene) const;

  GuidePlan plan_;
  double unit_;
  gpu::Buffer<interop::GuideRecord> records_;
  gpu::Buffer<interop::DistanceRecord> distanceRecords_;
  gpu::Buffer<interop::GuideCounters> counters_;
  std::optional<GuideLog> log_;
  gpu::Buffer<interop::Guide> header_;
  GuideTotals totals_;
};

/// Device bytes that guiding takes beside its store.
double guidingBytes(const GuidePlan& plan, std::uint32_t pixels);

} // namespace tyndall::render

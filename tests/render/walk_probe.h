// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"
#include "render/tracer.h"
#include "support/render_scenes.h"
#include "walk_probe_io.h"

#include <memory>
#include <vector>

namespace tyndall::test {

/// A segment in the scene's own world space.
struct ProbeSegment {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, 1.0}; ///< unit
  double tMax = 1e30;
};

/// What walking one segment many times gave.
struct SegmentEstimate {
  double transmittance = 0.0;
  double standardError = 0.0;
  double walks = 0.0;
  double hits = 0.0;
};

struct WalkReport {
  std::vector<SegmentEstimate> segments;
  std::vector<float> distances; ///< one per walk and < 0 without a collision, if asked for
  double lookups = 0.0;
  double exceeded = 0.0;
};

struct WalkCountsWanted {
  std::uint32_t invocationsPerRay = 16;
  std::uint32_t walks = 64; ///< per invocation
  std::uint32_t mode = 1;   ///< 0 collide, 1 transmit: kWalk* of tracker/walk.glsl
  std::uint32_t seed = 1;
  bool distances = false;
  float firstXi = 1.0f; ///< < 1: condition on a first draw below it; segments must enter the first grid
};

/// Walks segments through a scene's grid media with the shipped tracker.
class WalkProbe {
public:
  WalkProbe(const TestScene& test, const render::EstimatorOptions& options = {});
  WalkReport run(const std::vector<ProbeSegment>& segments, const WalkCountsWanted& wanted) const;

private:
  std::unique_ptr<gpu_scene::GpuScene> scene_;
  std::unique_ptr<gpu::Kernel> kernel_;
};

} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/kernel.h"
#include "march_probe_io.h"
#include "render/march_scene.h"
#include "render/marcher.h"
#include "support/render_scenes.h"
#include "verify/oracle_radiance.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tyndall::test {

/// The same rays twice, as in RaySet, in world space.
struct MarchRays {
  std::vector<interop::MarchProbeRay> device;
  std::vector<OracleRay> exact; ///< what the floats say, in double; directions of unit length
};

/// Samples of a batch, at most film::kBatchSamples and not beyond its end.
struct ProbeSamples {
  std::uint32_t first = 0;
  std::uint32_t count = 1;
  std::uint32_t seed = 1;
};

/// A scene on the device, for marches along given rays. Borrows the scene; not for environments.
class MarchProbe {
public:
  /// Spoils what the grids' walks are packed from: which bricks are empty, and where the field ends.
  using Plant = std::function<void(gpu_scene::PackedMedia&)>;

  /// @param plant for scenes without lights.
  explicit MarchProbe(const TestScene& test, std::uint32_t plantedBug = interop::kBugNone, const Plant& plant = {});

  /// Rays in world space, rounded to what the device can take.
  MarchRays rays(std::span<const OracleRay> world) const;
  std::vector<interop::MarchProbeResult> march(const MarchRays& rays, const ProbeSamples& samples = {}) const;
  /// @param mode interop::kProbeDepth or kProbeStateless.
  std::vector<interop::MarchProbeResult> walk(const MarchRays& rays, std::uint32_t mode) const;

private:
  void plantGrids(const TestScene& test, const Plant& plant);
  std::vector<interop::MarchProbeResult> run(const MarchRays& rays, interop::MarchProbeInputs inputs) const;

  gpu_scene::GpuScene scene_;
  render::MarchScene march_;
  gpu_scene::CellGrids plantedGrids_;
  gpu::Buffer<interop::MarchScene> plantedHeader_;
  std::unique_ptr<gpu::Kernel> kernel_;
};

} // namespace tyndall::test

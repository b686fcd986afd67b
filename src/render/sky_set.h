// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/gpu_scene.h"
#include "interop/march.h"

#include <cstdint>
#include <vector>

namespace tyndall::render {

/// The directions to environments that a batch shares: one in each cell of the octahedral square, uniform in its cell
/// and independent of all other cells, batches and seeds. Unit, kSkyDirections of them, x fastest.
std::vector<glm::vec3> skyDirections(std::uint32_t seed, std::uint32_t batch);

/// Whether a phase function may have a peak narrower than a cell of the set.
bool peaked(const interop::Phase& phase);

/// How a sample of the march draws its direction to environments; the rest is the set's.
struct SkyShares {
  float light = 0.0f; ///< by an environment's own sampler: where a map may hold a bright spot
  float phase = 0.0f; ///< by a phase function: where one may have a peak narrower than a cell
};
SkyShares skyShares(const gpu_scene::GpuScene& scene);

} // namespace tyndall::render

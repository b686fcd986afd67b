// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interop/environment.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace tyndall::light {

/// What light/environment.glsl reads, as host values.
struct EnvironmentTable {
  std::vector<glm::vec3> texels;            ///< sanitised and scaled, size.x * size.y
  glm::uvec2 size{0};
  std::vector<interop::AliasEntry> cells;   ///< cellCount.x * cellCount.y
  glm::uvec2 cellCount{0};
  double power = 0.0;                       ///< luminance integrated over the sphere; 0: black, not to be sampled
  std::size_t badTexels = 0;                ///< texels with a negative, infinite or NaN channel, set to 0 there
};

/// Importance table over the texels' squares, or over at most 1024 x 512 cells for larger maps: positive wherever
/// the bilinear radiance is. @param texels size.x * size.y of linear Rec.709, top row first. @param scale >= 0.
EnvironmentTable makeEnvironment(std::span<const glm::vec3> texels, const glm::uvec2& size, double scale);

/// What kernels get, once `texels` and `cells` are uploaded. @param rotation degrees about +y, counterclockwise from above.
interop::EnvironmentMap deviceMap(const EnvironmentTable& table, double rotation, interop::Ptr<glm::vec3> texels,
                                  interop::Ptr<interop::AliasEntry> cells);

} // namespace tyndall::light

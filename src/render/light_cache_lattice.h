// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interop/light_cache.h"
#include "math/bounds.h"

namespace tyndall::render {

/// What a light cache spans, in the grid's voxel space.
struct LightCacheTarget {
  Bounds3 bounds;        ///< of the grid's field
  glm::dvec3 light{0.0}; ///< distant: towards it, of any length; else its position
  bool distant = false;
};

/// Kind, node count and node positions of the lattice with the fewest nodes that suits the light, nodes `spacing`
/// voxels apart (point lights: at the middle of the grid). A sun has columns parallel to its light and planes across
/// the axis it leans least from; a point light a pencil through a face that it is beyond, or columns to all sides.
/// Grid, extinction and map are left to the caller.
interop::LightCache lightCacheLattice(const LightCacheTarget& target, double spacing);

/// The unit direction of a place in [-1, 1]^2, as directionFromOctahedral of core/octahedral.glsl.
glm::dvec3 octahedralDirection(const glm::dvec2& place);

} // namespace tyndall::render

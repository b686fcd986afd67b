// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/acceleration.h"
#include "gpu_scene/surfaces.h"

#include <optional>
#include <string>
#include <vector>

namespace tyndall::gpu_scene {

/// Primitives of one tree within Bvh::primitives.
struct PrimitiveRange {
  std::uint32_t root = 0; ///< its node
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// The world's primitives, then those of every instanced mesh, in the order of their roots.
std::vector<PrimitiveRange> primitiveRanges(const PackedSurfaces& surfaces);

/// Three corners per primitive of the range. What is no triangle is kept as one without area, which no ray hits, so
/// that the n-th triangle is the n-th primitive. (Inactive triangles, of NaN, would serve where drivers know them: Mesa
/// 25's lavapipe lets them ruin its tree.)
std::vector<glm::vec3> rangeCorners(const PackedSurfaces& surfaces, const PrimitiveRange& range);

/// Why ray queries cannot serve these surfaces; nullopt: they can.
std::optional<std::string> rayQueryObstacle(const gpu::Device& device, const PackedSurfaces& surfaces);

/// The surfaces as the device's own trees, for shaders/geometry/ray_query.glsl. Places of the top one, in this order:
/// the world's triangles, the instances, the spheres. A place's index plus that of a triangle within it, or a sphere's
/// place's index alone, is the index into Bvh::primitives.
class RayQueryTree {
public:
  /// @throws Error on exhausted memory. Wants surfaces without an obstacle.
  RayQueryTree(const gpu::Device& device, const PackedSurfaces& surfaces);

  const gpu::AccelerationStructure& top() const { return *top_; }
  std::size_t bytes() const;

private:
  std::vector<gpu::AccelerationStructure> meshes_; ///< one per range
  std::optional<gpu::AccelerationStructure> box_;  ///< of every sphere
  std::optional<gpu::AccelerationStructure> top_;
};

} // namespace tyndall::gpu_scene

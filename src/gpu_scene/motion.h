// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/meshes.h"
#include "interop/surfaces.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace tyndall::gpu_scene {

/// What the motion of the next frame needs of a frame.
struct Pose {
  scene::Scene scene;
  std::vector<std::vector<geometry::Node>> nodes; ///< per object: of its file
};

Pose poseOf(const scene::Scene& scene, const MeshSet& meshes);

/// Where the objects of a frame were in the previous one, as affine maps. Frames whose objects differ in number, kind,
/// file, nodes or number of copies have none in common: nothing moves.
class SurfaceMotion {
public:
  /// Nothing moves.
  SurfaceMotion() = default;
  /// @param centre of this frame: what the maps' points are relative to.
  SurfaceMotion(const Pose& now, const Pose& previous, const glm::dvec3& centre);

  /// Index into motions() or interop::kNoMotion.
  /// @param copy in the order of `placements`. @param node of the object's file; 0 without one
  std::uint32_t indexOf(std::size_t object, std::size_t copy, std::size_t node) const;
  const std::vector<interop::Motion>& motions() const { return motions_; }

private:
  void addObject(const Pose& now, const Pose& previous, std::size_t object, const glm::dmat4& centredFromWorld);

  std::vector<interop::Motion> motions_;
  std::vector<std::size_t> nodeCounts_;             ///< per object, at least 1
  std::vector<std::vector<std::uint32_t>> indices_; ///< per object: by copy and node; empty: nothing moves
};

} // namespace tyndall::gpu_scene

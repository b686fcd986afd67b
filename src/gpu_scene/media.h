// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "interop/scene.h"
#include "math/bounds.h"
#include "scene/scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Scene values -> device structs, without a device: pure functions.
namespace tyndall::gpu_scene {

/// World bounds of everything bounded: media, objects, point and spot lights; the camera's position if there is nothing
/// else.
Bounds3 sceneBounds(const scene::Scene& scene, const VolumeSet& volumes);

/// A grid on the device but for its addresses. World space is centred on `centre`.
interop::Grid packGrid(const volume::BrickGrid& grid, const glm::dmat4& worldFromMedium, const glm::dvec3& centre);

/// Parameters as the device's model takes them (a droplet's diameter becomes its fit).
interop::Phase packPhase(const scene::Phase& phase);

/// The device's media: homogeneous ones first, empty grids left out. Grid indices count the *placed* grids in
/// `placements` (a brick grid seen through one medium's transform).
struct PackedMedia {
  struct Placement {
    std::size_t grid = 0;      ///< index into VolumeSet::grids
    interop::Grid header;      ///< addresses still empty
    std::vector<float> maxima; ///< per brick: density maxima, or the luminance of the strongest emission
    std::vector<float> coarseMaxima;
    std::optional<std::size_t> sameAs; ///< an earlier placement whose bricks and maxima these are; then both are empty
    std::vector<float> cumulative;     ///< of emission: sums over bricks of maximum * volume inside the bounds
  };
  std::vector<std::uint32_t> indexOf; ///< per medium of the scene: its first one in `media`, or interop::kNoMedium
  std::vector<interop::Medium> media;
  std::vector<Placement> placements;
  std::vector<std::uint32_t> emissive;
  std::uint32_t homogeneousCount = 0;
  std::uint32_t phaseMask = 0;
  bool chromatic = false; ///< an extinction differs by channel

  /// The placement that holds the bricks and maxima of `placement`.
  const Placement& source(const Placement& placement) const {
    return placement.sameAs ? placements[*placement.sameAs] : placement;
  }
  std::vector<std::string> notes; ///< e.g. how a temperature grid was mapped to kelvin
};
/// @param centre the world point that device coordinates are relative to.
PackedMedia packMedia(const scene::Scene& scene, const VolumeSet& volumes, const glm::dvec3& centre);

/// The camera's rays over an image of `imageSize` pixels.
interop::Camera packCamera(const scene::Camera& camera, const glm::uvec2& imageSize, const glm::dvec3& centre);

} // namespace tyndall::gpu_scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "scene/scene.h"

#include <optional>
#include <string>

namespace tyndall::bench {

/// A scene with its grids, and what a measurement must know about it.
struct BenchScene {
  scene::Scene scene;
  gpu_scene::VolumeSet volumes;
  std::optional<glm::dvec2> lightPixel; ///< where a point light lies in the picture; pixels round it are left out
};

/// @param opticalDepth median over lines through the grid. @param size edge of the picture.
/// The volume seen from the front, filling the picture, under one delta sun; albedo 0.9, Henyey-Greenstein g = 0.3.
BenchScene sunScene(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size);
/// The same volume in thin fog (optical depth 0.2 over the volume's diagonal) with a point light beside it.
BenchScene foggyPointScene(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size);
/// The same volume under a clear sky: environment light alone.
BenchScene skyScene(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size);

/// The generator's cloud, stretched to a cube of `edge` voxels of size 1.
volume::BrickGrid cloudOfEdge(int edge);

} // namespace tyndall::bench

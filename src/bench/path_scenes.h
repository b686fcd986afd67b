// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/ray_scenes.h"
#include "bench/scenes.h"

namespace tyndall::bench {

/// All of these: paths of any length. @param size edge of the picture.

/// A ray scene with diffuse walls, red and green where it has walls at x = -1 and 1; its light shines downwards.
BenchScene surfaceScene(const RayScene& rays, std::uint32_t size);
/// A cube of edge 2 full of mist of optical depth 2, albedo 0.9, under a sun without angular size.
BenchScene mistScene(std::uint32_t size);
/// Fills the cube of edge 2 about the origin with fog of that extinction, albedo 0.9.
void addFog(BenchScene& scene, double sigmaT);
/// A triangle so far away and so small that no path will find it.
void addFarSurface(BenchScene& scene);
/// Copies of the scene's first medium in a row, 1.2 of its widths apart, seen from further away.
void repeatMedium(BenchScene& scene, int copies);

enum class LightScene {
  PointsOverFloor, ///< floor of 20 by 20, lights 0.3 to 1 above it, no medium
  QuadsInMist      ///< the same floor, squares of edge 0.05 that face it, mist of optical depth 0.5 over the scene
};
const char* lightSceneName(LightScene kind);
/// `count` lights whose powers are log-normal with sigma 1, and in all do not depend on the count.
BenchScene lightsScene(LightScene kind, std::size_t count, std::uint32_t size);

} // namespace tyndall::bench

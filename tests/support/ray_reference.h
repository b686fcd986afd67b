// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "scene/scene.h"
#include "support/ray_reference_grid.h"

#include <span>
#include <vector>

/// References along given rays in double, fast enough for whole pictures. `OracleScene` is the slow and simple check.
namespace tyndall::test {

/// How a ray is cut into pieces, each of which takes one Gauss-Legendre rule.
struct RayReferenceSettings {
  int nodes = 6;             ///< of the rule, >= 2
  double opticalDepth = 1.0; ///< longest piece in optical depth along the ray
  double angle = 0.2;        ///< longest piece in radians seen from a point light
  double voxels = 2.0;       ///< longest piece in voxels, wherever light comes through the grid
  double roughness = 1e-6;   ///< pieces with a larger top Legendre coefficient, relative to the ray's sum, are halved
  int channel = 0;           ///< of albedo and lights, in [0, 3)
};

/// Radiance of light scattered once, docs/theory.md (1) without emission and background, per ray, in W/(m2 sr).
/// Grid and homogeneous media of any transform, overlapping; point lights and suns of diameter 0. A ray is cut wherever
/// its integrand has a kink; pieces are short by `settings`, and are halved where they are still rough. Optical depths
/// are exact. Rays must not start at, or pass through, a point light.
/// @throws Error for other lights.
std::vector<double> singleScattering(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                                     std::span<const OracleRay> rays, const RayReferenceSettings& settings = {});

} // namespace tyndall::test

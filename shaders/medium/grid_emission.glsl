// SPDX-License-Identifier: Apache-2.0
// Emission of media with grids at a point. The includer declares `const uint kPlantedBug`.
#ifndef TYNDALL_MEDIUM_GRID_EMISSION_GLSL
#define TYNDALL_MEDIUM_GRID_EMISSION_GLSL

#include "interop/planted_bugs.h"
#include "medium/atlas.glsl"
#include "medium/emission.glsl"

// Emission of a grid medium at a centred world point. All 8 taps first, then Planck: it is not linear.
vec3 gridEmission(ScenePtr scene, uint mediumIndex, vec3 point, inout Rng rng) {
  MediumPtr media = scene.at[0].media;
  Grid grid = scene.at[0].grids.at[media.at[mediumIndex].emissionGrid];
  const vec3 voxel = grid.voxelFromWorld * vec4(point, 1.0);
  float value = gridTrilinear(grid, voxel);
  if (kPlantedBug == kBugOneTapBlackbody) {
    const ivec3 brick = clamp(ivec3(floor(voxel / float(kBrickEdge))), ivec3(0), grid.brickCount - 1);
    value = gridOneTap(grid, brick, voxel, rng);
  }
  float sigmaT = 0.0;
  if (media.at[mediumIndex].emissionTied != 0u && media.at[mediumIndex].densityGrid != kNoGrid) {
    Grid density = scene.at[0].grids.at[media.at[mediumIndex].densityGrid];
    sigmaT = media.at[mediumIndex].sigmaT * gridTrilinear(density, density.voxelFromWorld * vec4(point, 1.0));
  }
  return emissionOf(media.at[mediumIndex], scene.at[0].blackbody, value, sigmaT);
}

#endif

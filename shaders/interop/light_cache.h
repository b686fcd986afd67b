// SPDX-License-Identifier: Apache-2.0
// Optical depth of one grid medium towards one light, tabulated on columns that are the light's own rays: exact at the
// nodes, one walk per column gives them all. Planned and owned by render::LightCaches, built by the pass `light_cache`,
// read by light/cache.glsl.
#ifndef TYNDALL_INTEROP_LIGHT_CACHE_H
#define TYNDALL_INTEROP_LIGHT_CACHE_H

#include "interop/cells.h"

GPU_BEGIN

GPU_CONST uint kCacheProjective = 0; // parallel columns (sun), or a pencil of them (a point light outside the grid)
GPU_CONST uint kCacheOctahedral = 1; // columns to all sides (a point light inside the grid, or close to it)

// Node (a, b, j) lies at origin(a, b) + j * step(a, b) in the grid's voxel space, j counted from the light's side.
// Projective: origin(a, b) = origin0 + a originA + b originB, and step alike; the planes of equal j lie across one axis.
// Octahedral: origin0 is the light, (a, b) a place on the octahedral square, its corner (-1, -1) first, and node j at
// the radius firstRadius + j * radiusStep.
// No optical depth lies between the light and j = 0, nor between the last j and the grid's far side.
struct LightCache {
  uint kind;               // kCache*
  uint grid;               // index of its CellGrid
  ivec3 count;             // nodes along a, b, j; at least 2 each
  float sigmaT;            // extinction per unit of density [1/unit]
  mat4 latticeFromVoxel;   // projective: gives (a w, b w, j, w), w > 0 inside the grid's bounds
  mat4x3 worldFromVoxel;   // its linear part measures the columns
  float firstRadius;       // octahedral: voxels
  float radiusStep;        // octahedral: voxels
  vec3 origin0;
  vec3 originA;
  vec3 originB;
  vec3 step0;
  vec3 stepA;
  vec3 stepB;
  GPU_PTR(float) depths;   // optical depth between light and node, a fastest, then b, then j
};
GPU_BUFFER(LightCache)

GPU_END
#endif

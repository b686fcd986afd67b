// SPDX-License-Identifier: Apache-2.0
// A brick grid on the device (volume/brick_grid.h is its host side).
#ifndef TYNDALL_INTEROP_GRID_H
#define TYNDALL_INTEROP_GRID_H

#include "interop/basic.h"

GPU_BEGIN

// Texel format of a grid's voxels = binding of the atlas that holds them = bit of kFormatMask.
GPU_CONST uint kFormatUint8 = 0;
GPU_CONST uint kFormatHalf = 1;
GPU_CONST uint kFormatFloat = 2;

GPU_CONST uint kConstantBrick = 0xffffffffu;
GPU_CONST uint kNoGrid = 0xffffffffu;
GPU_CONST int kBrickEdge = 8;  // voxels
GPU_CONST int kCoarseEdge = 4; // bricks

// Voxel value = offset + scale * texel; a constant brick is `offset` everywhere.
struct Brick {
  uint texelBrick; // atlas position in bricks, x | y << 10 | z << 20; kConstantBrick = no voxels
  float scale;
  float offset;
};
GPU_BUFFER(Brick)

// "Voxel space" counts voxels from the first voxel of brick 0; values live at integer coordinates.
struct Grid {
  mat4x3 voxelFromWorld; // affine, from centred world space
  vec3 boundsMin;        // voxel space; the field is 0 outside
  vec3 boundsMax;
  ivec3 brickCount;
  ivec3 coarseCount;
  uint format;               // kFormat*
  GPU_PTR(Brick) bricks;     // x fastest
  GPU_PTR(float) maxima;     // per brick: >= every value reconstructed inside it
  GPU_PTR(float) coarseMaxima;
  GPU_PTR(float) cumulative; // emission grids as lights: sums over bricks of maximum * volume inside the bounds, or 0
};
GPU_BUFFER(Grid)

GPU_END
#endif

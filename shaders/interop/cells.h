// SPDX-License-Identifier: Apache-2.0
// A grid as walks from cell to cell read it: every brick's voxels with their far neighbours, as floats, so that a cell
// never looks into two bricks. Made by gpu_scene::CellGrids.
#ifndef TYNDALL_INTEROP_CELLS_H
#define TYNDALL_INTEROP_CELLS_H

#include "interop/grid.h"

GPU_BEGIN

GPU_CONST uint kEmptyBrick = 0xffffffffu;
GPU_CONST int kBlockEdge = kBrickEdge + 1;                        // voxels 0 .. 8 of a brick
GPU_CONST int kBlockVoxels = kBlockEdge * kBlockEdge * kBlockEdge;

// A "cell" is the cube between 8 neighbouring voxels: the field is trilinear in it.
struct CellGrid {
  mat4x3 voxelFromWorld; // affine, from centred world space
  vec3 boundsMin;        // voxel space; the field is 0 outside
  vec3 boundsMax;
  ivec3 brickCount;
  ivec3 coarseCount;
  GPU_PTR(uint) blocks;        // per brick, x fastest: its block's number, or kEmptyBrick
  GPU_PTR(float) voxels;       // kBlockVoxels per block, x fastest
  GPU_PTR(float) coarseMaxima; // per coarse cell
};
GPU_BUFFER(CellGrid)

GPU_END
#endif

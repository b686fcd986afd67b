// SPDX-License-Identifier: Apache-2.0
// Rays from cell to cell of a grid, in lockstep: every lane takes one cell per step, no random numbers, no early death.
// A cell is left by an integer step along the axis of its nearest far plane, so that a walk cannot stall on a
// plane, and visits a cell again over a length of 0 alone; planes are taken from integers, so that nothing adds up. Empty bricks and empty
// coarse cells (4^3 bricks) are one step each.
//
// The ray's origin should lie near the grid: floats near a far camera are coarser than a cell.
#ifndef TYNDALL_TRACKER_CELLS_GLSL
#define TYNDALL_TRACKER_CELLS_GLSL

#include "interop/cells.h"
#include "medium/shape.glsl"

struct CellWalk {
  vec3 origin;     // voxel space
  vec3 direction;  // voxels per unit of t
  vec3 inverse;    // of direction; kInfiniteDistance where it is 0
  ivec3 towards;   // 1 where the direction is positive, else 0
  ivec3 cell;
  float tEnter;    // the stretch of the ray inside the grid's bounds; empty: tEnter >= tLeave
  float tLeave;
};

// What lies ahead of a walk: how far, and what the field is on the way.
struct CellStep {
  float tExit;
  uint block;  // kEmptyBrick: the field is 0 up to tExit
  int axis;    // that the exit plane belongs to
  int edge;    // cells of the region that is left: 1, kBrickEdge or kBrickEdge * kCoarseEdge
};

// The field along a part of a ray inside one cell: k.x + k.y f + k.z f^2 + k.w f^3, f in [0, 1] over the part.
float cubicAt(vec4 k, float f) { return max(k.x + f * (k.y + f * (k.z + f * k.w)), 0.0); }

// Its integral over [0, f].
float cubicIntegral(vec4 k, float f) {
  return max(f * (k.x + f * (0.5 * k.y + f * (k.z * (1.0 / 3.0) + f * (0.25 * k.w)))), 0.0);
}

// Origin and direction in voxel space: the walk covers origin + t * direction, t in [tMin, tMax].
CellWalk cellWalkBegin(CellGrid grid, vec3 origin, vec3 direction, float tMin, float tMax) {
  CellWalk walk;
  walk.origin = origin;
  walk.direction = direction;
  const bvec3 still = equal(walk.direction, vec3(0.0));
  walk.inverse = mix(1.0 / mix(walk.direction, vec3(1.0), still), vec3(kInfiniteDistance), still);
  walk.towards = ivec3(greaterThan(walk.direction, vec3(0.0)));
  const vec2 interval = boxInterval(walk.origin, walk.direction, grid.boundsMin, grid.boundsMax, tMax);
  walk.tEnter = max(interval.x, tMin);
  walk.tLeave = interval.y;
  const vec3 point = walk.origin + walk.tEnter * walk.direction;
  walk.cell = clamp(ivec3(floor(point)), ivec3(0), grid.brickCount * kBrickEdge - 1);
  return walk;
}

// Far planes of a region of `edge` cells, as distances.
vec3 regionExits(CellWalk walk, ivec3 region, int edge) {
  const vec3 planes = vec3((region + walk.towards) * edge);
  const vec3 exits = (planes - walk.origin) * walk.inverse;
  return mix(exits, vec3(kInfiniteDistance), equal(walk.direction, vec3(0.0)));
}

// Looks at the cell, or the empty brick or coarse cell around it.
CellStep cellLook(CellWalk walk, CellGrid grid) {
  CellStep look;
  const ivec3 brick = walk.cell >> 3;
  look.block = grid.blocks.at[brick.x + grid.brickCount.x * (brick.y + grid.brickCount.y * brick.z)];
  look.edge = 1;
  ivec3 region = walk.cell;
  if (look.block == kEmptyBrick) {
    const ivec3 coarse = brick >> 2;
    const bool skip = grid.coarseMaxima.at[coarse.x + grid.coarseCount.x * (coarse.y + grid.coarseCount.y * coarse.z)] == 0.0;
    look.edge = skip ? kBrickEdge * kCoarseEdge : kBrickEdge;
    region = skip ? coarse : brick;
  }
  const vec3 exits = regionExits(walk, region, look.edge);
  look.tExit = min(min(exits.x, min(exits.y, exits.z)), walk.tLeave);
  look.axis = exits.x <= exits.y && exits.x <= exits.z ? 0 : (exits.y <= exits.z ? 1 : 2);
  return look;
}

// Steps out of what was looked at. False: the grid has been left.
bool cellStep(inout CellWalk walk, CellGrid grid, CellStep look) {
  if (look.tExit >= walk.tLeave) {
    return false;
  }
  const ivec3 along = ivec3(look.axis == 0, look.axis == 1, look.axis == 2);
  const ivec3 sign = 2 * walk.towards - 1;
  if (look.edge == 1) {
    walk.cell += along * sign;
  } else {
    const int shift = look.edge == kBrickEdge ? 3 : 5;
    const ivec3 region = walk.cell >> shift;
    const ivec3 first = region << shift;
    // The other axes are held inside the region that is left, and inside the grid, which may end in the region.
    const ivec3 last = min(first + look.edge, grid.brickCount * kBrickEdge) - 1;
    const ivec3 inside = clamp(ivec3(floor(walk.origin + look.tExit * walk.direction)), first, last);
    const ivec3 leaving = mix(first - 1, first + look.edge, greaterThan(walk.towards, ivec3(0)));
    walk.cell = mix(inside, leaving, equal(along, ivec3(1)));
  }
  return all(greaterThanEqual(walk.cell, ivec3(0))) && all(lessThan(walk.cell, grid.brickCount * kBrickEdge));
}

// The field between the distances t0 and t1 inside the walk's cell, as a cubic over [0, 1].
vec4 cellCubic(CellWalk walk, CellGrid grid, uint block, float t0, float t1) {
  const ivec3 local = walk.cell & (kBrickEdge - 1);
  const uint first = block * uint(kBlockVoxels) + uint(local.x + kBlockEdge * (local.y + kBlockEdge * local.z));
  const uint y = uint(kBlockEdge);
  const uint z = uint(kBlockEdge * kBlockEdge);
  const vec4 low = vec4(grid.voxels.at[first], grid.voxels.at[first + y], grid.voxels.at[first + z],
                        grid.voxels.at[first + y + z]);
  const vec4 high = vec4(grid.voxels.at[first + 1u], grid.voxels.at[first + y + 1u], grid.voxels.at[first + z + 1u],
                         grid.voxels.at[first + y + z + 1u]);
  const vec3 p = clamp(walk.origin + t0 * walk.direction - vec3(walk.cell), 0.0, 1.0);
  const vec3 q = clamp(walk.origin + t1 * walk.direction - vec3(walk.cell), 0.0, 1.0);
  const vec3 d = q - p;
  // Linear in x, then times linear in y, then times linear in z: polynomials of degree 1, 2, 3.
  const vec4 x0 = low + (high - low) * p.x;
  const vec4 x1 = (high - low) * d.x;
  const vec2 dx0 = x0.yw - x0.xz;
  const vec2 dx1 = x1.yw - x1.xz;
  const vec2 y0 = x0.xz + dx0 * p.y;
  const vec2 y1 = x1.xz + dx1 * p.y + dx0 * d.y;
  const vec2 y2 = dx1 * d.y;
  const vec3 from = vec3(y0.x, y1.x, y2.x);
  const vec3 delta = vec3(y0.y, y1.y, y2.y) - from;
  return vec4(from + delta * p.z, 0.0) + vec4(0.0, delta * d.z);
}

// Optical depth of a grid along a world-space ray, `direction` unit, t in `stretch`. `sigmaT` is the extinction per unit of density.
// Stops where the optical depth exceeds `maxDepth`. `steps` counts cells and skipped regions.
float cellOpticalDepth(CellGrid grid, float sigmaT, vec3 origin, vec3 direction, vec2 stretch, float maxDepth,
                       inout uint steps) {
  CellWalk walk = cellWalkBegin(grid, grid.voxelFromWorld * vec4(origin, 1.0), mat3(grid.voxelFromWorld) * direction,
                                stretch.x, stretch.y);
  float tau = 0.0;
  float t = walk.tEnter;
  bool inside = walk.tEnter < walk.tLeave;
  [[dont_unroll]] while (inside) {
    const CellStep look = cellLook(walk, grid);
    const float tExit = max(look.tExit, t);
    if (look.block != kEmptyBrick) {
      tau += sigmaT * (tExit - t) * cubicIntegral(cellCubic(walk, grid, look.block, t, tExit), 1.0);
    }
    t = tExit;
    ++steps;
    inside = cellStep(walk, grid, look) && tau < maxDepth;
  }
  return tau;
}

#endif

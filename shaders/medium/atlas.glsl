// SPDX-License-Identifier: Apache-2.0
// Voxels of all brick grids, one 3D image per texel format. The includer declares `const uint kFormatMask`:
// a format that the scene does not use has no code.
#ifndef TYNDALL_MEDIUM_ATLAS_GLSL
#define TYNDALL_MEDIUM_ATLAS_GLSL

#extension GL_EXT_samplerless_texture_functions : require

#include "core/rng.glsl"
#include "interop/grid.h"

layout(set = 0, binding = 0) uniform utexture3D atlasUint8;
layout(set = 0, binding = 1) uniform texture3D atlasHalf;
layout(set = 0, binding = 2) uniform texture3D atlasFloat;

float atlasTexel(uint format, ivec3 texel) {
  if ((kFormatMask & (1u << kFormatUint8)) != 0u && format == kFormatUint8) {
    return float(texelFetch(atlasUint8, texel, 0).r);
  }
  if ((kFormatMask & (1u << kFormatHalf)) != 0u && format == kFormatHalf) {
    return texelFetch(atlasHalf, texel, 0).r;
  }
  if ((kFormatMask & (1u << kFormatFloat)) != 0u && format == kFormatFloat) {
    return texelFetch(atlasFloat, texel, 0).r;
  }
  return 0.0;
}

int brickIndex(Grid grid, ivec3 brick) { return brick.x + grid.brickCount.x * (brick.y + grid.brickCount.y * brick.z); }

// The decoded voxel at integer voxel-space coordinates; 0 outside the bricks.
float gridVoxel(Grid grid, ivec3 voxel) {
  const ivec3 brick = voxel >> 3; // arithmetic shift: negative coordinates stay outside
  if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(brick, grid.brickCount))) {
    return 0.0;
  }
  // Field by field: loads by address are what a lookup costs on CPU devices, and floats need only the first one.
  const int index = brickIndex(grid, brick);
  const uint texelBrick = grid.bricks.at[index].texelBrick;
  if (texelBrick == kConstantBrick) {
    return grid.bricks.at[index].offset;
  }
  const ivec3 first = ivec3(texelBrick & 1023u, (texelBrick >> 10) & 1023u, texelBrick >> 20) << 3;
  const float texel = atlasTexel(grid.format, first + (voxel & 7));
  if ((kFormatMask & (1u << kFormatUint8)) != 0u && grid.format == kFormatUint8) {
    return grid.bricks.at[index].offset + grid.bricks.at[index].scale * texel;
  }
  return texel;
}

// Trilinear value at a voxel-space point: 8 taps. For whatever is not linear in the lookup.
float gridTrilinear(Grid grid, vec3 point) {
  const vec3 base = floor(point);
  const vec3 w = point - base;
  const ivec3 voxel = ivec3(base);
  float value = 0.0;
  [[dont_unroll]] for (int corner = 0; corner < 8; ++corner) {
    const ivec3 step = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
    const vec3 weights = mix(1.0 - w, w, vec3(step));
    value += weights.x * weights.y * weights.z * gridVoxel(grid, voxel + step);
  }
  return value;
}

// One of the 8 corner voxels with probability equal to its trilinear weight: unbiased wherever the estimator is
// linear in the lookup. `brick` bounds the support, so that its maximum is a majorant of every result: rounding may
// put the point a hair outside.
float gridOneTap(Grid grid, ivec3 brick, vec3 point, inout Rng rng) {
  const vec3 local = clamp(point - vec3(brick * kBrickEdge), 0.0, float(kBrickEdge));
  const vec3 base = min(floor(local), float(kBrickEdge - 1));
  const vec3 xi = vec3(rngFloat(rng), rngFloat(rng), rngFloat(rng));
  const ivec3 step = ivec3(lessThan(xi, local - base));
  return gridVoxel(grid, brick * kBrickEdge + ivec3(base) + step);
}

#endif

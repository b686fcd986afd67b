// SPDX-License-Identifier: Apache-2.0
// Cells of hash grids in world space: which vertex a place asks for, and where it is kept; (86)-(88) of docs/theory.md.
#ifndef TYNDALL_GUIDE_HASH_GRID_GLSL
#define TYNDALL_GUIDE_HASH_GRID_GLSL

#include "core/numerics.glsl"
#include "core/rng.glsl"
#include "interop/guide.h"

struct CellKey {
  uint window;      // the first of the cells that it may be in
  uint fingerprint; // never 0
};

// Where a cell is asked for.
struct GridPlace {
  vec3 point;
  vec3 camera; // that levels go by
  vec3 facing; // what stands for a normal in keys
};

const uint kStaticLevel = 0xffu;
const uint kNoFace = 7u;

// The face of a cube that a normal points through, turned by 45 degrees on odd levels: no two levels change faces at the
// same place of a curved surface.
uint cubeFace(vec3 normal, uint level) {
  const float c = 0.70710678118655;
  const vec3 turned = vec3(c * (normal.x - normal.y), c * (normal.x + normal.y), normal.z);
  const vec3 n = (level & 1u) == 0u ? normal : vec3(turned.x, c * (turned.y - turned.z), c * (turned.y + turned.z));
  const vec3 size = abs(n);
  if (size.x > size.y && size.x > size.z) {
    return n.x > 0.0 ? 0u : 1u;
  }
  if (size.y > size.z) {
    return n.y > 0.0 ? 2u : 3u;
  }
  return n.z > 0.0 ? 4u : 5u;
}

// A vertex of the lattice of `width`: each coordinate is rounded up with the probability of its fraction, in the mean
// this interpolates between cells.
ivec3 latticeVertexBy(vec3 point, float width, vec3 roundUp) {
  return ivec3(clamp(floor(point / width + roundUp), vec3(-2e9), vec3(2e9)));
}

ivec3 latticeVertex(vec3 point, float width, inout Rng rng) { return latticeVertexBy(point, width, rngFloat3(rng)); }

CellKey cellKey(ivec3 vertex, uint level, uint face, uint first, uint count, uint window) {
  const uvec4 hash = pcg4d(uvec4(uvec3(vertex), level << 3 | face));
  const uvec4 print = pcg4d(hash.wzyx);
  return CellKey(first + (hash.x % (count / window)) * window, max(print.x, 1u));
}

// Between the levels whose cells are just wide enough at a distance from the camera.
float levelOf(GuideLevels levels, float distance) {
  return log(max(levels.angle * distance, levels.finest) / levels.finest) / levels.ratioLog;
}

// The level whose cells have about the same angle everywhere, rounded at random so that no seam is seen, and with
// probability 2^(-spread k) one that is k levels coarser: what is found in one place spreads through these.
uint gridLevel(GuideLevels levels, float distance, inout Rng rng) {
  float level = floor(levelOf(levels, distance) + rngFloat(rng));
  if (levels.spread > 0.0) {
    level += floor(-log2(rngFloat(rng)) / levels.spread);
  }
  return uint(clamp(level, 0.0, 200.0));
}

float levelWidth(GuideLevels levels, uint level) { return levels.finest * exp(float(level) * levels.ratioLog); }

CellKey adaptiveKey(GuidePtr guide, GridPlace place, bool byNormal, inout Rng rng) {
  const uint level = gridLevel(guide.at[0].levels, length(place.point - place.camera), rng);
  const ivec3 vertex = latticeVertex(place.point, levelWidth(guide.at[0].levels, level), rng);
  const uint face = byNormal ? cubeFace(place.facing, level) : kNoFace;
  return cellKey(vertex, level, face, 0u, guide.at[0].cellCount, guide.at[0].window);
}

CellKey staticKey(GuidePtr guide, vec3 point, inout Rng rng) {
  const ivec3 vertex = latticeVertex(point, guide.at[0].staticWidth, rng);
  return cellKey(vertex, kStaticLevel, kNoFace, guide.at[0].cellCount, guide.at[0].staticCount, guide.at[0].window);
}

CellKey radianceKey(GuidePtr guide, vec3 point, vec3 normal, inout Rng rng) {
  const uint level = gridLevel(guide.at[0].radianceLevels, length(point - guide.at[0].camera), rng);
  const ivec3 vertex = latticeVertex(point, levelWidth(guide.at[0].radianceLevels, level), rng);
  return cellKey(vertex, level, cubeFace(normal, level), 0u, guide.at[0].radianceCount, guide.at[0].window);
}

// The cell of a key, or kNoCell.
uint findCell(GuideCellPtr cells, CellKey key, uint window) {
  [[dont_unroll]] for (uint i = 0u; i < window; ++i) {
    if (cells.at[key.window + i].fingerprint == key.fingerprint) {
      return key.window + i;
    }
  }
  return kNoCell;
}

uint findRadiance(RadianceCellPtr cells, CellKey key, uint window) {
  [[dont_unroll]] for (uint i = 0u; i < window; ++i) {
    if (cells.at[key.window + i].fingerprint == key.fingerprint) {
      return key.window + i;
    }
  }
  return kNoCell;
}

#endif

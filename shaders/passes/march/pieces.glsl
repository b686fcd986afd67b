// SPDX-License-Identifier: Apache-2.0
// The ray that is being marched, piece by piece. A piece is a stretch in which every medium is one polynomial: a cell of
// the grids that meet there (cut where several overlap), or a stretch of homogeneous media alone that is short in
// optical depth and seen under a small angle from the point lights.
#ifndef TYNDALL_MARCH_PIECES_GLSL
#define TYNDALL_MARCH_PIECES_GLSL

#include "passes/march/beams.glsl"
#include "tracker/cells.glsl"

// Pieces are cut where their optical depth exceeds this, so that one position serves.
const float kPieceDepth = 1.0;
const float kHomogeneousPieceDepth = 0.5;
// Largest angle [rad] that a piece of homogeneous media takes up as seen from a point light.
const float kPieceAngle = 0.1;
// Largest length of such a piece where grids cast shadows: a share of the scene's radius, or of the distance to it.
const float kPieceLength = 0.125;

struct Piece {
  float t0;
  float t1;
  bool grids;          // some slot is not empty
  bool media;          // anything is there
};

const uint kHomogeneousArray = kHomogeneousMedia > 0u ? kHomogeneousMedia : 1u;

// Of the ray that is being marched.
CellWalk slotWalks[kSlotArray];
CellStep slotLooks[kSlotArray];
bool slotInside[kSlotArray]; // not left yet
vec4 slotCubics[kSlotArray];
vec2 homogeneousStretch[kHomogeneousArray];
vec3 rayOrigin;              // near the grids: distances are counted from there
vec3 rayDirection;

bool slotActive(uint s, float t) { return slotInside[s] && slotWalks[s].tEnter <= t; }
bool slotFilled(uint s, Piece piece) { return slotActive(s, piece.t0) && slotLooks[s].block != kEmptyBrick; }
bool homogeneousActive(uint h, Piece piece) {
  return homogeneousStretch[h].x <= piece.t0 && piece.t1 <= homogeneousStretch[h].y;
}

// Begins all walks. Returns where on the ray media may be, empty if nowhere.
vec2 beginRay(vec3 origin, vec3 direction) {
  float base = kInfiniteDistance;
  [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
    const vec2 interval = boxInterval(slotGrids[s].voxelFromWorld * vec4(origin, 1.0), mat3(slotGrids[s].voxelFromWorld) * direction,
                                      slotGrids[s].boundsMin, slotGrids[s].boundsMax, kInfiniteDistance);
    base = interval.x < interval.y ? min(base, interval.x) : base;
  }
  base = base == kInfiniteDistance ? 0.0 : base;
  rayOrigin = origin + base * direction;
  rayDirection = direction;
  vec2 stretch = vec2(kInfiniteDistance, -kInfiniteDistance);
  [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
    const float shift = kPlantedBug == kBugHalfVoxel ? 0.5 : 0.0;
    slotWalks[s] = cellWalkBegin(slotGrids[s], slotGrids[s].voxelFromWorld * vec4(rayOrigin, 1.0) + shift,
                                 mat3(slotGrids[s].voxelFromWorld) * direction, 0.0, kInfiniteDistance);
    slotInside[s] = slotWalks[s].tEnter < slotWalks[s].tLeave;
    if (slotInside[s]) {
      stretch = vec2(min(stretch.x, slotWalks[s].tEnter), max(stretch.y, slotWalks[s].tLeave));
    }
  }
  [[unroll]] for (uint h = 0u; h < kHomogeneousMedia; ++h) {
    const vec2 interval = mediumInterval(media[h], origin, direction, kInfiniteDistance);
    const bool there = interval.x < interval.y && (media[h].sigmaT > 0.0 || media[h].emissionKind != kEmissionNone);
    const float end = interval.y >= kInfiniteDistance ? kInfiniteDistance : interval.y - base;
    homogeneousStretch[h] = there ? vec2(interval.x - base, end) : vec2(kInfiniteDistance, -kInfiniteDistance);
    stretch = vec2(min(stretch.x, homogeneousStretch[h].x), max(stretch.y, homogeneousStretch[h].y));
  }
  return stretch;
}

// The end of the nearest stretch after t that a boundary cuts.
float nextBoundary(vec2 stretch, float t) {
  return stretch.x > t ? stretch.x : (stretch.y > t ? stretch.y : kInfiniteDistance);
}

// The longest piece of homogeneous media from t on. `extent` is the scene's centre and radius.
float homogeneousPiece(vec4 extent, float t, float sigmaT) {
  float length = sigmaT > 0.0 ? kHomogeneousPieceDepth / sigmaT : kInfiniteDistance;
  if (kSlots > 0u) {
    const vec3 fromCentre = rayOrigin + t * rayDirection - extent.xyz;
    length = min(length, kPieceLength * max(extent.w, sqrt(dot(fromCentre, fromCentre))));
  }
  if (kPointLights) {
    [[unroll]] for (uint b = 0u; b < kBeams; ++b) {
      if (beams[b].point) {
        // From the angle a at t to a + kPieceAngle, by the tangent of their sum.
        const vec3 toLight = beams[b].place - rayOrigin;
        const float delta = dot(toLight, rayDirection);
        const vec3 across = toLight - delta * rayDirection;
        const float a = t - delta;
        const float D2 = dot(across, across);
        const float D = max(sqrt(D2), 1e-5 * abs(a));
        const float denominator = D - a * kPieceAngle;
        if (denominator > 0.0) {
          length = min(length, max(kPieceAngle * (D * D + a * a) / denominator, 1e-6 * abs(a)));
        }
      }
    }
  }
  return length;
}

// The next piece from t on; no media: a gap to be stepped over.
Piece nextPiece(vec4 extent, float t) {
  Piece piece = Piece(t, kInfiniteDistance, false, false);
  [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
    if (slotActive(s, t)) {
      slotLooks[s] = cellLook(slotWalks[s], slotGrids[s]);
      slotLooks[s].tExit = max(slotLooks[s].tExit, t);
      piece.t1 = min(piece.t1, slotLooks[s].tExit);
      piece.grids = piece.grids || slotLooks[s].block != kEmptyBrick;
    } else if (slotInside[s]) {
      piece.t1 = min(piece.t1, slotWalks[s].tEnter);
    }
  }
  float sigmaT = 0.0;
  [[unroll]] for (uint h = 0u; h < kHomogeneousMedia; ++h) {
    piece.t1 = min(piece.t1, nextBoundary(homogeneousStretch[h], t));
    if (homogeneousStretch[h].x <= t && t < homogeneousStretch[h].y) {
      piece.media = true;
      sigmaT += media[h].sigmaT;
    }
  }
  if (kHomogeneousMedia > 0u) {
    if (piece.media && !piece.grids) {
      // Never so short that the distance cannot hold it: the walk would stand still.
      const float length = max(homogeneousPiece(extent, t, sigmaT), 2.5e-7 * abs(t));
      piece.t1 = max(min(piece.t1, t + length), t);
    }
  }
  piece.media = piece.media || piece.grids;
  return piece;
}

// Steps all walks that end where the piece does.
void leavePiece(Piece piece) {
  [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
    if (slotActive(s, piece.t0) && slotLooks[s].tExit <= piece.t1) {
      slotInside[s] = cellStep(slotWalks[s], slotGrids[s], slotLooks[s]);
    }
  }
}

// Extinction of all media over the piece, as a polynomial over [0, 1]. Reads the cells.
vec4 pieceExtinction(Piece piece, inout uint cells) {
  vec4 sum = vec4(0.0);
  [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
    slotCubics[s] = vec4(0.0);
    if (slotFilled(s, piece)) {
      slotCubics[s] = cellCubic(slotWalks[s], slotGrids[s], slotLooks[s].block, piece.t0, piece.t1);
      ++cells;
    }
  }
  [[unroll]] for (uint m = kHomogeneousMedia; m < kMedia; ++m) {
    if (hasDensity(m)) {
      sum += media[m].sigmaT * slotCubics[slotOf(media[m].densityGrid)];
    }
  }
  [[unroll]] for (uint h = 0u; h < kHomogeneousMedia; ++h) {
    sum.x += homogeneousActive(h, piece) ? media[h].sigmaT : 0.0;
  }
  return sum;
}

#endif

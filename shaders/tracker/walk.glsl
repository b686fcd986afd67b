// SPDX-License-Identifier: Apache-2.0
// Null-collision tracking through grid media over the majorant hierarchy: coarse cells (4^3 bricks) whose maximum
// is 0 are skipped whole, bricks of 8^3 voxels carry the majorant. A walk can stop anywhere and go on later.
//
//   kWalkCollide  kWeighted: every tentative collision is weighted by T * sigma_t / majorant, one is kept by
//                 reservoir; transmittance is ratio tracking's. With one grid medium only.
//                 Otherwise delta tracking: the nearest real collision over all media (they may overlap: the
//                 nearest of independent Poisson processes is a collision of their sum).
//   kWalkTransmit ratio tracking: the product of 1 - sigma_t / majorant over all media [Novak14, section 3].
//   kWalkEmit     no collisions: a point of Walk::collect, chosen in proportion to the emission grid's cell maxima.
//
// The includer declares what has code: kWeighted, kGridEmission, kMediumTree, kChromatic. kMediumTree: there are many grid media, a tree of their boxes says
// which ones the segment may meet. kChromatic: where extinction differs by channel, one channel, the hero, decides what
// collides; Walk::ratio says how much more or less likely it is by the others' extinction (docs/theory.md, (64)).
#ifndef TYNDALL_TRACKER_WALK_GLSL
#define TYNDALL_TRACKER_WALK_GLSL

#include "medium/atlas.glsl"
#include "medium/shape.glsl"

const uint kWalkCollide = 0u;
const uint kWalkTransmit = 1u;
const uint kWalkEmit = 2u;

// Russian roulette begins below this transmittance; survivors go on with it.
const float kRouletteTransmittance = 0.1;

struct WalkCounts {
  uint lookups;
  uint exceeded;
  uint stepsLeft;
};

Walk walkBegin(vec3 origin, vec3 direction, float tMax, uint mode, uint firstMedium) {
  Walk walk;
  walk.origin = origin;
  walk.direction = direction;
  walk.tMax = tMax;
  walk.mode = mode;
  walk.medium = firstMedium;
  walk.node = 0u;
  walk.entered = 0u;
  walk.brick = ivec3(0);
  walk.t = 0.0;
  walk.tEnd = 0.0;
  walk.tau = 0.0;
  walk.voxelOrigin = vec3(0.0);
  walk.voxelDirection = vec3(0.0);
  walk.transmittance = 1.0;
  walk.weightSum = 0.0;
  walk.tHit = -1.0;
  walk.hitMedium = firstMedium;
  walk.hero = 0u;
  walk.ratio = vec3(1.0);
  walk.collect = vec2(0.0, tMax);
  walk.measure = 0.0;
  return walk;
}

// Optical depth to a collision: the inverse of 1 - exp(-tau) at xi in [0, 1).
float opticalDepthAt(float xi) { return kPlantedBug == kBugPlainLog ? -log(1.0 - xi) : -log1pAccurate(-xi); }

float opticalDepthDraw(inout Rng rng) { return opticalDepthAt(rngFloat(rng)); }

// Clips the segment to the grid and finds its first brick; false: it misses.
bool walkEnter(inout Walk walk, Grid grid, inout Rng rng) {
  walk.voxelOrigin = grid.voxelFromWorld * vec4(walk.origin, 1.0);
  walk.voxelDirection = mat3(grid.voxelFromWorld) * walk.direction;
  const vec2 interval = boxInterval(walk.voxelOrigin, walk.voxelDirection, grid.boundsMin, grid.boundsMax, walk.tMax);
  if (interval.x >= interval.y) {
    return false;
  }
  walk.t = interval.x;
  walk.tEnd = interval.y;
  const vec3 point = walk.voxelOrigin + walk.t * walk.voxelDirection;
  walk.brick = clamp(ivec3(floor(point / float(kBrickEdge))), ivec3(0), grid.brickCount - 1);
  walk.tau = opticalDepthDraw(rng);
  walk.entered = 1u;
  return true;
}

// Distances at which the ray leaves a cell of `edge` voxels per axis; kInfiniteDistance along axes it does not move on.
vec3 cellExits(Walk walk, ivec3 cell, int edge) {
  const vec3 planes = vec3((cell + ivec3(greaterThan(walk.voxelDirection, vec3(0.0)))) * edge);
  const vec3 exits = (planes - walk.voxelOrigin) / walk.voxelDirection;
  return mix(exits, vec3(kInfiniteDistance), equal(walk.voxelDirection, vec3(0.0)));
}

ivec3 exitStep(vec3 exits, vec3 direction) {
  if (exits.x <= exits.y && exits.x <= exits.z) {
    return ivec3(direction.x > 0.0 ? 1 : -1, 0, 0);
  }
  return exits.y <= exits.z ? ivec3(0, direction.y > 0.0 ? 1 : -1, 0) : ivec3(0, 0, direction.z > 0.0 ? 1 : -1);
}

// Steps over an empty coarse cell. The axis of exit moves by integers, so the walk cannot stall on a plane; the
// others are held inside the cell that was left.
void skipCoarse(inout Walk walk, Grid grid, ivec3 coarse) {
  const vec3 exits = cellExits(walk, coarse, kBrickEdge * kCoarseEdge);
  const ivec3 step = exitStep(exits, walk.voxelDirection);
  walk.t = max(walk.t, min(exits.x, min(exits.y, exits.z)));
  const vec3 point = walk.voxelOrigin + walk.t * walk.voxelDirection;
  const ivec3 first = coarse * kCoarseEdge;
  const ivec3 inside = clamp(ivec3(floor(point / float(kBrickEdge))), first, first + kCoarseEdge - 1);
  const ivec3 leaving = mix(first - 1, first + kCoarseEdge, greaterThan(step, ivec3(0)));
  walk.brick = mix(inside, leaving, notEqual(step, ivec3(0)));
}

// A component that is known by number alone.
float heroOf(vec3 colour, uint hero) { return hero == 0u ? colour.x : hero == 1u ? colour.y : colour.z; }

// One tentative collision in the current brick, at optical depth tau past its entry. Returns true if the walk through
// this medium ends here.
// `colour`: factors of the extinction per channel.
bool walkCollide(inout Walk walk, Grid grid, float sigmaScale, vec3 colour, float majorant, inout Rng rng,
                 inout WalkCounts counts) {
  const float t = walk.t + walk.tau / majorant;
  vec3 point = walk.voxelOrigin + t * walk.voxelDirection;
  if (kPlantedBug == kBugHalfVoxel) {
    point += 0.5;
  }
  const float sigmaT = sigmaScale * gridOneTap(grid, walk.brick, point, rng);
  ++counts.lookups;
  counts.exceeded += uint(sigmaT > majorant * 1.00001);
  const float share = sigmaT / majorant;
  // t stays at the brick's entry: in dense bricks a free flight can be smaller than the spacing of floats at t.
  walk.tau += opticalDepthDraw(rng);
  if (walk.mode == kWalkCollide) {
    const float xi = rngFloat(rng);
    if (!kWeighted) {
      const float heroShare = kChromatic ? share * heroOf(colour, walk.hero) : share;
      if (kChromatic) {
        walk.ratio *= xi < heroShare ? colour * (share / heroShare) : max(1.0 - colour * share, 0.0) / (1.0 - heroShare);
      }
      if (xi < heroShare) {
        walk.tHit = t;
        walk.hitMedium = walk.medium;
        walk.tMax = t;
        return true;
      }
      return false;
    }
    const float weight = walk.transmittance * share;
    walk.weightSum += weight;
    if (xi * walk.weightSum < weight) {
      walk.tHit = t;
      walk.hitMedium = walk.medium;
    }
  }
  if (kChromatic) {
    if (walk.mode == kWalkTransmit) {
      walk.ratio *= max(1.0 - colour * share, 0.0);
      walk.transmittance = max(walk.ratio.x, max(walk.ratio.y, walk.ratio.z));
    }
  } else {
    walk.transmittance *= max(1.0 - share, 0.0);
  }
  if (walk.transmittance < kRouletteTransmittance) {
    const bool survives = rngFloat(rng) * kRouletteTransmittance < walk.transmittance;
    const float kept = survives ? kRouletteTransmittance : 0.0;
    walk.ratio *= survives ? kept / walk.transmittance : 0.0;
    walk.transmittance = kept;
  }
  return walk.transmittance == 0.0;
}

// Keeps one point of Walk::collect with density `maximum` / weightSum, and measures the whole line.
void walkEmit(inout Walk walk, float maximum, float tExit, inout Rng rng) {
  const float end = max(tExit, walk.t);
  const float squares = (walk.t * walk.t + walk.t * end + end * end) * (1.0 / 3.0);
  walk.measure += maximum * (end - walk.t) * (kPlantedBug == kBugVolumePdf ? 1.0 : squares);
  const float first = max(walk.t, walk.collect.x);
  const float length = max(min(end, walk.collect.y) - first, 0.0);
  const float weight = maximum * length;
  walk.weightSum += weight;
  if (rngFloat(rng) * walk.weightSum < weight) {
    walk.tHit = first + rngFloat(rng) * length;
    walk.hitMedium = walk.medium;
    walk.tau = maximum; // kept for the weight: this mode draws no optical depth
  }
}

// The medium whose grid is walked has been left: on to the next one.
void walkLeave(inout Walk walk) {
  walk.entered = 0u;
  ++walk.medium;
}

// One cell, one tentative collision or one step over an empty coarse cell.
void walkStep(inout Walk walk, Grid grid, float sigmaScale, vec3 colour, inout Rng rng, inout WalkCounts counts) {
  const bool emit = kGridEmission && walk.mode == kWalkEmit;
  const float maximum = grid.maxima.at[brickIndex(grid, walk.brick)];
  const vec3 exits = cellExits(walk, walk.brick, kBrickEdge);
  const float tExit = min(min(exits.x, min(exits.y, exits.z)), walk.tEnd);
  ivec3 nextBrick = walk.brick + exitStep(exits, walk.voxelDirection);
  if (maximum > 0.0) {
    const float majorant = maximum * sigmaScale;
    const float cellDepth = majorant * max(tExit - walk.t, 0.0);
    if (emit) {
      walkEmit(walk, maximum, tExit, rng);
    } else if (walk.tau < cellDepth) {
      if (walkCollide(walk, grid, sigmaScale, colour, majorant, rng, counts)) {
        walkLeave(walk);
      }
      return;
    } else {
      walk.tau -= cellDepth;
    }
    walk.t = max(walk.t, tExit);
    walk.brick = nextBrick;
  } else {
    const ivec3 coarse = walk.brick / kCoarseEdge;
    if (grid.coarseMaxima.at[coarse.x + grid.coarseCount.x * (coarse.y + grid.coarseCount.y * coarse.z)] > 0.0) {
      walk.t = max(walk.t, tExit);
      walk.brick = nextBrick;
    } else {
      skipCoarse(walk, grid, coarse);
    }
  }
  if (walk.t >= walk.tEnd || any(lessThan(walk.brick, ivec3(0))) ||
      any(greaterThanEqual(walk.brick, grid.brickCount))) {
    walkLeave(walk);
  }
}

// Walks the current medium's grid until it is left or the steps are used up.
void walkMedium(inout Walk walk, Grid grid, float sigmaScale, vec3 colour, inout Rng rng, inout WalkCounts counts) {
  if (walk.entered == 0u && !walkEnter(walk, grid, rng)) {
    walkLeave(walk);
    return;
  }
  [[dont_unroll]] while (walk.entered != 0u && counts.stepsLeft > 0u) {
    --counts.stepsLeft;
    walkStep(walk, grid, sigmaScale, colour, rng, counts);
  }
}

// Walks the medium at hand, or a part of it.
void walkHere(inout Walk walk, ScenePtr scene, inout Rng rng, inout WalkCounts counts) {
  const uint gridIndex = walk.mode == kWalkEmit ? scene.at[0].media.at[walk.medium].emissionGrid
                                                : scene.at[0].media.at[walk.medium].densityGrid;
  if (gridIndex == kNoGrid) {
    walkLeave(walk);
    return;
  }
  Grid grid = scene.at[0].grids.at[gridIndex];
  const vec3 colour = kChromatic ? scene.at[0].media.at[walk.medium].colour : vec3(1.0);
  walkMedium(walk, grid, scene.at[0].media.at[walk.medium].sigmaT, colour, rng, counts);
}

// Finds the next medium whose box the segment meets; false: there is none.
bool walkFindMedium(inout Walk walk, ScenePtr scene, inout WalkCounts counts) {
  MediumNodePtr nodes = scene.at[0].mediumNodes;
  const uint count = scene.at[0].mediumNodeCount;
  [[dont_unroll]] while (walk.node < count && counts.stepsLeft > 0u) {
    --counts.stepsLeft;
    const vec2 interval = boxInterval(walk.origin, walk.direction, nodes.at[walk.node].boundsMin,
                                      nodes.at[walk.node].boundsMax, walk.tMax);
    const uint medium = nodes.at[walk.node].medium;
    const bool met = interval.x <= interval.y;
    walk.node = met ? walk.node + 1u : nodes.at[walk.node].skip;
    if (met && medium != kNoMedium) {
      walk.medium = medium;
      return true;
    }
  }
  return false;
}

// Goes on with a walk until it is done (true) or the steps are used up (false).
bool walkAdvance(inout Walk walk, ScenePtr scene, inout Rng rng, inout WalkCounts counts) {
  const bool byTree = kMediumTree && walk.mode != kWalkEmit;
  const uint end = walk.mode == kWalkEmit ? walk.hitMedium + 1u : scene.at[0].mediumCount;
  [[dont_unroll]] while (walk.medium < end && walk.transmittance > 0.0) {
    if (counts.stepsLeft == 0u) {
      return false;
    }
    --counts.stepsLeft;
    if (byTree && walk.entered == 0u && !walkFindMedium(walk, scene, counts)) {
      if (walk.node < scene.at[0].mediumNodeCount) {
        return false; // out of steps
      }
      walk.medium = end;
      return true;
    }
    walkHere(walk, scene, rng, counts);
    if (byTree && walk.entered == 0u) {
      walk.medium = 0u; // the tree knows the next one
    }
  }
  return true;
}

#endif

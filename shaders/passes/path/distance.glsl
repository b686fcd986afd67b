// SPDX-License-Identifier: Apache-2.0
// The first event in media on a camera ray: free flight, or a distance of the chains, joined by the balance heuristic;
// (102) to (104) of docs/theory.md. Extinction is the same in all channels.
#ifndef TYNDALL_PATH_DISTANCE_GLSL
#define TYNDALL_PATH_DISTANCE_GLSL

#include "passes/path/aim_density.glsl"

uint distanceRays = 0u; // that found chains
uint distanceGuided = 0u;

// From the first to the last point of the path's ray that may lie in a medium; empty: x >= y.
vec2 mediaStretch(ScenePtr scene) {
  vec2 hull = kHomogeneous ? homogeneousStretch(scene) : vec2(kInfiniteDistance, 0.0);
  [[dont_unroll]] for (uint i = scene.at[0].homogeneousCount; kGrids && i < scene.at[0].mediumCount; ++i) {
    const uint index = scene.at[0].media.at[i].densityGrid;
    if (index != kNoGrid) {
      Grid grid = scene.at[0].grids.at[index];
      const vec2 own = boxInterval(grid.voxelFromWorld * vec4(path.ray.origin, 1.0),
                                   mat3(grid.voxelFromWorld) * path.ray.direction, grid.boundsMin, grid.boundsMax, path.hit.t);
      if (own.x < own.y) {
        hull = vec2(min(hull.x, own.x), max(hull.y, own.y));
      }
    }
  }
  return hull;
}

// The media at a point, by their majorants there: those of homogeneous ones are their extinction.
struct MediaAt {
  float majorant;       // of all [1/unit]
  uint chosen;          // one of them, in proportion; kNoMedium: there are none
  float chosenMajorant;
};

void takeMedium(inout MediaAt media, uint index, float majorant, inout Rng rng) {
  media.majorant += majorant;
  if (majorant > 0.0 && rngFloat(rng) * media.majorant <= majorant) {
    media.chosen = index;
    media.chosenMajorant = majorant;
  }
}

// A point in a grid.
struct VoxelPlace {
  vec3 voxel;
  ivec3 brick;
  bool inside;
};

VoxelPlace voxelPlace(Grid grid, vec3 point) {
  VoxelPlace place;
  place.voxel = grid.voxelFromWorld * vec4(point, 1.0);
  place.brick = clamp(ivec3(floor(place.voxel / float(kBrickEdge))), ivec3(0), grid.brickCount - 1);
  place.inside = all(greaterThanEqual(place.voxel, grid.boundsMin)) && all(lessThanEqual(place.voxel, grid.boundsMax));
  return place;
}

MediaAt mediaAt(ScenePtr scene, float t, inout Rng rng) {
  MediaAt media = MediaAt(0.0, kNoMedium, 0.0);
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].mediumCount; ++i) {
    const float sigmaT = scene.at[0].media.at[i].sigmaT;
    const uint index = scene.at[0].media.at[i].densityGrid;
    if (kHomogeneous && i < scene.at[0].homogeneousCount) {
      const vec3 stretch = mediumStretch(scene, i, path.ray, path.hit.t);
      takeMedium(media, i, stretch.x <= t && t <= stretch.y ? sigmaT * stretch.z : 0.0, rng);
    } else if (kGrids && index != kNoGrid) {
      Grid grid = scene.at[0].grids.at[index];
      const VoxelPlace place = voxelPlace(grid, path.ray.origin + t * path.ray.direction);
      takeMedium(media, i, place.inside ? sigmaT * grid.maxima.at[brickIndex(grid, place.brick)] : 0.0, rng);
    }
  }
  return media;
}

// Extinction of the chosen medium over its majorant, right on average.
float densityShare(ScenePtr scene, MediaAt media, float t, inout Rng rng) {
  if (!kGrids || media.chosen < scene.at[0].homogeneousCount) {
    return 1.0;
  }
  Grid grid = scene.at[0].grids.at[scene.at[0].media.at[media.chosen].densityGrid];
  const VoxelPlace place = voxelPlace(grid, path.ray.origin + t * path.ray.direction);
  return scene.at[0].media.at[media.chosen].sigmaT * gridOneTap(grid, place.brick, place.voxel, rng) / media.chosenMajorant;
}

// The path's ray has been cast: settles how the distance to its first event is drawn, and draws it if it is a guided one.
void beginDistance(ScenePtr scene, GuidePtr guide, inout Rng rng) {
  path.distanceShare = -1.0;
  path.guidedT = -1.0;
  const vec2 stretch = path.events == 0u && scene.at[0].maxEvents > 0u ? mediaStretch(scene) : vec2(1.0, 0.0);
  if (stretch.x >= stretch.y) {
    return;
  }
  path.distanceLearns = 1u;
  const bool holds = loadDistances(guide, path.slot, pixelInFlight(), stretch, path.vertex.travelled, rng);
  path.distanceShare = holds ? distanceShare(guide, guide.at[0].distance.records.at[path.slot].vertex) : 0.0;
  guide.at[0].distance.records.at[path.slot].share = path.distanceShare;
  if (!(path.distanceShare > 0.0)) {
    return;
  }
  ++distanceRays;
  // The number for the flight chooses, and what is left of it is as good as new, to its last digit near 0.
  const uint word = path.flightFresh != 0u ? path.flightWord : rngUint(rng);
  const uint most = uint(path.distanceShare * 4294967296.0);
  if (word < most) {
    ++distanceGuided;
    path.guidedT = distanceSample(guide, path.slot, path.vertex.travelled, (float(word) + 0.5) / float(most));
  } else {
    path.flightWord = uint(min(float(word - most) / (1.0 - path.distanceShare), 4294967040.0));
    path.flightFresh = 1u;
  }
}

// What the event, or the end of the ray where `medium` is none, counts for.
float distanceWeight(ScenePtr scene, GuidePtr guide, float t, inout uint medium, inout Rng rng) {
  const float share = path.distanceShare;
  const bool guided = path.guidedT >= 0.0;
  if (!guided && medium == kNoMedium) {
    return 1.0 / (1.0 - share);
  }
  const MediaAt media = mediaAt(scene, t, rng);
  const float flight = media.majorant * flightTransmittance(scene, path.ray, t).x;
  const float chains = share * distanceDensity(guide, path.slot, t);
  const float density = (1.0 - share) * flight + chains;
  guide.at[0].distance.records.at[path.slot].guidedPart = density > 0.0 ? chains / density : 0.0;
  if (!guided) { // at borders of bricks rounding may miss both
    return flight > 0.0 && kPlantedBug != kBugDistanceWeight ? flight / density : 1.0 / (1.0 - share);
  }
  medium = media.chosen;
  if (medium == kNoMedium || !(flight > 0.0)) {
    return 0.0;
  }
  return flight / density * densityShare(scene, media, t, rng) * (kGrids ? path.walk.transmittance : 1.0);
}

// The ray is over at t, in `medium` if that is one. False: what it has found counts for nothing.
bool endDistance(ScenePtr scene, GuidePtr guide, float t, inout uint medium, inout Rng rng) {
  if (path.distanceShare < 0.0) {
    return true;
  }
  DistanceRecordPtr records = guide.at[0].distance.records;
  records.at[path.slot].guidedPart = 0.0;
  if (path.distanceShare > 0.0) {
    const float weight = distanceWeight(scene, guide, t, medium, rng);
    path.throughput *= weight;
    path.unguided = min(path.unguided / max(weight, 1e-30), 1e30); // as of directions: a likely draw must not end the path
  }
  records.at[path.slot].t = medium != kNoMedium ? path.vertex.travelled + t : -1.0;
  records.at[path.slot].before = scoreOf(path.radiance + path.background);
  return path.throughput != vec3(0.0);
}

#endif

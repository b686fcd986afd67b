// SPDX-License-Identifier: Apache-2.0
// The rays of a path: its own and those to lights, how they begin and what they wait for.
#ifndef TYNDALL_PATH_RAYS_GLSL
#define TYNDALL_PATH_RAYS_GLSL

#include "passes/path/aim.glsl"
#include "passes/path/distance.glsl"
#include "passes/path/records.glsl"
#include "passes/path/strata.glsl"
#include "passes/path/surface.glsl"

const uint kStageSample = 0u;
const uint kStageGather = 1u;
const uint kStagePoint = 2u;
const uint kStageGlow = 3u;
const uint kStageArrive = 4u;
const uint kStageShadow = 5u;
const uint kStageAimed = 6u;
const uint kStageDone = 7u;

// A walk that is over at once: nothing lies between this stage and the next one.
const uint kNoWalk = 0xfffffffeu;
void noWalk() { path.walk.medium = kNoWalk; }

// Russian roulette: from this many events on, and with this survival at most from the second number on. Paths that
// nothing absorbs would not end.
const uint kRouletteEvents = 4u;
const uint kEndingEvents = 2048u;
const float kEndingSurvival = 0.996;

bool isShadow() { return path.target != kTargetPath; }

void walkRay(ScenePtr scene, float tMax, uint mode) {
  if (kGrids) {
    path.walk = walkBegin(path.ray.origin, path.ray.direction, tMax, mode, scene.at[0].homogeneousCount);
    path.walk.hero = path.hero;
  }
}

vec3 walkedTransmittance() {
  return !kGrids ? vec3(1.0) : kChromatic ? path.walk.ratio : vec3(path.walk.transmittance);
}

void castRay() {
  path.casting = 1u;
  path.hit.t = path.ray.tMax;
  path.hit.primitive = kNoHit;
  path.stage = kStageArrive; // settled once the ray has been cast
  noWalk();
}

// The path's own ray leaves.
void castPath(PathRay ray, float travelled) {
  path.ray = ray;
  path.vertex.travelled = travelled;
  path.target = kTargetPath;
  castRay();
}

void stageSample(ScenePtr scene, uvec2 pixel, uint seed, uint sampleIndex, inout Rng rng) {
  rng = rngSeed(pixel, sampleIndex, seed);
  path.events = 0u;
  if (path.sampleIndex == 0u || sampleIndex % kSobolPoints == 0u || learnsAtOnce()) {
    path.strataSeed = strataSeed(pixel, sampleIndex, seed);
  }
  const uvec3 place = strata(0u);
  path.flightWord = place.z;
  path.flightFresh = 1u;
  const vec2 within = kGuideView ? vec2(0.5) : vec2(unitFloat(place.x), unitFloat(place.y));
  const vec2 raster = (vec2(pixel) + within) / vec2(scene.at[0].imageSize);
  Camera camera = scene.at[0].camera;
  const vec3 offset = raster.x * camera.rasterX + raster.y * camera.rasterY;
  PathRay ray;
  ray.origin = kOrthographic ? camera.origin + offset : camera.origin;
  ray.direction = kOrthographic ? camera.corner : camera.corner + offset;
  const uvec3 second = kLens || kChromatic ? strata(1u) : uvec3(0u);
  if (kLens && !kGuideView) {
    const vec2 lens = uniformDiscSample(vec2(unitFloat(second.x), unitFloat(second.y)));
    const vec3 shift = lens.x * camera.lensX + lens.y * camera.lensY;
    ray.origin += shift;
    ray.direction = ray.direction * camera.focusDistance - shift;
  }
  ray.direction = normalize(ray.direction);
  ray.tMax = kInfiniteDistance;
  ray.interiors = camera.interiors;
  path.vertex = PathVertex(ray.origin, vec3(0.0), 0.0, 0.0, 0u);
  path.throughput = vec3(1.0);
  path.unguided = 1.0;
  path.ratio = vec3(1.0);
  path.pending = vec3(0.0);
  path.nextCast = 0u;
  path.recordCount = 0u;
  path.recordStage = kRecordClosed;
  path.distanceLearns = 0u;
  path.hero = kChromatic ? min(uint(unitFloat(second.z) * 3.0), 2u) : 0u;
  path.radiance = vec3(0.0);
  path.background = vec3(0.0);
  path.transmittance = 0.0;
  path.depth = 0.0;
  path.opacity = 0.0;
  path.albedo = vec3(0.0);
  castPath(ray, 0.0);
}

// Free flight of the path's own ray.
void beginFlight(ScenePtr scene, inout Rng rng) {
  path.collisionT = path.hit.t;
  path.collisionMedium = kNoMedium;
  path.stage = kStageArrive;
  if (kDistances && path.guidedT >= 0.0) {
    path.collisionT = path.guidedT;
    walkRay(scene, path.guidedT, kWalkTransmit);
    return;
  }
  if (kHomogeneous) {
    rngQueue(rng, uvec3(path.flightWord), path.flightFresh);
    path.flightFresh = 0u; // a ray that goes on behind a boundary has told that it is not stopped before
    path.collisionT = flightCollision(scene, path.ray, path.hit.t, path.hero, rng, path.collisionMedium);
    rng.queued = 0u;
  }
  walkRay(scene, path.collisionT, kWalkCollide);
}

// What the path's own ray does once it has been cast.
void followRay(ScenePtr scene, inout Rng rng) {
  path.stage = kStageGather;
  if (!kMediaEmission) {
    beginFlight(scene, rng);
  }
}

// The shadow ray that a light request asks for.
PathRay shadowRay(ScatterPoint vertex, LightRequest request) {
  if (request.target.error < 0.0) {
    return leave(vertex, request.direction, kInfiniteDistance);
  }
  PathRay ray = leave(vertex, request.target.position - vertex.place.position, 0.0);
  ray.tMax = shadowDistance(ray.origin, request.target, ray.direction);
  return ray;
}

// Sends the shadow ray that a light request asks for, and returns true; the path's own ray waits in `next`.
bool askForLight(ScatterPoint vertex, LightRequest request) {
  path.pending = path.throughput * request.value;
  if (path.pending == vec3(0.0)) {
    return false;
  }
  path.ray = shadowRay(vertex, request);
  path.target = request.medium == kNoMedium ? kTargetLight : request.medium;
  path.targetPdf = request.pdf;
  path.shadowPdf = request.directionPdf;
  path.travelled = 0.0;
  castRay();
  return true;
}

// The path's own ray waits, cast already, while a shadow ray is in flight.
void sendAimed(PathRay shadow) {
  path.next = path.ray;
  path.nextHit = path.hit;
  path.nextCast = 1u;
  path.ray = shadow;
  path.target = kTargetLight;
  path.travelled = 0.0;
  castRay();
}

// One event in homogeneous media towards a small light; true if a ray is on its way for it.
bool aimRay(ScenePtr scene, inout Rng rng) {
  path.aim = -1.0;
  if (path.events >= scene.at[0].maxEvents) {
    return false;
  }
  const Aimed aimed = aimAtEmitter(scene, rng);
  path.pending = path.throughput * aimed.value;
  if (path.pending == vec3(0.0)) {
    return false;
  }
  path.next = shadowRay(aimed.vertex, aimed.request);
  walkRay(scene, aimed.vertex.flightT, kWalkTransmit);
  path.stage = kStageAimed;
  return true;
}

// The grids' transmittance up to the aimed event is there. A stage of its own without grids too: the ray that is sent
// here must be cast before another stage runs.
void stageAimed(ScenePtr scene, inout Rng rng) {
  path.pending *= walkedTransmittance();
  noWalk();
  if (path.pending == vec3(0.0)) {
    followRay(scene, rng);
  } else {
    sendAimed(path.next);
  }
}

// The ray has been cast: what follows depends on what it is for.
void stageCast(ScenePtr scene, bool blocked, inout Rng rng) {
  path.emissive = 0u;
  noWalk();
  if (path.target == kTargetLight) {
    path.stage = kStageShadow;
    path.pending *= blocked ? vec3(0.0) : flightTransmittance(scene, path.ray, path.hit.t);
    if (path.pending != vec3(0.0)) {
      walkRay(scene, path.hit.t, kWalkTransmit);
    }
    return;
  }
  if (kDistances && !isShadow()) {
    beginDistance(scene, io.guide, rng);
  }
  if (!kAimed || isShadow() || !aimRay(scene, rng)) {
    followRay(scene, rng);
  }
}

#endif

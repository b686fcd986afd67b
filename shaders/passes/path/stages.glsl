// SPDX-License-Identifier: Apache-2.0
// Paths as a chain of stages. Between two stages lies one ray: cast against the surfaces, then walked through the grid
// media. There is one cast and one walk in the kernel; equation (60) of docs/theory.md is what their sum estimates.
//
//   Sample    a camera ray leaves
//   Aimed     grids are walked up to an event that was aimed at a small light (aim.glsl); a shadow ray follows
//   Gather    emission along the path's ray, one medium after the other: Gather chooses a point, Glow takes what
//   Point     transmittance leaves of it
//   Glow
//   Arrive    the path's ray has met a medium, a surface or nothing; a vertex asks for a light sample
//   Shadow    transmittance to the light sample is there; the path goes on
#ifndef TYNDALL_PATH_STAGES_GLSL
#define TYNDALL_PATH_STAGES_GLSL

#include "passes/path/aim.glsl"
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
  const vec2 raster = (vec2(pixel) + rngFloat2(rng)) / vec2(scene.at[0].imageSize);
  Camera camera = scene.at[0].camera;
  const vec3 offset = raster.x * camera.rasterX + raster.y * camera.rasterY;
  PathRay ray;
  ray.origin = kOrthographic ? camera.origin + offset : camera.origin;
  ray.direction = kOrthographic ? camera.corner : camera.corner + offset;
  if (kLens) {
    const vec2 lens = uniformDiscSample(rngFloat2(rng));
    const vec3 shift = lens.x * camera.lensX + lens.y * camera.lensY;
    ray.origin += shift;
    ray.direction = ray.direction * camera.focusDistance - shift;
  }
  ray.direction = normalize(ray.direction);
  ray.tMax = kInfiniteDistance;
  ray.interiors = camera.interiors;
  path.vertex = PathVertex(ray.origin, vec3(0.0), 0.0, 0.0, 0u);
  path.throughput = vec3(1.0);
  path.ratio = vec3(1.0);
  path.pending = vec3(0.0);
  path.nextCast = 0u;
  path.hero = kChromatic ? min(uint(rngFloat(rng) * 3.0), 2u) : 0u;
  path.events = 0u;
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
  if (kHomogeneous) {
    path.collisionT = flightCollision(scene, path.ray, path.hit.t, path.hero, rng, path.collisionMedium);
  }
  walkRay(scene, path.collisionT, kWalkCollide);
  path.stage = kStageArrive;
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
  if (!kAimed || isShadow() || !aimRay(scene, rng)) {
    followRay(scene, rng);
  }
}

// The line that the ray in flight belongs to begins at the vertex, before null boundaries.
float lineBegin() { return isShadow() ? path.travelled : path.vertex.travelled; }

PathRay lineOf() {
  PathRay line = path.ray;
  line.origin -= lineBegin() * line.direction;
  return line;
}

// Chooses a point of the next emissive medium along the ray.
void stageGather(ScenePtr scene, inout Rng rng) {
  noWalk();
  uint medium = path.target;
  if (!isShadow() && !glowingMedium(scene, path.emissive, medium)) {
    beginFlight(scene, rng);
    return;
  }
  path.glowT = -1.0;
  path.stage = kStagePoint;
  if (medium == kNoMedium) {
    return;
  }
  const float first = lineBegin();
  const PathRay line = lineOf();
  if (kGridEmission && medium >= scene.at[0].homogeneousCount) {
    path.walk = walkBegin(line.origin, line.direction, kInfiniteDistance, kWalkEmit, medium);
    path.walk.collect = vec2(first, first + path.hit.t);
    return;
  }
  const GlowPoint glow = homogeneousGlow(scene, medium, line, first, first + path.hit.t, path.hero, rng);
  path.glowT = glow.t;
  path.glowInversePdf = glow.inversePdf;
  path.glowMeasure = glow.measure;
}

// What the point's radiance counts for: both techniques that find its line, joined.
vec3 glowFactor(ScenePtr scene, uint medium) {
  const uint emitter = kVolumeEmitters ? scene.at[0].media.at[medium].emitter : kNoEmitter;
  const float density =
      emitter == kNoEmitter ? 0.0 : path.glowMeasure / scene.at[0].media.at[medium].emissionMeasure;
  if (isShadow()) {
    const float light = path.targetPdf * density;
    return light > 0.0 ? path.pending * lightFactor(light, path.shadowPdf) : vec3(0.0);
  }
  const float light = density > 0.0 ? density * emitterProbability(scene, emitter, path.vertex) : 0.0;
  return path.throughput * directionWeight(path.vertex.pdf, light);
}

void stagePoint(ScenePtr scene, inout Rng rng) {
  uint medium = path.target;
  if (!isShadow()) {
    glowingMedium(scene, path.emissive, medium);
  }
  path.stage = kStageGlow;
  path.glow = vec3(0.0);
  if (kGridEmission && medium != kNoMedium && medium >= scene.at[0].homogeneousCount) {
    path.glowT = path.walk.tHit;
    path.glowInversePdf = path.walk.weightSum / path.walk.tau; // tau holds the chosen brick's maximum
    path.glowMeasure = path.walk.measure;
  }
  noWalk();
  if (path.glowT < 0.0) {
    return;
  }
  const PathRay line = lineOf();
  const float t = max(path.glowT - lineBegin(), 0.0);
  const vec3 j = mediumEmission(scene, medium, line.origin + path.glowT * line.direction, rng);
  if (j == vec3(0.0)) {
    return;
  }
  path.glow = j * glowFactor(scene, medium) * flightTransmittance(scene, path.ray, t) * path.glowInversePdf;
  if (path.glow != vec3(0.0)) {
    walkRay(scene, t, kWalkTransmit);
  }
}

void stageGlow(ScenePtr scene) {
  path.radiance += path.glow == vec3(0.0) ? vec3(0.0) : path.glow * walkedTransmittance();
  noWalk();
  ++path.emissive;
  path.stage = kStageGather;
  if (isShadow()) {
    path.stage = kStageShadow;
    const bool goesOn = kPassing && path.hit.primitive != kNoHit;
    path.pending *= goesOn ? flightTransmittance(scene, path.ray, path.hit.t) : vec3(0.0);
    if (path.pending != vec3(0.0)) {
      walkRay(scene, path.hit.t, kWalkTransmit);
    }
  }
}

// The path's own ray again, or the end.
void goOn(ScenePtr scene, inout Rng rng) {
  noWalk();
  if (kAimed && path.nextCast != 0u) {
    path.nextCast = 0u;
    path.ray = path.next;
    path.hit = path.nextHit;
    path.target = kTargetPath;
    followRay(scene, rng);
    return;
  }
  path.stage = kStageDone;
  if (path.throughput != vec3(0.0)) {
    castPath(path.next, 0.0);
  }
}

// A shadow ray has come to an end: at its light, at something opaque, or at a surface that lets it pass.
void stageShadow(ScenePtr scene, SurfacePass through, inout Rng rng) {
  if (path.pending != vec3(0.0)) {
    path.pending *= walkedTransmittance();
  }
  if (kPassing && path.hit.primitive != kNoHit) {
    if (through.passes && path.pending != vec3(0.0)) {
      path.travelled += path.hit.t;
      path.ray = through.beyond;
      castRay();
      return;
    }
    path.pending = vec3(0.0);
  }
  path.radiance += path.target == kTargetLight ? path.pending : vec3(0.0);
  goOn(scene, rng);
}

// Radiance from infinity along the path's ray.
void escape(ScenePtr scene) {
  if (path.events == 0u) {
    path.transmittance = 1.0;
    path.background = kBackground ? path.throughput * distantBackground(scene, path.ray.direction) : vec3(0.0);
  } else if (kDistantAreas) {
    const vec4 mixture = distantMixture(scene, path.ray.direction);
    path.radiance += path.throughput * mixture.xyz * directionWeight(path.vertex.pdf, mixture.w);
  }
  path.stage = kStageDone;
}

// Draws the direction in which the path goes on. Leaves a throughput of 0 where it ends.
void drawDirection(ScenePtr scene, ScatterPoint vertex, inout Rng rng) {
  ScatterSample drawn;
  drawn.weight = vec3(0.0);
  if (path.events < scene.at[0].maxEvents || kFindable) {
    drawn = scatterSample(vertex, rng);
  }
  path.throughput *= drawn.weight;
  if (path.events >= kRouletteEvents) {
    const float strongest = max(path.throughput.x, max(path.throughput.y, path.throughput.z));
    const float survival = min(strongest, path.events >= kEndingEvents ? kEndingSurvival : 1.0);
    path.throughput = rngFloat(rng) < survival ? path.throughput / (kPlantedBug == kBugRoulette ? 1.0 : survival) : vec3(0.0);
  }
  if (path.throughput != vec3(0.0)) {
    path.next = leave(vertex, drawn.direction, kInfiniteDistance);
    path.vertex = PathVertex(vertex.place.position, receiverOf(vertex).normal, drawn.pdf, 0.0, uint(kAimed && vertex.flightT >= 0.0));
  }
}

// One scattering event: a light sample first, then the path's own direction.
void scatter(ScenePtr scene, ScatterPoint vertex, inout Rng rng) {
  ++path.events;
  bool asked = false;
  const vec3 throughput = path.throughput;
  LightRequest request;
  request.value = vec3(0.0);
  if ((kEmitters || kDistantDeltas || kDistantAreas) && !scatterIsDelta(vertex)) {
    request = lightRequest(scene, vertex, rng);
  }
  drawDirection(scene, vertex, rng);
  const vec3 onward = path.throughput;
  path.throughput = throughput;
  asked = askForLight(vertex, request);
  path.throughput = onward;
  if (!asked) {
    goOn(scene, rng);
  }
}

void recordFirst(float t, vec3 albedo) {
  if (kAovs && path.events == 0u) {
    path.opacity = 1.0;
    path.depth = path.vertex.travelled + t;
    path.albedo = albedo;
  }
}

void arriveInMedium(ScenePtr scene, float t, uint medium, inout Rng rng) {
  if (path.events >= scene.at[0].maxEvents) {
    path.stage = kStageDone; // the last ray only looked for light
    return;
  }
  const vec3 albedo = scene.at[0].media.at[medium].albedo;
  recordFirst(t, albedo);
  path.throughput *= albedo;
  scatter(scene, mediumVertex(scene, path.ray, t, medium), rng);
}

// Share of the path's own direction in finding the emissive surface that it has hit.
float emissionWeight(ScenePtr scene, SurfaceVertex surface) {
  if (path.vertex.pdf == 0.0 || surface.emitter == kNoEmitter) {
    return 1.0;
  }
  if (kAimed && path.vertex.aimed != 0u && isSmall(scene, surface.emitter)) {
    return 0.0; // light samples find it better
  }
  const float distance = path.vertex.travelled + path.hit.t;
  const float light = emitterDirectionPdf(scene.at[0].emitters, surface.emitter, path.vertex.point, path.ray.direction,
                                          distance, surface.frontNormal);
  return directionWeight(path.vertex.pdf, light * emitterProbability(scene, surface.emitter, path.vertex));
}

void arriveOnSurface(ScenePtr scene, HitAttributes hit, SurfacePass through, inout Rng rng) {
  if (kPassing && through.passes) {
    castPath(through.beyond, kPlantedBug == kBugLineRestart ? 0.0 : path.vertex.travelled + path.hit.t);
    return;
  }
  const SurfaceVertex surface = surfaceVertex(scene, hit);
  if (kEmissiveSurfaces && surface.emission != vec3(0.0)) {
    path.radiance += path.throughput * surface.emission * emissionWeight(scene, surface);
  }
  recordFirst(path.hit.t, surface.scatter.bsdf.colour);
  if (path.events >= scene.at[0].maxEvents) {
    path.stage = kStageDone;
    return;
  }
  scatter(scene, surface.scatter, rng);
}

// Where the path's own ray is over, and in which medium; kNoMedium: on a surface, or nowhere.
float flightEnd(out uint medium) {
  medium = path.collisionMedium;
  if (kGrids && path.walk.tHit >= 0.0) {
    medium = path.walk.hitMedium;
    return path.walk.tHit;
  }
  return path.collisionT;
}

// What is likelier or less likely by the other channels' extinction: into their ratio, and into the throughput.
void countChannels(ScenePtr scene, float t, uint medium) {
  vec3 ratio = kHomogeneous ? flightRatio(scene, path.ray, t, path.hero) : vec3(1.0);
  ratio *= kGrids ? path.walk.ratio : vec3(1.0);
  if (medium < scene.at[0].homogeneousCount) {
    const vec3 colour = scene.at[0].media.at[medium].colour;
    ratio *= colour / heroOf(colour, path.hero);
  }
  path.ratio = kPlantedBug == kBugHeroWeight ? ratio : path.ratio * ratio;
  const float mean = (path.ratio.x + path.ratio.y + path.ratio.z) * (1.0 / 3.0);
  path.ratio /= mean;
  path.throughput *= ratio / mean;
}

// The path's ray, or a shadow ray, is over.
void stageEnd(ScenePtr scene, inout Rng rng) {
  const bool shadow = path.stage == kStageShadow;
  uint medium = kNoMedium;
  float t = 0.0;
  if (!shadow) {
    t = flightEnd(medium);
    if (kChromatic) {
      countChannels(scene, t, medium);
    }
  }
  const bool onSurface = kSurfaces && path.hit.primitive != kNoHit && medium == kNoMedium;
  HitAttributes hit;
  SurfacePass through;
  through.passes = false;
  if (onSurface && (kPassing || !shadow)) { // one place for both kinds of rays: it is much code
    hit = hitAttributes(scene);
    if (kPassing) {
      through = surfacePass(scene, hit, rng);
    }
  }
  if (shadow) {
    stageShadow(scene, through, rng);
  } else if (medium != kNoMedium) {
    noWalk();
    arriveInMedium(scene, t, medium, rng);
  } else if (onSurface) {
    noWalk();
    arriveOnSurface(scene, hit, through, rng);
  } else {
    noWalk();
    escape(scene);
  }
}

#endif

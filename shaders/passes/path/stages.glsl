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

#include "passes/path/gather.glsl"
#include "passes/path/view.glsl"

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
  if (kGuide) {
    recordLeaves(io.guide);
  }
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

// What a sample counts for where the camera ray ends: its distance may be guided.
float cameraWeight() { return kDistances ? path.throughput.x : 1.0; }

// Radiance from infinity along the path's ray.
void escape(ScenePtr scene) {
  if (path.events == 0u) {
    path.transmittance = cameraWeight();
    path.background = kBackground ? path.throughput * distantBackground(scene, path.ray.direction) : vec3(0.0);
  } else if (kDistantAreas) {
    const vec4 mixture = distantMixture(scene, path.ray.direction);
    path.radiance += path.throughput * mixture.xyz * directionWeight(path.vertex.pdf, mixture.w);
  }
  path.stage = kStageDone;
}

// Draws the direction in which the path goes on. Leaves a throughput of 0 where it ends.
void drawDirection(ScenePtr scene, ScatterPoint vertex, inout Rng rng) {
  if (path.events >= scene.at[0].maxEvents && !kFindable) {
    path.throughput = vec3(0.0);
    return;
  }
  path.flightFresh = 0u;
  if (stratified()) {
    const uvec3 words = strata(1u);
    rngQueue(rng, words, 2u);
    path.flightWord = words.z;
    path.flightFresh = 1u;
  }
  const DirectionSample direction = directionSample(vertex, rng);
  rng.queued = 0u;
  const ScatterSample drawn = direction.drawn;
  if (kGuide && kGuideLearn && !scatterIsDelta(vertex)) {
    recordVertex(io.guide, vertex, direction, path.throughput);
  }
  path.throughput *= drawn.weight;
  if (kGuide) {
    path.unguided = min(path.unguided * direction.unguided, 1e30);
  }
  if (path.events >= kRouletteEvents) {
    // A lobe that points to light lowers the throughput, and must not end the path for it.
    const float strongest = max(path.throughput.x, max(path.throughput.y, path.throughput.z)) * (kGuide ? path.unguided : 1.0);
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
  const vec3 throughput = path.throughput;
  LightRequest request;
  request.value = vec3(0.0);
  const bool guides = kGuide && !scatterIsDelta(vertex);
  if (kGuideView && guides) {
    view(io.guide, vertex);
    path.stage = kStageDone;
    return;
  }
  if (kGuideLearn && (guides || kGuideScreen)) { // on screen no mirror passes on what it shows
    recordArrives(io.guide, vertex, throughput, rng);
  }
  if (guides) {
    prepareDirection(io.guide, vertex, rng);
  }
  if ((kEmitters || kDistantDeltas || kDistantAreas) && !scatterIsDelta(vertex)) {
    if (stratified()) {
      rngQueue(rng, strata(0u), 3u);
    }
    request = lightRequest(scene, vertex, rng);
    rng.queued = 0u;
  }
  drawDirection(scene, vertex, rng);
  const vec3 onward = path.throughput;
  path.throughput = throughput;
  const bool asked = askForLight(vertex, request);
  path.throughput = onward;
  if (!asked) {
    goOn(scene, rng);
  }
}

void recordFirst(float t, vec3 albedo) {
  if (kAovs && path.events == 0u) {
    path.opacity = cameraWeight();
    path.depth = path.opacity * (path.vertex.travelled + t);
    path.albedo = path.opacity * albedo;
  }
}

// Whether the path scatters at `vertex`.
bool arriveInMedium(ScenePtr scene, float t, uint medium, out ScatterPoint vertex) {
  vertex = mediumVertex(scene, path.ray, t, medium);
  if (kGuide) {
    recordMeets(io.guide, vertex.place.position, vertex.place.position);
  }
  if (path.events >= scene.at[0].maxEvents) {
    path.stage = kStageDone; // the last ray only looked for light
    return false;
  }
  const vec3 albedo = scene.at[0].media.at[medium].albedo;
  recordFirst(t, albedo);
  path.throughput *= albedo;
  return true;
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

// Likewise.
bool arriveOnSurface(ScenePtr scene, HitAttributes hit, SurfacePass through, out ScatterPoint vertex) {
  if (kPassing && through.passes) {
    castPath(through.beyond, kPlantedBug == kBugLineRestart ? 0.0 : path.vertex.travelled + path.hit.t);
    return false;
  }
  if (kGuide) {
    recordMeets(io.guide, hit.place.position, placeBefore(scene, hit));
  }
  const SurfaceVertex surface = surfaceVertex(scene, hit);
  if (kEmissiveSurfaces && surface.emission != vec3(0.0)) {
    path.radiance += path.throughput * surface.emission * emissionWeight(scene, surface);
  }
  recordFirst(path.hit.t, surface.scatter.bsdf.colour);
  vertex = surface.scatter;
  if (path.events >= scene.at[0].maxEvents) {
    path.stage = kStageDone;
    return false;
  }
  return true;
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
    if (kDistances && path.events == 0u && !endDistance(scene, io.guide, t, medium, rng)) {
      noWalk();
      path.stage = kStageDone;
      return;
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
    return;
  }
  noWalk();
  ScatterPoint vertex;
  bool scatters = false;
  if (medium != kNoMedium) {
    scatters = arriveInMedium(scene, t, medium, vertex);
  } else if (onSurface) {
    scatters = arriveOnSurface(scene, hit, through, vertex);
  } else {
    escape(scene);
  }
  if (scatters) { // one place for media and surfaces: it is the most code
    scatter(scene, vertex, rng);
  }
}

#endif

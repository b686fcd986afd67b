// SPDX-License-Identifier: Apache-2.0
// The pass `path`; its contract is path_io.h, its light transport stages.glsl. A module of it is this file and what
// casts rays through surfaces, which is all that differs.
#ifndef TYNDALL_PATH_KERNEL_GLSL
#define TYNDALL_PATH_KERNEL_GLSL

#include "passes/path/path_io.h"

#define SPEC(type, name, id, value) layout(constant_id = id) const type name = value;
TYNDALL_PATH_SPEC(SPEC)
#undef SPEC
const bool kWeighted = false; // the walk stops at collisions
const bool kDistances = kGuide && kGuideDistances;

layout(push_constant, scalar) uniform Push { PathInputs io; };

// The sample in flight. Private memory, and no argument of the stages: copies of it at every call are what compiling costs.
PathState path;

uvec2 pixelInFlight() {
  const uint packed = io.pixels.at[path.slot];
  return uvec2(packed & 0xffffu, packed >> 16);
}

#include "passes/path/stages.glsl"

layout(local_size_x = 64) in;

// Adds the finished sample to the batch. A sample that is not finite is dropped and counted.
void finishSample(inout Rng rng) {
  const vec3 total = path.radiance + path.background;
  if (!isFinite(total) || !isFinite(path.depth)) {
    atomicAdd(io.counters.at[0].nonFinite, 1u);
  } else {
    if (any(lessThan(total, vec3(0.0)))) {
      atomicAdd(io.counters.at[0].negative, 1u);
    }
    for (int c = 0; c < 3; ++c) {
      path.sums.moments[c] += path.radiance[c];
      path.sums.extras[c] += path.background[c];
      path.sums.extras[5 + c] += path.albedo[c];
    }
    if (kGuide && kGuideLearn) {
      learnFromPath(io.guide, rng);
    }
    if (kDistances && kGuideLearn && path.distanceLearns != 0u) {
      learnDistance(io.guide, path.slot, pixelInFlight(), scoreOf(total), rng);
    }
    path.sums.moments[3] += path.transmittance;
    path.sums.extras[3] += path.depth;
    path.sums.extras[4] += path.opacity;
  }
  if (kCount) {
    atomicAdd(io.counters.at[0].events, path.events);
    atomicMax(io.counters.at[0].maxEvents, path.events);
  }
  ++path.sampleIndex;
  path.target = kTargetPath; // the next sample begins in the turn of paths' own rays
  path.stage = path.sampleIndex < io.sampleCount ? kStageSample : kStageDone;
}

// Of geometry/ray.glsl or geometry/ray_query.glsl, which the module includes.
SurfaceHit surfaceCast(SurfacesPtr surfaces, vec3 origin, vec3 direction, float tMax, bool anyHit);

// Casts the ray in flight; returns whether something opaque is in a shadow ray's way.
bool castFlight() {
  path.casting = 0u;
  if (!kSurfaces) {
    return false;
  }
  const bool shadow = path.target == kTargetLight;
  const SurfaceHit hit =
      surfaceCast(io.scene.at[0].surfaces, path.ray.origin, path.ray.direction, path.ray.tMax, shadow);
  path.hit.t = hit.t;
  path.hit.primitive = hit.primitive;
  path.hit.instance = hit.instance;
  path.hit.place = hit.barycentric;
  return hit.blocked;
}

// Runs the stage that follows the finished walk. Returns false when the pixel's batch is done.
bool runStage(inout Rng rng) {
  switch (path.stage) {
  case kStageGather:
    if (kMediaEmission) {
      stageGather(io.scene, rng);
    }
    break;
  case kStagePoint:
    if (kMediaEmission) {
      stagePoint(io.scene, rng);
    }
    break;
  case kStageGlow:
    if (kMediaEmission) {
      stageGlow(io.scene);
    }
    break;
  case kStageAimed:
    if (kAimed) {
      stageAimed(io.scene, rng);
    }
    break;
  case kStageArrive:
  case kStageShadow:
    stageEnd(io.scene, rng);
    break;
  }
  if (path.stage == kStageDone) {
    finishSample(rng);
  }
  return path.stage != kStageDone;
}

void beginPath(uint slot) {
  path.slot = slot;
  if (kGuideView && io.resume == 0u) {
    io.views.at[slot] = kNoView;
  }
  path.sampleIndex = 0u;
  path.stage = kStageSample;
  path.casting = 0u;
  path.rng = uvec4(0u);
  path.target = kTargetPath;
  path.travelled = 0.0;
  path.recordCount = 0u;
  path.recordStage = kRecordClosed;
  path.distanceShare = -1.0;
  path.guidedT = -1.0;
  path.distanceLearns = 0u;
  path.pending = vec3(0.0);
  path.glow = vec3(0.0);
  path.walk = walkBegin(vec3(0.0), vec3(0.0), 0.0, kWalkTransmit, 0u);
  noWalk();
  for (int i = 0; i < 4; ++i) {
    path.sums.moments[i] = 0.0;
  }
  for (int i = 0; i < 8; ++i) {
    path.sums.extras[i] = 0.0;
  }
}

void countGuiding() {
  GuideCountersPtr counters = io.guide.at[0].counters;
  atomicAdd(counters.at[0].vertices, mixtureVertices);
  atomicAdd(counters.at[0].states, mixtureStates);
  atomicAdd(counters.at[0].guided, mixtureGuided);
  if (kDistances) {
    atomicAdd(counters.at[0].distanceRays, distanceRays);
    atomicAdd(counters.at[0].distanceGuided, distanceGuided);
  }
  if (kGuideLearn) {
    atomicAdd(counters.at[0].accepted, learnAccepted);
    atomicAdd(counters.at[0].forgotten, learnForgotten);
    atomicAdd(counters.at[0].unsound, learnUnsound);
  }
}

void main() {
  const uint invocation = gl_GlobalInvocationID.x;
  if (invocation >= io.count) {
    return;
  }
  beginPath(invocation);
  if (io.resume != 0u) {
    path = io.suspendedIn.at[invocation];
  }
  Rng rng;
  rng.state = path.rng;
  rng.queued = 0u;
  const uvec2 pixel = pixelInFlight();
  WalkCounts counts = WalkCounts(0u, 0u, io.stepBound);
  uint segments = 0u;
  bool done = false;
  // Turns for paths' own rays and for shadow rays: a lane that is not in step waits for its turn, so that lanes scatter
  // together, which is most of the code. On a CPU device 3 of 8 did before.
  bool shadowTurn = true;
  [[dont_unroll]] for (;;) {
    shadowTurn = !shadowTurn;
    if (isShadow() != shadowTurn) {
      continue;
    }
    if (path.stage == kStageSample) {
      stageSample(io.scene, pixel, io.seed, io.firstSample + path.sampleIndex, rng);
    }
    if (path.casting != 0u) {
      ++segments;
      stageCast(io.scene, castFlight(), rng);
    }
    if (kGrids && !walkAdvance(path.walk, io.scene, rng, counts)) {
      break;
    }
    if (!runStage(rng)) {
      done = true;
      break;
    }
    if (counts.stepsLeft <= io.stageCost) {
      break;
    }
    counts.stepsLeft -= io.stageCost;
  }
  if (done) {
    io.sums.at[path.slot] = path.sums;
  } else {
    path.rng = rng.state;
    io.suspendedOut.at[atomicAdd(io.counters.at[0].suspended, 1u)] = path;
  }
  if (kCount) {
    atomicAdd(io.counters.at[0].lookups, counts.lookups);
    atomicAdd(io.counters.at[0].segments, segments);
  }
  if (kGuide && kCount) {
    countGuiding();
  }
  if (counts.exceeded > 0u) {
    atomicAdd(io.counters.at[0].majorantExceeded, counts.exceeded);
  }
}

#endif

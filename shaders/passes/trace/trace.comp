#version 460
// SPDX-License-Identifier: Apache-2.0
// The pass `trace`; its contract is trace_io.h, its light transport stages.glsl.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/trace/trace_io.h"

#define SPEC(type, name, id, value) layout(constant_id = id) const type name = value;
TYNDALL_TRACE_SPEC(SPEC)
#undef SPEC
const bool kChromatic = false;

#include "passes/trace/stages.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { TraceInputs io; };

// Adds the finished sample to the batch. A sample that is not finite is dropped and counted.
void finishSample(inout TraceState path) {
  const vec3 scattered = path.radiance;
  const vec3 total = scattered + path.background;
  const bool sound = isFinite(total) && isFinite(path.transmittance) && isFinite(path.depth);
  if (!sound) {
    atomicAdd(io.counters.at[0].nonFinite, 1u);
  } else {
    if (any(lessThan(total, vec3(0.0)))) {
      atomicAdd(io.counters.at[0].negative, 1u);
    }
    path.sums.moments[0] += scattered.x;
    path.sums.moments[1] += scattered.y;
    path.sums.moments[2] += scattered.z;
    path.sums.moments[3] += path.transmittance;
    path.sums.extras[0] += path.background.x;
    path.sums.extras[1] += path.background.y;
    path.sums.extras[2] += path.background.z;
    path.sums.extras[3] += path.depth;
    path.sums.extras[4] += path.opacity;
    path.sums.extras[5] += path.albedo.x;
    path.sums.extras[6] += path.albedo.y;
    path.sums.extras[7] += path.albedo.z;
  }
  ++path.sampleIndex;
  path.stage = path.sampleIndex < io.sampleCount ? kStageSample : kStageDone;
}

// Runs the stage that follows the finished walk. Returns false when the pixel's batch is done.
bool runStage(inout TraceState path, uvec2 pixel, inout Rng rng) {
  switch (path.stage) {
  case kStageSample:
    stageSample(path, io.scene, pixel, io.seed, io.firstSample + path.sampleIndex, rng);
    break;
  case kStageCamera:
    stageCamera(path, io.scene);
    break;
  case kStageVertex:
    stageVertex(path, io.scene, rng);
    break;
  case kStageEmission:
    if (kGridEmission) {
      stageEmission(path, io.scene, rng);
    }
    break;
  case kStageTransmit:
    stageTransmit(path, io.scene);
    break;
  case kStageShade:
    stageShade(path, io.scene, rng);
    break;
  case kStageLight:
    stageLight(path, io.scene, rng);
    break;
  case kStageDirection:
    stageDirection(path);
    break;
  }
  if (path.stage == kStageDone) {
    finishSample(path);
  }
  return path.stage != kStageDone;
}

TraceState newState(uint slot) {
  TraceState path;
  path.slot = slot;
  path.sampleIndex = 0u;
  path.stage = kStageSample;
  path.rng = uvec4(0u);
  path.vertexEmission = vec3(0.0);
  path.pending = vec3(0.0);
  path.walk = walkBegin(vec3(0.0), vec3(0.0), 0.0, kWalkTransmit, 0u);
  noWalk(path);
  for (int i = 0; i < 4; ++i) {
    path.sums.moments[i] = 0.0;
  }
  for (int i = 0; i < 8; ++i) {
    path.sums.extras[i] = 0.0;
  }
  return path;
}

void main() {
  const uint invocation = gl_GlobalInvocationID.x;
  if (invocation >= io.count) {
    return;
  }
  TraceState path = newState(invocation);
  if (io.resume != 0u) {
    path = io.suspendedIn.at[invocation];
  }
  Rng rng;
  rng.state = path.rng;
  rng.queued = 0u;
  const uint packed = io.pixels.at[path.slot];
  const uvec2 pixel = uvec2(packed & 0xffffu, packed >> 16);
  WalkCounts counts = WalkCounts(0u, 0u, io.stepBound);
  uint segments = 0u;
  bool done = false;
  [[dont_unroll]] for (;;) {
    if (kGrids && !walkAdvance(path.walk, io.scene, rng, counts)) {
      break;
    }
    if (!runStage(path, pixel, rng)) {
      done = true;
      break;
    }
    segments += uint(path.walk.medium != kNoWalk);
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
  if (counts.exceeded > 0u) {
    atomicAdd(io.counters.at[0].majorantExceeded, counts.exceeded);
  }
}

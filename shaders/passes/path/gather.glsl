// SPDX-License-Identifier: Apache-2.0
// The stages Gather, Point and Glow: emission of media along the ray in flight, (63) of docs/theory.md.
#ifndef TYNDALL_PATH_GATHER_GLSL
#define TYNDALL_PATH_GATHER_GLSL

#include "passes/path/rays.glsl"

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

#endif

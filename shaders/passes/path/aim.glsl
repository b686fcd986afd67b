// SPDX-License-Identifier: Apache-2.0
// The event of a ray in homogeneous media that is aimed at a small light: the light is chosen first.
#ifndef TYNDALL_PATH_AIM_GLSL
#define TYNDALL_PATH_AIM_GLSL

#include "passes/path/lights.glsl"

struct Aimed {
  ScatterPoint vertex;
  LightRequest request;
  vec3 value; // of the event and its light sample, transmittance of grids and to the light left out; 0: none
};

// One of the media at t, in proportion to their extinction; `chance` is its probability.
uint mediumAt(ScenePtr scene, float t, float total, inout Rng rng, out float chance) {
  float target = rngFloat(rng) * total;
  uint chosen = kNoMedium;
  chance = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].homogeneousCount; ++i) {
    const vec3 stretch = mediumStretch(scene, i, path.ray, path.hit.t);
    if (stretch.x <= t && t <= stretch.y && stretch.x < stretch.y) {
      float own = scene.at[0].media.at[i].sigmaT * stretch.z;
      own *= kChromatic ? meanOf(scene.at[0].media.at[i].colour) : 1.0;
      if (own > 0.0 && (chosen == kNoMedium || target >= 0.0)) {
        chosen = i;
        chance = own / total;
      }
      target -= own;
    }
  }
  return chosen;
}

// Along the path's ray, which has been cast. Chooses the place that lights are chosen for, too.
Aimed aimAtEmitter(ScenePtr scene, inout Rng rng) {
  Aimed aimed;
  aimed.value = vec3(0.0);
  const vec2 stretch = homogeneousStretch(scene);
  if (stretch.x >= stretch.y) {
    return aimed;
  }
  // Where light would be asked for by free flight, if it stayed in the medium it begins in. Any place is unbiased.
  const float sigmaT = meanOf(homogeneousExtinction(scene, stretch.x));
  const float length = stretch.y - stretch.x;
  const float xi = rngFloat(rng);
  path.aim = stretch.x + (sigmaT * length > 1e-3 ? opticalDepthAt(xi * oneMinusExp(sigmaT * length)) / sigmaT : xi * length);
  path.aim = min(path.aim, stretch.y);
  const EmitterChoice choice = chooseEmitter(scene.at[0].emitters, aimReceiver(), rngFloat(rng), rng);
  if (!isSmall(scene, choice.emitter)) {
    return aimed;
  }
  EmitterPtr list = scene.at[0].emitters.at[0].emitters;
  const Equiangular e =
      equiangularMake(path.ray.origin, path.ray.direction, list.at[choice.emitter].position, stretch.x, stretch.y);
  const float t = equiangularSample(e, rngFloat(rng));
  const vec3 extinction = homogeneousExtinction(scene, t);
  const float total = meanOf(extinction);
  if (!(total > 0.0)) {
    return aimed;
  }
  float chance;
  const uint medium = mediumAt(scene, t, total, rng, chance);
  aimed.vertex = mediumVertex(scene, path.ray, t, medium);
  aimed.request = surfaceRequest(scene, aimed.vertex.place.position, choice.emitter, 1.0, rng);
  if (aimed.request.value == vec3(0.0)) {
    return aimed;
  }
  const LightReceiver receiver = receiverOf(aimed.vertex);
  const vec3 depth = flightDepth(scene, path.ray, t);
  const float flight = scene.at[0].emitterShare * emitterChoicePdf(scene.at[0].emitters, choice.emitter, receiver) *
                       eventDensity(total * exp(-meanOf(depth)), t);
  const float density = flight + choice.pdf * equiangularPdf(e, t);
  const float own = scene.at[0].media.at[medium].sigmaT;
  const vec3 scattering = own * (kChromatic ? scene.at[0].media.at[medium].colour : vec3(1.0)) *
                          mediumStretch(scene, medium, path.ray, path.hit.t).z * scene.at[0].media.at[medium].albedo;
  const float phase = evalPhase(aimed.vertex.phase, aimed.vertex.incoming, aimed.request.direction);
  aimed.value = scattering * exp(-depth) * aimed.request.value * (phase / (aimed.request.pdf * density * chance));
  return aimed;
}

#endif

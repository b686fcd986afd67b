// SPDX-License-Identifier: Apache-2.0
// Two ways to an event in homogeneous media under a small light: free flight and then the choice of a light, or a light
// first and then a distance uniform in the angle seen from it [Kulla12]. With free flight alone the variance near a
// point light is infinite. Both densities are over distance and light, without the grids' transmittance, which they share;
// docs/theory.md, (68).
#ifndef TYNDALL_PATH_AIM_DENSITY_GLSL
#define TYNDALL_PATH_AIM_DENSITY_GLSL

#include "core/equiangular.glsl"
#include "guide/distance_chains.glsl"
#include "light/emitter.glsl"
#include "light/tree.glsl"
#include "passes/path/flight.glsl"
#include "passes/path/scatter.glsl"

float meanOf(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }

// From the first to the last point of the path's ray that lies in a homogeneous medium; empty: x >= y.
vec2 homogeneousStretch(ScenePtr scene) {
  vec2 hull = vec2(kInfiniteDistance, 0.0);
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].homogeneousCount; ++i) {
    const vec3 stretch = mediumStretch(scene, i, path.ray, path.hit.t);
    if (stretch.x < stretch.y && scene.at[0].media.at[i].sigmaT > 0.0) {
      hull = vec2(min(hull.x, stretch.x), max(hull.y, stretch.y));
    }
  }
  return hull;
}

// Extinction at distance t, per channel [1/unit].
vec3 homogeneousExtinction(ScenePtr scene, float t) {
  vec3 sigmaT = vec3(0.0);
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].homogeneousCount; ++i) {
    const vec3 stretch = mediumStretch(scene, i, path.ray, path.hit.t);
    if (stretch.x <= t && t <= stretch.y && stretch.x < stretch.y) {
      const float own = scene.at[0].media.at[i].sigmaT * stretch.z;
      sigmaT += kChromatic ? own * scene.at[0].media.at[i].colour : vec3(own);
    }
  }
  return sigmaT;
}

// Density of a collision at t, of the mean of the channels [1/unit].
float flightDensity(ScenePtr scene, float t) {
  return meanOf(homogeneousExtinction(scene, t)) * exp(-meanOf(flightDepth(scene, path.ray, t)));
}

// Likewise of the path's event, whose distance chains may have drawn; `flight`: density of a collision at t.
float eventDensity(float flight, float t) {
  if (!kDistances || !(path.distanceShare > 0.0)) {
    return flight;
  }
  return mix(flight, distanceDensity(io.guide, path.slot, t), path.distanceShare);
}

// Density of aiming: of the emitter as the place `path.aim` chooses it, and of t.
float aimDensity(ScenePtr scene, uint emitter, float choicePdf, float t) {
  const vec2 stretch = homogeneousStretch(scene);
  EmitterPtr list = scene.at[0].emitters.at[0].emitters;
  const Equiangular e =
      equiangularMake(path.ray.origin, path.ray.direction, list.at[emitter].position, stretch.x, stretch.y);
  return choicePdf * equiangularPdf(e, t);
}

LightReceiver aimReceiver() {
  return LightReceiver(path.ray.origin + path.aim * path.ray.direction, vec3(0.0), false);
}

// Balance heuristic's weight of the light sample of a small emitter at a collision that free flight has made.
float flightShare(ScenePtr scene, ScatterPoint vertex, uint emitter, float choicePdf) {
  if (path.aim < 0.0 || kPlantedBug == kBugAimShare) {
    return 1.0;
  }
  const float flight = choicePdf * eventDensity(flightDensity(scene, vertex.flightT), vertex.flightT);
  const float aimChoice = emitterChoicePdf(scene.at[0].emitters, emitter, aimReceiver());
  const float aimed = aimDensity(scene, emitter, aimChoice, vertex.flightT);
  return aimed > 0.0 ? flight / (flight + aimed) : 1.0; // both may be 0 where a channel is opaque
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Homogeneous media along a ray, in closed form: the nearest collision, transmittance, and what is needed where
// extinction differs by channel.
#ifndef TYNDALL_PATH_FLIGHT_GLSL
#define TYNDALL_PATH_FLIGHT_GLSL

#include "medium/shape.glsl"
#include "tracker/walk.glsl"

// Of the refracting interiors in `mask` the one that decides the index of refraction: the highest priority, of equal
// ones the first. kNoInterior without any.
uint decidingInterior(SurfacesPtr surfaces, uint mask) {
  uint deciding = kNoInterior;
  uint priority = 0u;
  [[dont_unroll]] while (mask != 0u) {
    const uint bit = uint(findLSB(mask));
    mask &= mask - 1u;
    const uint own = surfaces.at[0].interiors.at[bit].priority;
    if (surfaces.at[0].interiors.at[bit].ior != kNotRefracting && (deciding == kNoInterior || own > priority)) {
      deciding = bit;
      priority = own;
    }
  }
  return deciding;
}

// The interiors in `mask` whose media are there: of refracting ones that overlap, the deciding one's alone.
uint filledInteriors(ScenePtr scene, uint mask) {
  if (!kPassing || bitCount(mask) < 2) {
    return mask;
  }
  SurfacesPtr surfaces = scene.at[0].surfaces;
  const uint deciding = decidingInterior(surfaces, mask);
  uint filled = 0u;
  [[dont_unroll]] while (mask != 0u) {
    const uint bit = uint(findLSB(mask));
    mask &= mask - 1u;
    if (bit == deciding || surfaces.at[0].interiors.at[bit].ior == kNotRefracting) {
      filled |= 1u << bit;
    }
  }
  return filled;
}

// The part of a ray in homogeneous medium `index` (x, y; empty: x >= y) and how often it lies there (z): objects that
// overlap add up.
vec3 mediumStretch(ScenePtr scene, uint index, PathRay ray, float tMax) {
  if (kInteriors && scene.at[0].media.at[index].shape == kShapeInterior) {
    const int count = bitCount(filledInteriors(scene, ray.interiors) & scene.at[0].media.at[index].interiors);
    return count > 0 ? vec3(0.0, tMax, float(count)) : vec3(1.0, 0.0, 0.0);
  }
  const Medium medium = scene.at[0].media.at[index];
  return vec3(mediumInterval(medium, ray.origin, ray.direction, tMax), 1.0);
}

// Optical depth of all homogeneous media along the ray up to t, per channel.
vec3 flightDepth(ScenePtr scene, PathRay ray, float t) {
  vec3 depth = vec3(0.0);
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].homogeneousCount; ++i) {
    const vec3 stretch = mediumStretch(scene, i, ray, t);
    const float own = scene.at[0].media.at[i].sigmaT * max(stretch.y - stretch.x, 0.0) * stretch.z;
    depth += kChromatic ? own * scene.at[0].media.at[i].colour : vec3(own);
  }
  return depth;
}

vec3 flightTransmittance(ScenePtr scene, PathRay ray, float t) {
  return kHomogeneous ? exp(-flightDepth(scene, ray, t)) : vec3(1.0);
}

// The nearest collision before tMax: every medium draws its own, for independent Poisson processes the nearest is one
// of their sum. tMax if there is none.
float flightCollision(ScenePtr scene, PathRay ray, float tMax, uint hero, inout Rng rng, out uint medium) {
  float nearest = tMax;
  medium = kNoMedium;
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].homogeneousCount; ++i) {
    const vec3 stretch = mediumStretch(scene, i, ray, nearest);
    float sigmaT = scene.at[0].media.at[i].sigmaT * stretch.z;
    if (kChromatic) {
      sigmaT *= heroOf(scene.at[0].media.at[i].colour, hero);
    }
    if (stretch.x < stretch.y && sigmaT > 0.0) {
      const float t = stretch.x + opticalDepthDraw(rng) / sigmaT;
      if (t < stretch.y) {
        nearest = t;
        medium = i;
      }
    }
  }
  return nearest;
}

// How much likelier each channel makes a flight to t than the hero does.
vec3 flightRatio(ScenePtr scene, PathRay ray, float t, uint hero) {
  const vec3 depth = flightDepth(scene, ray, t);
  return exp(heroOf(depth, hero) - depth);
}

#endif

// SPDX-License-Identifier: Apache-2.0
// A place where a path scatters, in a medium or on a surface, with one interface for both.
#ifndef TYNDALL_PATH_SCATTER_GLSL
#define TYNDALL_PATH_SCATTER_GLSL

#include "core/frame.glsl"
#include "geometry/offset.glsl"
#include "interop/scene.h"
#include "material/bsdf.glsl"
#include "passes/path/path_io.h"
#include "phase/planted.glsl"

struct ScatterPoint {
  SurfacePoint place;   // media: normal 0; surfaces: the normal is on the side of the shading frame's z
  vec3 before;          // where the place was in the previous frame
  vec3 incoming;        // the way the path travels, unit
  Phase phase;          // media
  Bsdf bsdf;            // surfaces
  mat3 frame;           // surfaces: world from the shading frame
  bool surface;
  bool transmits;       // surfaces: light from below the normal counts
  float flightT;        // where on the path's ray a collision in a homogeneous medium lies; < 0: it is none
  uint above;           // interiors on the normal's side,
  uint below;           // ... and on the other one; media: both the same
};

struct ScatterSample {
  vec3 direction;
  vec3 weight; // value / pdf; 0: the path ends
  float pdf;   // [1/sr]; 0 for what is drawn from a delta
};

bool onSurface(ScatterPoint vertex) { return kSurfaces && vertex.surface; }

bool scatterIsDelta(ScatterPoint vertex) { return onSurface(vertex) && bsdfIsDelta(vertex.bsdf); }

// A direction that a bent shading normal puts on the other side than the surface itself is dark: light would leak.
bool sidesAgree(ScatterPoint vertex, vec3 w, float localZ) { return dot(w, vertex.place.normal) * localZ > 0.0; }

// Value (phase function, or BSDF times |cos|, [1/sr]) and density of scatterSample; both 0 for deltas.
vec4 scatterEvalPdf(ScatterPoint vertex, vec3 w) {
  if (!onSurface(vertex)) {
    return vec4(evalPhase(vertex.phase, vertex.incoming, w));
  }
  const vec3 local = w * vertex.frame;
  const vec4 value = bsdfEvalPdf(vertex.bsdf, -vertex.incoming * vertex.frame, local);
  return sidesAgree(vertex, w, local.z) ? value : vec4(vec3(0.0), value.w);
}

ScatterSample scatterSample(ScatterPoint vertex, inout Rng rng) {
  ScatterSample result = ScatterSample(vertex.incoming, vec3(0.0), 0.0);
  if (!onSurface(vertex)) {
    result.direction = phaseSample(vertex.phase, vertex.incoming, rng);
    result.pdf = evalPhase(vertex.phase, vertex.incoming, result.direction);
    result.weight = vec3(1.0);
    return result;
  }
  const BsdfSample drawn = bsdfSample(vertex.bsdf, -vertex.incoming * vertex.frame, rng);
  result.direction = normalize(vertex.frame * drawn.wi);
  result.pdf = drawn.delta ? 0.0 : drawn.pdf;
  if (drawn.valid && sidesAgree(vertex, result.direction, drawn.wi.z)) {
    result.weight = drawn.weight;
  }
  return result;
}

// A ray that leaves the vertex.
PathRay leave(ScatterPoint vertex, vec3 direction, float tMax) {
  PathRay ray = PathRay(vertex.place.position, direction, tMax, vertex.above);
  if (onSurface(vertex)) {
    ray.origin = offsetOrigin(vertex.place, direction);
    ray.interiors = dot(direction, vertex.place.normal) < 0.0 ? vertex.below : vertex.above;
  }
  return ray;
}

// A vertex in a medium, at distance t of the path's ray.
ScatterPoint mediumVertex(ScenePtr scene, PathRay ray, float t, uint medium) {
  ScatterPoint vertex;
  vertex.flightT = medium < scene.at[0].homogeneousCount ? t : -1.0;
  vertex.place = SurfacePoint(ray.origin + t * ray.direction, vec3(0.0), 0.0);
  vertex.before = vertex.place.position;
  vertex.incoming = ray.direction;
  vertex.phase = scene.at[0].media.at[medium].phase;
  vertex.surface = false;
  vertex.transmits = true;
  vertex.above = ray.interiors;
  vertex.below = ray.interiors;
  return vertex;
}

#endif

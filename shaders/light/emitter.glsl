// SPDX-License-Identifier: Apache-2.0
// Samples of one emitter as seen from a point, and their density; theory.md, (44) to (46). Emission of volumes
// (kEmitterVolume) is not sampled here.
#ifndef TYNDALL_LIGHT_EMITTER_GLSL
#define TYNDALL_LIGHT_EMITTER_GLSL

#include "core/rng.glsl"
#include "core/warp.glsl"
#include "interop/emitters.h"

struct LightSample {
  vec3 direction;   // unit, to the light
  float distance;   // exact, to the light's surface
  vec3 radiance;    // [W/(m2 sr)], before an emission texture; delta: intensity / distance^2
  float pdf;        // [1/sr]; delta: 1. 0: nothing arrives, the rest means nothing
  bool delta;       // point and spot
  vec3 normal;      // of the surface: triangle cross(edge1, edge2), sphere outwards, both unit
  vec2 barycentric; // triangle: weights of v1 and v2
};

LightSample noLightSample() {
  return LightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0, false, vec3(0.0, 0.0, 1.0), vec2(0.0));
}

/// Share of a spot's intensity along `w` (unit, the way the light travels): smoothstep of the cosine between the
/// half-angles; both equal: a sharp edge.
float spotFalloff(Emitter spot, vec3 w) {
  const float outer = spot.edge2.x;
  const float inner = spot.edge2.y;
  const float oneMinusCos = oneMinusCosBetween(spot.edge1, w);
  if (oneMinusCos >= outer) {
    return 0.0;
  }
  const float x = oneMinusCos <= inner ? 1.0 : (outer - oneMinusCos) / (outer - inner);
  return x * x * (3.0 - 2.0 * x);
}

LightSample pointEmitterSample(Emitter light, vec3 point) {
  LightSample result = noLightSample();
  const vec3 offset = light.position - point;
  const float distance2 = dot(offset, offset);
  if (!(distance2 > 1e-36)) {
    return result;
  }
  result.distance = sqrt(distance2);
  result.direction = offset / result.distance;
  result.normal = -result.direction;
  const float share = light.kind == kEmitterSpot ? spotFalloff(light, -result.direction) : 1.0;
  result.radiance = light.radiance * (share / distance2);
  result.pdf = share > 0.0 ? 1.0 : 0.0;
  result.delta = true;
  return result;
}

// Density [1/sr] of points drawn uniformly on `area`; 0 where the surface is seen edge-on or from its dark side.
float areaPdf(Emitter light, float area, float distance2, float cosine) {
  const float facing = (light.flags & kEmitterTwoSided) != 0u ? abs(cosine) : cosine;
  const float projected = facing * area;
  return projected > 0.0 ? distance2 / projected : 0.0;
}

/// Uniform on the triangle's area, (44).
LightSample triangleEmitterSample(Emitter light, vec3 point, vec2 xi) {
  LightSample result = noLightSample();
  const float root = sqrt(xi.x);
  result.barycentric = vec2(root * (1.0 - xi.y), root * xi.y);
  const vec3 inPlane = result.barycentric.x * light.edge1 + result.barycentric.y * light.edge2;
  const vec3 offset = (light.position - point) + inPlane;
  const vec3 normal = cross(light.edge1, light.edge2); // twice the area
  const float doubleArea = length(normal);
  const float distance2 = dot(offset, offset);
  if (!(distance2 > 1e-36) || !(doubleArea > 0.0)) {
    return result;
  }
  result.distance = sqrt(distance2);
  result.direction = offset / result.distance;
  result.normal = normal / doubleArea;
  result.radiance = light.radiance;
  result.pdf = areaPdf(light, 0.5 * doubleArea, distance2, -dot(result.normal, result.direction));
  return result;
}

// A sphere seen from outside: what the cone of its visible directions is made of. Differences of nearly equal lengths
// are taken once, of the lengths themselves.
struct SphereCone {
  float distance;    // to the centre
  float tangent2;    // square of the distance to the horizon; <= 0: the point is not outside
  float oneMinusCos; // of half the cone's angle
};

SphereCone sphereCone(Emitter sphere, vec3 point) {
  const float radius = sphere.edge1.x;
  SphereCone cone;
  cone.distance = length(sphere.position - point);
  cone.tangent2 = (cone.distance - radius) * (cone.distance + radius);
  const float sine = radius / max(cone.distance, radius);
  cone.oneMinusCos = max(sine * sine / (1.0 + safeSqrt(cone.tangent2) / cone.distance), 1e-36);
  return cone;
}

/// Uniform in the cone of directions that meet it, (45).
LightSample sphereOutsideSample(Emitter light, vec3 point, SphereCone cone, vec2 xi) {
  LightSample result = noLightSample();
  const float oneMinusCos = xi.x * cone.oneMinusCos;
  const float cosine = 1.0 - oneMinusCos;
  const float sine = safeSqrt(oneMinusCos * (2.0 - oneMinusCos));
  // The ray meets the sphere at the angle beta to its normal; q = sin^2 beta = sin^2 theta / sin^2 theta_max.
  const float q = min(xi.x * (2.0 - oneMinusCos) / (2.0 - cone.oneMinusCos), 1.0);
  const float sinBeta = sqrt(q);
  const float cosBeta = safeSqrt(1.0 - q);
  const mat3 frame = frameAbout((light.position - point) / cone.distance);
  const vec2 azimuth = cosSinTurns(xi.y);
  result.direction = frame * vec3(sine * azimuth, cosine);
  // The smaller root as the quotient of the product of the roots by the larger one.
  result.distance = cone.tangent2 / (cone.distance * cosine + light.edge1.x * cosBeta);
  // At the centre the hit lies at the angle beta - theta from the point.
  result.normal = frame * vec3((sinBeta * cosine - cosBeta * sine) * azimuth, -(cosBeta * cosine + sinBeta * sine));
  result.radiance = light.radiance;
  result.pdf = uniformConePdf(cone.oneMinusCos);
  return result;
}

/// Uniform on the sphere's area: from inside, where it shines if it is two-sided.
LightSample sphereInsideSample(Emitter light, vec3 point, vec2 xi) {
  LightSample result = noLightSample();
  const float radius = light.edge1.x;
  result.normal = uniformSphereSample(xi);
  const vec3 offset = (light.position - point) + radius * result.normal;
  const float distance2 = dot(offset, offset);
  if (!(distance2 > 1e-36)) {
    return result;
  }
  result.distance = sqrt(distance2);
  result.direction = offset / result.distance;
  result.radiance = light.radiance;
  result.pdf = areaPdf(light, kFourPi * radius * radius, distance2, -dot(result.normal, result.direction));
  return result;
}

/// A direction from `point` (centred world space) to an emitter.
LightSample sampleEmitter(EmittersPtr emitters, uint emitter, vec3 point, inout Rng rng) {
  EmitterPtr list = emitters.at[0].emitters;
  const Emitter light = list.at[emitter];
  if (light.kind == kEmitterPoint || light.kind == kEmitterSpot) {
    return pointEmitterSample(light, point);
  }
  const vec2 xi = rngFloat2(rng);
  if (light.kind == kEmitterTriangle) {
    return triangleEmitterSample(light, point, xi);
  }
  const SphereCone cone = sphereCone(light, point);
  if (cone.tangent2 > 0.0) {
    return sphereOutsideSample(light, point, cone, xi);
  }
  return sphereInsideSample(light, point, xi);
}

/// Density [1/sr] of sampleEmitter for a direction (unit) from `point` that meets the emitter at `distance`, where its
/// surface has the unit normal `lightNormal` (sphere: outwards). 0 for what is never drawn: a dark side, the far side
/// of a sphere seen from outside, points, spots and volumes.
float emitterDirectionPdf(EmittersPtr emitters, uint emitter, vec3 point, vec3 direction, float distance,
                          vec3 lightNormal) {
  EmitterPtr list = emitters.at[0].emitters;
  const Emitter light = list.at[emitter];
  const float cosine = -dot(lightNormal, direction);
  if (light.kind == kEmitterTriangle) {
    return areaPdf(light, 0.5 * length(cross(light.edge1, light.edge2)), distance * distance, cosine);
  }
  if (light.kind != kEmitterSphere) {
    return 0.0;
  }
  const SphereCone cone = sphereCone(light, point);
  if (cone.tangent2 > 0.0) {
    return cosine < -1e-4 ? 0.0 : uniformConePdf(cone.oneMinusCos); // a normal at the horizon is rounded
  }
  return areaPdf(light, kFourPi * light.edge1.x * light.edge1.x, distance * distance, cosine);
}

#endif

// SPDX-License-Identifier: Apache-2.0
// Distances along a ray, uniform in the angle seen from a centre c: pdf proportional to 1 / |x(t) - c|^2.
// [Kulla12] "Importance Sampling Techniques for Path Tracing in Participating Media".
#ifndef TYNDALL_CORE_EQUIANGULAR_GLSL
#define TYNDALL_CORE_EQUIANGULAR_GLSL

#include "core/numerics.glsl"

struct Equiangular {
  float tMin;
  float tMax;     // >= kInfiniteDistance: unbounded
  float delta;    // t of the point nearest to the centre
  float distance; // D of the centre from the ray, clamped from below; the same in sample and pdf
  float theta;    // angle that [tMin, tMax] subtends at the centre
};

/// `direction` unit; 0 <= tMin < tMax, tMax <= 1e15 or >= kInfiniteDistance.
Equiangular equiangularMake(vec3 origin, vec3 direction, vec3 centre, float tMin, float tMax) {
  const bool unbounded = tMax >= kInfiniteDistance;
  Equiangular e;
  e.tMin = tMin;
  e.tMax = tMax;
  e.delta = dot(centre - origin, direction);
  const float a = tMin - e.delta;
  const float b = tMax - e.delta;
  // A centre on the ray would be a pdf of zero width. 1e-5 of the ray spans 100 floats, so that sample and pdf agree.
  const float scale = unbounded ? abs(a) : tMax - tMin;
  const float trueDistance = length(centre - origin - e.delta * direction);
  e.distance = max(trueDistance, max(1e-5 * scale, 1e-15));
  e.theta = unbounded ? atan2Accurate(e.distance, a)
                      : atan2Accurate(e.distance * (b - a), e.distance * e.distance + a * b);
  return e;
}

/// t in [tMin, tMax]. The textbook delta + D tan(...) throws up to half of the float samples out of the interval
/// when the centre is behind or far beside it. Here t is measured from the end with which no difference of nearly
/// equal numbers remains: phi is the angle from tMin, psi the angle from tMax.
float equiangularSample(Equiangular e, float xi) {
  const bool unbounded = e.tMax >= kInfiniteDistance;
  const float a = e.tMin - e.delta;
  const float b = e.tMax - e.delta;
  const float D = e.distance;
  const float phi = xi * e.theta;
  const float psi = (1.0 - xi) * e.theta;
  const vec2 nearEnd = cosSin(phi);
  const vec2 farEnd = cosSin(psi);
  float t;
  if (a < 0.0 && (b <= 0.0 || phi <= psi)) {
    t = e.tMin + (D * D + a * a) * nearEnd.y / (D * nearEnd.x - a * nearEnd.y);
  } else if (a < 0.0) {
    t = unbounded ? e.delta + D * farEnd.x / farEnd.y
                  : e.tMax - (D * D + b * b) * farEnd.y / (D * farEnd.x + b * farEnd.y);
  } else {
    // sin(phi) sqrt(D^2 + a^2) over the sine of the ray's angle at t, which is psi past that of tMax.
    const float sine = unbounded ? farEnd.y : (D * farEnd.x + b * farEnd.y) / length(vec2(D, b));
    t = e.tMin + length(vec2(D, a)) * nearEnd.y / sine;
  }
  return clamp(t, e.tMin, e.tMax);
}

/// Density over t [1 / scene unit]; 0 outside the interval.
float equiangularPdf(Equiangular e, float t) {
  if (t < e.tMin || t > e.tMax) {
    return 0.0;
  }
  const float offset = t - e.delta;
  return e.distance / (e.theta * (e.distance * e.distance + offset * offset));
}

#endif

#version 460
// SPDX-License-Identifier: Apache-2.0
// Distances of core/equiangular.glsl along the ray from `origin`: outputs (t, pdf, D, delta).
#extension GL_GOOGLE_include_directive : require
#include "core/equiangular.glsl"
#include "core/rng.glsl"
#include "interop/basic.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kPlanted = 0u; // 1: the textbook formula; 2: the pdf without its Jacobian
layout(push_constant, scalar) uniform Push {
  vec3 origin;
  vec3 direction;
  vec3 centre;
  float tMin;
  float tMax;
  uint count;
  vec4Ptr outputs;
};

float textbookSample(Equiangular e, float xi) {
  const float thetaA = atan(e.tMin - e.delta, e.distance);
  const float thetaB = atan(e.tMax - e.delta, e.distance);
  return e.delta + e.distance * tan(mix(thetaA, thetaB, xi));
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) {
    return;
  }
  Rng rng = rngSeed(uvec2(i, 11u), 2u, 5u);
  const float xi = rngFloat(rng);
  const Equiangular e = equiangularMake(origin, direction, centre, tMin, tMax);
  const float t = kPlanted == 1u ? textbookSample(e, xi) : equiangularSample(e, xi);
  const float pdf = kPlanted == 2u ? 1.0 / e.theta : equiangularPdf(e, t);
  outputs.at[i] = vec4(t, pdf, e.distance, e.delta);
}

// SPDX-License-Identifier: Apache-2.0
// Lambert's reflector on the side of wo, whichever it is: f = colour / pi.
#ifndef TYNDALL_MATERIAL_DIFFUSE_GLSL
#define TYNDALL_MATERIAL_DIFFUSE_GLSL

#include "material/types.glsl"

bool diffuseIsDelta(Bsdf b) { return false; }

/// (f |cos wi|, pdf)
vec4 diffuseEvalPdf(Bsdf b, vec3 wo, vec3 wi) {
  const float side = wo.z < 0.0 ? -1.0 : 1.0;
  if (abs(wo.z) < kLeastCosine || wi.z * side < kLeastCosine) {
    return vec4(0.0);
  }
  return vec4(b.colour, 1.0) * cosineHemispherePdf(abs(wi.z));
}

BsdfSample diffuseSample(Bsdf b, vec3 wo, inout Rng rng) {
  BsdfSample s = bsdfAbsorbed();
  const vec3 up = cosineHemisphereSample(rngFloat2(rng));
  s.wi = wo.z < 0.0 ? vec3(up.xy, -up.z) : up;
  s.weight = b.colour;
  s.pdf = cosineHemispherePdf(up.z);
  s.valid = abs(wo.z) >= kLeastCosine && up.z >= kLeastCosine;
  return s;
}

#endif

// SPDX-License-Identifier: Apache-2.0
// A material at one point of a surface, and one draw of it. Directions wo and wi are unit, in a local frame whose z
// axis is the shading normal, and both point away from the surface: wo to where the path comes from (the camera), wi to
// where it goes on (the light).
#ifndef TYNDALL_MATERIAL_TYPES_GLSL
#define TYNDALL_MATERIAL_TYPES_GLSL

#include "core/numerics.glsl"
#include "core/rng.glsl"
#include "core/warp.glsl"
#include "material/list.h"

struct Bsdf {
  uint model;     // kMaterial* of material/list.h
  vec3 colour;    // as interop/material.h, [0, 1]
  vec3 eta;       // conductor, where k is not 0
  vec3 k;         // conductor
  float alpha;    // GGX, roughness^2, [0, 1]; below kLeastAlpha a delta (metal-rough: kLeastAlpha)
  float metallic; // metal-rough, [0, 1]
  float etaRatio; // dielectric: index of refraction on the side of -z over the one on the side of +z, > 0
  float coatF0;   // metal-rough: the coat's reflectance at normal incidence, ((ior - 1) / (ior + 1))^2
};

struct BsdfSample {
  vec3 wi;
  vec3 weight; // f |cos wi| / pdf
  float pdf;   // [1/sr]; 0 if delta
  bool delta;
  bool transmitted; // wi is on the other side than wo
  bool valid;       // else the path ends here: absorbed, or lost between microfacets
};

/// A direction's float components are off by 6e-8, so a half vector's slope is, and a lobe of width alpha is known to
/// 2e-7 / alpha: 0.2 % at 1e-4, which is 0.006 degrees, less than the sun's disc by 90. Narrower lobes are mirrors.
const float kLeastAlpha = 1e-4;
/// Cosines below this are tangent: nothing is reflected or refracted. Float directions tell no more.
const float kLeastCosine = 1e-6;
BsdfSample bsdfAbsorbed() { return BsdfSample(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, false, false, false); }

#endif

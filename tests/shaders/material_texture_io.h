// SPDX-License-Identifier: Apache-2.0
// What the probe of material/texture.glsl, resolve.glsl and normal.glsl reads and writes.
#ifndef TYNDALL_TESTS_TEXTURE_IO_H
#define TYNDALL_TESTS_TEXTURE_IO_H

#include "interop/basic.h"
#include "interop/material.h"

GPU_BEGIN

GPU_CONST uint kProbeLookup = 0;  // `use` at uv: colour, opacity = R, G, B, A
GPU_CONST uint kProbeResolve = 1; // the material `index` at uv
GPU_CONST uint kProbeNormal = 2;  // perturbNormal: into `normal`

struct TextureQuery {
  TextureUse use;
  vec2 uv;
  uint index;
  vec3 tangent;
  vec3 bitangent;
  vec3 shadingNormal;
  vec3 geometricNormal;
  vec3 normalTangent;
  vec3 wo;
};
GPU_BUFFER(TextureQuery)

struct TextureAnswer {
  vec3 colour;
  float opacity;
  float alpha;
  float metallic;
  float etaRatio;
  float coatF0;
  vec3 eta;
  vec3 k;
  uint model;
  vec3 normal;
  vec3 emission;
  float opacityAlone; // materialOpacity
  vec3 emissionAlone; // materialEmission
};
GPU_BUFFER(TextureAnswer)

GPU_END
#endif

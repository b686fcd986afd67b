// SPDX-License-Identifier: Apache-2.0
// What surfaces are made of. A material belongs to a surface together with what lies behind it (its interior).
#ifndef TYNDALL_INTEROP_MATERIAL_H
#define TYNDALL_INTEROP_MATERIAL_H

#include "interop/basic.h"
#include "material/list.h"

GPU_BEGIN

GPU_CONST uint kNoTexture = 0xffffffffu;
GPU_CONST uint kNoInterior = 0xffffffffu;
GPU_CONST uint kMaxInteriors = 32; // bits of the mask of interiors that a ray is in

GPU_CONST uint kWrapRepeat = 0;
GPU_CONST uint kWrapClamp = 1;
GPU_CONST uint kWrapMirror = 2;

// 8-bit RGBA texels, rows from the top (v = 0) down; bilinear between texel centres.
struct Texture {
  GPU_PTR(uint) texels;
  uvec2 size;
  uint wrapU;        // kWrap*
  uint wrapV;
  uint srgb;         // 1: R, G, B are decoded from sRGB before filtering
  uint nearest;      // 1: no filtering
};
GPU_BUFFER(Texture)

// A texture as a material reads it: KHR_texture_transform is in the two rows, (u', v') = rows * (u, v, 1).
struct TextureUse {
  uint texture;      // index, or kNoTexture
  vec3 rowU;
  vec3 rowV;
};

GPU_CONST uint kMaterialTwoSided = 1u;  // emits on both sides; else on the side of the geometric normal
GPU_CONST uint kMaterialAlphaMask = 2u; // alpha below alphaCutoff is a hole, else a solid
GPU_CONST uint kMaterialAlphaBlend = 4u; // a ray passes with probability 1 - alpha

struct Material {
  uint model;        // kMaterial* of material/list.h
  uint flags;        // kMaterial*
  vec3 colour;       // diffuse: albedo; conductor: reflectance at normal incidence; metal-rough: base colour;
                     // dielectric: tint of what is transmitted, [0, 1]
  vec3 eta;          // conductor: index of refraction relative to vacuum, where k is not 0
  vec3 k;            // conductor: extinction coefficient; 0 0 0: Schlick's formula from `colour` instead
  float roughness;   // perceptual, [0, 1]: GGX alpha = roughness^2; 0 = a perfect mirror or glass
  float metallic;    // metal-rough, [0, 1]
  float ior;         // dielectric and metal-rough's coat, > 0
  float alpha;       // opacity, [0, 1]
  float alphaCutoff;
  vec3 emission;     // radiance [W/(m2 sr)]
  float normalScale; // of the normal map
  uint interior;     // index into Surfaces::interiors, or kNoInterior
  TextureUse colourTexture;     // R, G, B times colour, A times alpha
  TextureUse metalRoughTexture; // G times roughness, B times metallic
  TextureUse normalTexture;     // tangent space, y up
  TextureUse emissionTexture;
};
GPU_BUFFER(Material)

// What fills a closed surface. Bits in a mask say which interiors a point lies in.
struct Interior {
  uint medium;       // index into Scene::media, or kNoMedium: nothing that scatters or absorbs
  float ior;         // > 0, or kNotRefracting: its boundary bends nothing and has no priority
  uint priority;     // where refracting interiors overlap, the highest one decides the index of refraction
};
GPU_BUFFER(Interior)
GPU_CONST float kNotRefracting = 0.0f;
GPU_CONST uint kNoMedium = 0xffffffffu;

GPU_END
#endif

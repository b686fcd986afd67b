// SPDX-License-Identifier: Apache-2.0
// From a material in memory to its values at one point of a surface: textures applied, roughness squared.
// The includer declares `const bool kTextures`, usually a specialization constant: without textures in the scene, no
// lookup has code.
#ifndef TYNDALL_MATERIAL_RESOLVE_GLSL
#define TYNDALL_MATERIAL_RESOLVE_GLSL

#include "material/texture.glsl"
#include "material/types.glsl"

struct ResolvedMaterial {
  Bsdf bsdf;
  vec3 normal;   // unit, tangent space, for perturbNormal; (0, 0, 1) without a normal map
  float opacity; // probability that the surface is there for a ray: 1 unless the material masks or blends
  vec3 emission; // radiance [W/(m2 sr)], on the sides that the material's flags say
};

/// From alpha with its texture.
float opacityOf(uint flags, float alpha, float alphaCutoff) {
  if ((flags & kMaterialAlphaMask) != 0u) {
    return alpha < alphaCutoff ? 0.0 : 1.0;
  }
  return (flags & kMaterialAlphaBlend) != 0u ? clamp(alpha, 0.0, 1.0) : 1.0;
}

/// ResolvedMaterial::opacity alone, for shadow rays.
float materialOpacity(MaterialPtr materials, uint index, TexturePtr textures, vec2 uv) {
  const uint flags = materials.at[index].flags;
  if ((flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0u) {
    return 1.0;
  }
  float alpha = materials.at[index].alpha;
  if (kTextures && materials.at[index].colourTexture.texture != kNoTexture) {
    alpha *= textureLookup(textures, materials.at[index].colourTexture, uv).a;
  }
  return opacityOf(flags, alpha, materials.at[index].alphaCutoff);
}

/// ResolvedMaterial::emission alone, for points on a light. [W/(m2 sr)]
vec3 materialEmission(MaterialPtr materials, uint index, TexturePtr textures, vec2 uv) {
  const vec3 emission = materials.at[index].emission;
  if (kTextures && materials.at[index].emissionTexture.texture != kNoTexture) {
    return emission * textureLookup(textures, materials.at[index].emissionTexture, uv).rgb;
  }
  return emission;
}

/// A normal map's texel as a unit vector.
vec3 mappedNormal(vec3 texel, float scale) {
  const vec3 normal = (2.0 * texel - 1.0) * vec3(scale, scale, 1.0);
  const float squared = dot(normal, normal);
  return squared > 1e-12 ? normal * inversesqrt(squared) : vec3(0.0, 0.0, 1.0);
}

/// `etaRatio` as Bsdf has it; the caller knows which interiors the surface parts.
ResolvedMaterial resolveMaterial(MaterialPtr materials, uint index, TexturePtr textures, vec2 uv, float etaRatio) {
  vec4 colour = vec4(materials.at[index].colour, materials.at[index].alpha);
  float roughness = materials.at[index].roughness;
  float metallic = materials.at[index].metallic;
  vec3 normal = vec3(0.0, 0.0, 1.0);
  vec3 emission = materials.at[index].emission;
  if (kTextures) {
    // One lookup in a loop instead of four: a quarter of the code.
    for (uint slot = 0u; slot < 4u; ++slot) {
      TextureUse use;
      switch (slot) {
      case 0u:
        use = materials.at[index].colourTexture;
        break;
      case 1u:
        use = materials.at[index].metalRoughTexture;
        break;
      case 2u:
        use = materials.at[index].normalTexture;
        break;
      default:
        use = materials.at[index].emissionTexture;
        break;
      }
      if (use.texture != kNoTexture) {
        const vec4 value = textureLookup(textures, use, uv);
        switch (slot) {
        case 0u:
          colour *= value;
          break;
        case 1u:
          roughness *= value.g;
          metallic *= value.b;
          break;
        case 2u:
          normal = mappedNormal(value.rgb, materials.at[index].normalScale);
          break;
        default:
          emission *= value.rgb;
          break;
        }
      }
    }
  }
  const float ior = materials.at[index].ior;
  const float coat = (ior - 1.0) / (ior + 1.0);
  const Bsdf bsdf = Bsdf(materials.at[index].model, colour.rgb, materials.at[index].eta, materials.at[index].k,
                         roughness * roughness, metallic, etaRatio, coat * coat);
  const float opacity = opacityOf(materials.at[index].flags, colour.a, materials.at[index].alphaCutoff);
  return ResolvedMaterial(bsdf, normal, opacity, emission);
}

#endif

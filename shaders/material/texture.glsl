// SPDX-License-Identifier: Apache-2.0
// Texture lookups without samplers: a texture is an address, so that any number of them costs no descriptors, and
// filtering has float weights, where a sampler's may have 8 bits.
#ifndef TYNDALL_MATERIAL_TEXTURE_GLSL
#define TYNDALL_MATERIAL_TEXTURE_GLSL

#include "core/numerics.glsl"
#include "interop/basic.h"
#include "interop/material.h"

/// Linear from sRGB's encoding [IEC99], [0, 1]; relative error <= 1e-6. t^2.4 = t^2 (t^(1/4))^1.6, whose last factor
/// is a polynomial over the range needed: Vulkan's pow has the error of its logarithm.
vec3 srgbDecoded(vec3 encoded) {
  const vec3 t = (encoded + 0.055) / 1.055;
  const vec3 s = sqrt(sqrt(t));
  const vec3 power =
      -0.0143217282 + s * (0.256391205 + s * (1.02339847 + s * (-0.385560768 + s * (0.146980648 + s * -0.0268878919))));
  return mix(t * t * power, encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
}

/// A coordinate as one in [0, 1]; 0 where it is not finite.
float wrapped(float x, uint wrap) {
  if (!isFinite(x)) {
    return 0.0;
  }
  float inside = x;
  if (wrap == kWrapRepeat) {
    inside = x - floor(x);
  } else if (wrap == kWrapMirror) {
    inside = 1.0 - abs(1.0 - (x - 2.0 * floor(0.5 * x)));
  }
  return clamp(inside, 0.0, 1.0);
}

/// The two texels about `place` in [0, size] of one axis, and the weight of the second.
uvec2 texelsAbout(float place, uint size, uint wrap, out float weight) {
  const int last = int(size) - 1;
  const float low = floor(place - 0.5);
  weight = place - 0.5 - low;
  ivec2 pair = ivec2(int(low), int(low) + 1);
  if (wrap == kWrapRepeat) {
    pair = ivec2(pair.x < 0 ? last : pair.x, pair.y > last ? 0 : pair.y);
  }
  return uvec2(clamp(pair, 0, last));
}

vec4 texelDecoded(uint texel, bool srgb) {
  const vec4 value = unpackUnorm4x8(texel);
  return srgb ? vec4(srgbDecoded(value.rgb), value.a) : value;
}

/// The texture's value at (u, v), transformed as `use` says; sRGB texels are decoded before they are filtered. Whatever
/// uv is, a texel of the texture is read. `use.texture` is an index into `textures`, not kNoTexture.
vec4 textureLookup(TexturePtr textures, TextureUse use, vec2 uv) {
  const uvec2 size = textures.at[use.texture].size;
  const uvec2 wrap = uvec2(textures.at[use.texture].wrapU, textures.at[use.texture].wrapV);
  const bool srgb = textures.at[use.texture].srgb != 0u;
  uintPtr texels = textures.at[use.texture].texels;
  const vec3 homogeneous = vec3(uv, 1.0);
  const vec2 place = vec2(wrapped(dot(use.rowU, homogeneous), wrap.x), wrapped(dot(use.rowV, homogeneous), wrap.y));
  vec2 weight;
  const uvec2 columns = texelsAbout(place.x * float(size.x), size.x, wrap.x, weight.x);
  const uvec2 rows = texelsAbout(place.y * float(size.y), size.y, wrap.y, weight.y) * size.x;
  if (textures.at[use.texture].nearest != 0u) {
    weight = step(0.5, weight);
  }
  const vec4 top = mix(texelDecoded(texels.at[rows.x + columns.x], srgb),
                       texelDecoded(texels.at[rows.x + columns.y], srgb), weight.x);
  const vec4 bottom = mix(texelDecoded(texels.at[rows.y + columns.x], srgb),
                          texelDecoded(texels.at[rows.y + columns.y], srgb), weight.x);
  return mix(top, bottom, weight.y);
}

#endif

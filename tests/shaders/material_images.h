// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/material_texture_io.h"

#include <vector>

namespace tyndall::test {

/// A texture and its texels on the host.
struct Image {
  glm::uvec2 size{1};
  std::vector<std::uint32_t> texels{};
  std::uint32_t wrapU = interop::kWrapRepeat;
  std::uint32_t wrapV = interop::kWrapRepeat;
  bool srgb = false;
  bool nearest = false;
};

/// R lowest.
std::uint32_t packedTexel(const glm::uvec4& bytes);
/// Bytes in [lowest, highest].
Image randomImage(const glm::uvec2& size, unsigned seed, std::uint32_t lowest = 0, std::uint32_t highest = 255);

/// The probe's answers; `mode` of material_texture_io.h, kTextures = `textures`.
std::vector<interop::TextureAnswer> askTextures(const std::vector<interop::TextureQuery>& queries, std::uint32_t mode,
                                                const std::vector<Image>& images,
                                                const std::vector<interop::Material>& materials = {},
                                                bool textures = true);

/// IEC 61966-2-1
double srgbToLinear(double encoded);
/// What a lookup must give, in double and by the definition of filters and wrap modes.
glm::dvec4 oracleLookup(const Image& image, const interop::TextureUse& use, const glm::dvec2& uv);

inline constexpr interop::TextureUse kPlain{0, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
/// Turned, scaled and moved, as KHR_texture_transform does.
inline constexpr interop::TextureUse kTurned{0, {1.4f, -0.7f, 0.3f}, {0.6f, 1.1f, -0.45f}};

interop::TextureQuery lookupQuery(const interop::TextureUse& use, const glm::vec2& uv);
/// u and v uniform in [-span, span).
std::vector<interop::TextureQuery> randomPlaces(const interop::TextureUse& use, double span, std::size_t count);

} // namespace tyndall::test

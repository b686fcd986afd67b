// SPDX-License-Identifier: Apache-2.0
#include "support/probe.h"

// Needs <cstdint> before it.
#include "kernels/material_texture_probe.h"
#include "shaders/material_images.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace tyndall::test {
namespace {

/// A texel's index anywhere on the axis, by the definition of the wrap modes.
int wrappedIndex(int i, int size, std::uint32_t wrap) {
  const auto modulo = [](int a, int n) { return (a % n + n) % n; };
  if (wrap == interop::kWrapClamp) {
    return std::clamp(i, 0, size - 1);
  }
  if (wrap == interop::kWrapRepeat) {
    return modulo(i, size);
  }
  const int folded = modulo(i, 2 * size);
  return folded < size ? folded : 2 * size - 1 - folded;
}

} // namespace

using interop::TextureAnswer;
using interop::TextureQuery;
using interop::TextureUse;

std::uint32_t packedTexel(const glm::uvec4& bytes) { return bytes.x | bytes.y << 8 | bytes.z << 16 | bytes.w << 24; }

Image randomImage(const glm::uvec2& size, unsigned seed, std::uint32_t lowest, std::uint32_t highest) {
  std::mt19937 engine(seed);
  std::uniform_int_distribution<std::uint32_t> byte(lowest, highest);
  Image image{.size = size};
  for (unsigned i = 0; i < size.x * size.y; ++i) {
    image.texels.push_back(packedTexel({byte(engine), byte(engine), byte(engine), byte(engine)}));
  }
  return image;
}

std::vector<TextureAnswer> askTextures(const std::vector<TextureQuery>& queries, std::uint32_t mode,
                                       const std::vector<Image>& images,
                                       const std::vector<interop::Material>& materials, bool textures) {
  struct Push {
    interop::Ptr<TextureQuery> queries;
    interop::Ptr<TextureAnswer> answers;
    interop::Ptr<interop::Texture> textures;
    interop::Ptr<interop::Material> materials;
    std::uint32_t count;
  };
  std::vector<gpu::Buffer<std::uint32_t>> texels;
  std::vector<interop::Texture> described;
  for (const Image& image : images) {
    texels.push_back(ProbeRunner::upload(image.texels));
    described.push_back({{texels.back().ptr().address},
                         image.size,
                         image.wrapU,
                         image.wrapV,
                         image.srgb ? 1u : 0u,
                         image.nearest ? 1u : 0u});
  }
  described.resize(std::max<std::size_t>(described.size(), 1));
  std::vector<interop::Material> listed = materials;
  listed.resize(std::max<std::size_t>(listed.size(), 1));
  const std::uint32_t count = static_cast<std::uint32_t>(queries.size());
  const auto in = ProbeRunner::upload(queries);
  const auto out = ProbeRunner::results<TextureAnswer>(count);
  const auto textureBuffer = ProbeRunner::upload(described);
  const auto materialBuffer = ProbeRunner::upload(listed);
  const ProbeRunner probe(k_material_texture_probe_spirv, {{0, mode}, {1, gpu::specBits(textures)}});
  probe.run(Push{in.ptr(), out.ptr(), textureBuffer.ptr(), materialBuffer.ptr(), count}, count);
  return ProbeRunner::download(out);
}

double srgbToLinear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

glm::dvec4 oracleLookup(const Image& image, const TextureUse& use, const glm::dvec2& uv) {
  const glm::dvec3 homogeneous(uv, 1.0);
  const glm::dvec2 place =
      glm::dvec2(glm::dot(glm::dvec3(use.rowU), homogeneous), glm::dot(glm::dvec3(use.rowV), homogeneous)) *
      glm::dvec2(image.size);
  const auto texel = [&](int column, int row) {
    const int x = wrappedIndex(column, static_cast<int>(image.size.x), image.wrapU);
    const int y = wrappedIndex(row, static_cast<int>(image.size.y), image.wrapV);
    const std::uint32_t bits = image.texels[static_cast<std::size_t>(y) * image.size.x + static_cast<std::size_t>(x)];
    glm::dvec4 value;
    for (int c = 0; c < 4; ++c) {
      const double encoded = static_cast<double>(bits >> (8 * c) & 255u) / 255.0;
      value[c] = image.srgb && c < 3 ? srgbToLinear(encoded) : encoded;
    }
    return value;
  };
  if (image.nearest) {
    return texel(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
  }
  glm::dvec4 sum(0.0);
  const glm::dvec2 low = glm::floor(place - 0.5);
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec2 at = low + glm::dvec2(corner & 1, corner >> 1);
    const glm::dvec2 weight = 1.0 - glm::abs(place - 0.5 - at);
    sum += weight.x * weight.y * texel(static_cast<int>(at.x), static_cast<int>(at.y));
  }
  return sum;
}

TextureQuery lookupQuery(const TextureUse& use, const glm::vec2& uv) {
  TextureQuery query{};
  query.use = use;
  query.uv = uv;
  return query;
}

std::vector<TextureQuery> randomPlaces(const TextureUse& use, double span, std::size_t count) {
  std::mt19937 engine(23);
  std::uniform_real_distribution<float> uniform(-static_cast<float>(span), static_cast<float>(span));
  std::vector<TextureQuery> queries(count);
  for (TextureQuery& query : queries) {
    query.use = use;
    query.uv = {uniform(engine), uniform(engine)};
  }
  return queries;
}

} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// Materials with their textures, and shading normals.
#include "shaders/material_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tyndall::test {
namespace {

using interop::TextureAnswer;
using interop::TextureQuery;
using interop::TextureUse;

interop::Material texturedMaterial() {
  interop::Material m{};
  m.model = 4;
  m.flags = interop::kMaterialAlphaBlend;
  m.colour = {0.9f, 0.8f, 0.7f};
  m.eta = {0.1f, 0.2f, 0.3f};
  m.k = {3.0f, 2.0f, 1.0f};
  m.roughness = 0.8f;
  m.metallic = 0.6f;
  m.ior = 1.4f;
  m.alpha = 0.9f;
  m.alphaCutoff = 0.5f;
  m.emission = {10.0f, 20.0f, 30.0f};
  m.normalScale = 0.7f;
  m.colourTexture = {0, kPlain.rowU, kPlain.rowV};
  m.metalRoughTexture = {1, kTurned.rowU, kTurned.rowV};
  m.normalTexture = {2, kPlain.rowU, kPlain.rowV};
  m.emissionTexture = {3, kTurned.rowU, kTurned.rowV};
  return m;
}

double distanceOf(const glm::vec3& a, const glm::dvec3& b) { return glm::distance(glm::dvec3(a), b); }

/// The largest error of a resolved material against the definition, over places.
double resolveError(const interop::Material& shown, const interop::Material& meant, bool textures) {
  std::vector<Image> images{randomImage({8, 8}, 1), randomImage({5, 7}, 2), randomImage({8, 8}, 3, 90, 255),
                            randomImage({3, 3}, 4)};
  images[0].srgb = images[3].srgb = true;
  const std::vector<TextureQuery> queries = randomPlaces(kPlain, 2.0, 2000);
  const std::vector<TextureAnswer> answers = askTextures(queries, interop::kProbeResolve, images, {shown}, textures);
  double worst = 0.0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto value = [&](const TextureUse& use, const glm::dvec4& without) {
      return textures && use.texture != interop::kNoTexture
                 ? oracleLookup(images[use.texture], use, glm::dvec2(queries[i].uv))
                 : without;
    };
    const glm::dvec4 colour = value(meant.colourTexture, glm::dvec4(1.0));
    const glm::dvec4 metalRough = value(meant.metalRoughTexture, glm::dvec4(1.0));
    const double scale = static_cast<double>(meant.normalScale);
    const glm::dvec3 normal = (2.0 * glm::dvec3(value(meant.normalTexture, glm::dvec4(0.5, 0.5, 1.0, 1.0))) - 1.0) *
                              glm::dvec3(scale, scale, 1.0);
    const glm::dvec3 emission = glm::dvec3(meant.emission) * glm::dvec3(value(meant.emissionTexture, glm::dvec4(1.0)));
    const double alpha = static_cast<double>(meant.alpha) * colour.w;
    const bool masked = (meant.flags & interop::kMaterialAlphaMask) != 0;
    const bool blended = (meant.flags & interop::kMaterialAlphaBlend) != 0;
    const double cutoff = static_cast<double>(meant.alphaCutoff);
    const double opacity = masked ? (alpha < cutoff ? 0.0 : 1.0) : blended ? alpha : 1.0;
    const TextureAnswer& a = answers[i];
    if (!masked || std::abs(alpha - cutoff) > 1e-4) {
      worst = std::max({worst, std::abs(static_cast<double>(a.opacity) - opacity),
                        std::abs(static_cast<double>(a.opacityAlone) - opacity)});
    }
    const double coat = (static_cast<double>(meant.ior) - 1.0) / (static_cast<double>(meant.ior) + 1.0);
    worst = std::max(
        {worst, distanceOf(a.colour, glm::dvec3(meant.colour) * glm::dvec3(colour)),
         std::abs(static_cast<double>(a.alpha) - std::pow(static_cast<double>(meant.roughness) * metalRough.y, 2.0)),
         std::abs(static_cast<double>(a.metallic) - static_cast<double>(meant.metallic) * metalRough.z),
         std::abs(static_cast<double>(a.coatF0) - coat * coat), std::abs(static_cast<double>(a.etaRatio) - 1.25),
         distanceOf(a.normal, glm::normalize(normal)), distanceOf(a.emission, emission) / 30.0,
         distanceOf(a.emissionAlone, emission) / 30.0, distanceOf(a.eta, glm::dvec3(meant.eta)),
         distanceOf(a.k, glm::dvec3(meant.k)), a.model == meant.model ? 0.0 : 1.0});
  }
  return worst;
}

TEST(Textures, MaterialsAreResolvedAtAPoint) {
  constexpr double kTolerance = 5e-5; // coordinates of 4 in textures of 8 texels, times a normal's slope
  const interop::Material blended = texturedMaterial();
  interop::Material masked = blended;
  masked.flags = interop::kMaterialAlphaMask;
  interop::Material opaque = blended;
  opaque.flags = 0;
  interop::Material plain = blended;
  plain.normalTexture.texture = plain.colourTexture.texture = interop::kNoTexture;
  for (const interop::Material& material : {blended, masked, opaque, plain}) {
    EXPECT_LT(resolveError(material, material, true), kTolerance);
    EXPECT_LT(resolveError(material, material, false), kTolerance);
    EXPECT_GT(resolveError(material, opaque, true) + resolveError(material, masked, true), kTolerance);
  }
  EXPECT_GT(resolveError(plain, blended, true), kTolerance);
  interop::Material swapped = blended;
  std::swap(swapped.emissionTexture, swapped.metalRoughTexture);
  EXPECT_GT(resolveError(swapped, blended, true), kTolerance);
}

glm::vec3 randomDirection(std::mt19937& engine) {
  std::normal_distribution<double> normal;
  return glm::vec3(glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine))));
}

/// Queries whose shading normals lie up to 90 degrees and more off the geometric one.
std::vector<TextureQuery> normalQueries() {
  std::mt19937 engine(31);
  std::vector<TextureQuery> queries(20000);
  for (TextureQuery& query : queries) {
    query.geometricNormal = randomDirection(engine);
    query.shadingNormal = glm::normalize(query.geometricNormal + 0.7f * randomDirection(engine));
    query.tangent = glm::normalize(glm::cross(query.shadingNormal, randomDirection(engine)));
    query.bitangent = glm::cross(query.shadingNormal, query.tangent);
    query.normalTangent = glm::normalize(glm::vec3(0.0f, 0.0f, 1.0f) + 0.7f * randomDirection(engine));
    query.wo = randomDirection(engine);
  }
  queries[0].normalTangent = queries[1].shadingNormal = queries[1].tangent = queries[1].bitangent =
      glm::vec3(0.0f); // degenerate
  queries[2].wo = -queries[2].shadingNormal;
  queries[2].normalTangent = {0.0f, 0.0f, 1.0f};
  return queries;
}

TEST(ShadingNormals, FaceTheViewerWhereTheSurfaceDoes) {
  const std::vector<TextureQuery> queries = normalQueries();
  const auto wrong = [&](const std::vector<TextureQuery>& shown) {
    const std::vector<TextureAnswer> answers = askTextures(shown, interop::kProbeNormal, {});
    std::size_t count = 0;
    std::size_t pushed = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const TextureQuery& q = queries[i];
      const glm::dvec3 n(answers[i].normal);
      const double geometric = glm::dot(glm::dvec3(q.geometricNormal), glm::dvec3(q.wo));
      const double side = geometric < 0.0 ? -1.0 : 1.0;
      const double least = std::min(0.01, std::abs(geometric));
      const glm::dvec3 mapped =
          glm::dmat3(glm::dvec3(q.tangent), glm::dvec3(q.bitangent), glm::dvec3(q.shadingNormal)) *
          glm::dvec3(q.normalTangent);
      const glm::dvec3 ideal = glm::length(mapped) > 1e-10 ? glm::normalize(mapped) : glm::dvec3(q.geometricNormal);
      const double cosine = side * glm::dot(n, glm::dvec3(q.wo));
      const bool right = side * glm::dot(ideal, glm::dvec3(q.wo)) > least + 1e-6;
      pushed += right ? 0 : 1;
      const bool sound = std::abs(glm::length(n) - 1.0) < 1e-6 && cosine > 0.99 * least - 1e-6 &&
                         (!right || glm::distance(n, ideal) < 1e-5);
      count += sound ? 0 : 1;
    }
    EXPECT_GT(pushed, queries.size() / 20);
    return count;
  };
  EXPECT_EQ(wrong(queries), 0u);
  std::vector<TextureQuery> other = queries;
  for (TextureQuery& query : other) {
    query.geometricNormal = -query.geometricNormal;
  }
  EXPECT_GT(wrong(other), 1000u);
  other = queries;
  for (TextureQuery& query : other) {
    query.wo = query.shadingNormal; // nothing to push
  }
  EXPECT_GT(wrong(other), 100u);
}

} // namespace
} // namespace tyndall::test

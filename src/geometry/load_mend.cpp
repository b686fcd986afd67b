// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "geometry/load_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::geometry {
namespace {

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The device crosses the edges in float: what over- or underflows there has no normal.
bool hasArea(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]);
  const glm::dvec3 b(mesh.positions[t.y]);
  const glm::dvec3 c(mesh.positions[t.z]);
  const double doubled = glm::length(glm::cross(b - a, c - a));
  return doubled >= double{std::numeric_limits<float>::min()} && doubled <= double{std::numeric_limits<float>::max()};
}

bool canBeDrawn(const Mesh& mesh, const glm::uvec3& t, Mended& mended) {
  const std::size_t count = mesh.positions.size();
  if (t.x >= count || t.y >= count || t.z >= count) {
    ++mended.badIndices;
    return false;
  }
  if (!isFinite(mesh.positions[t.x]) || !isFinite(mesh.positions[t.y]) || !isFinite(mesh.positions[t.z])) {
    ++mended.badPositions;
    return false;
  }
  if (!hasArea(mesh, t)) {
    ++mended.noArea;
    return false;
  }
  return true;
}

void dropTriangles(Mesh& mesh, Mended& mended) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (canBeDrawn(mesh, mesh.triangles[i], mended)) {
      mesh.triangles[kept] = mesh.triangles[i];
      mesh.materials[kept] = mesh.materials[i];
      ++kept;
    }
  }
  mesh.triangles.resize(kept);
  mesh.materials.resize(kept);
}

void dropVertices(Mesh& mesh) {
  std::vector<std::uint32_t> place(mesh.positions.size(), kNone);
  for (const glm::uvec3& t : mesh.triangles) {
    place[t.x] = place[t.y] = place[t.z] = 0;
  }
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] != kNone) {
      place[i] = kept;
      mesh.positions[kept] = mesh.positions[i];
      if (!mesh.normals.empty()) {
        mesh.normals[kept] = mesh.normals[i];
      }
      if (!mesh.uvs.empty()) {
        mesh.uvs[kept] = mesh.uvs[i];
      }
      ++kept;
    }
  }
  mesh.positions.resize(kept);
  mesh.normals.resize(mesh.normals.empty() ? 0 : kept);
  mesh.uvs.resize(mesh.uvs.empty() ? 0 : kept);
  for (glm::uvec3& t : mesh.triangles) {
    t = {place[t.x], place[t.y], place[t.z]};
  }
}

void mendNormals(Mesh& mesh, Mended& mended) {
  for (glm::vec3& normal : mesh.normals) {
    const double length = glm::length(glm::dvec3(normal));
    if (normal == glm::vec3(0.0F)) {
      continue; // counted where it was read, or meant: the face's own
    }
    if (!std::isfinite(length)) {
      ++mended.badNormals;
      normal = glm::vec3(0.0F);
      continue;
    }
    mended.longNormals += std::abs(length - 1.0) > 0.01;
    normal = glm::vec3(glm::dvec3(normal) / length);
  }
}

bool clampTo(double& value, double low, double high) {
  const double before = value;
  value = std::isnan(value) ? low : std::clamp(value, low, high);
  return !(before == value);
}

bool clampTo(glm::dvec3& value, double low, double high) {
  const bool x = clampTo(value.x, low, high);
  const bool y = clampTo(value.y, low, high);
  const bool z = clampTo(value.z, low, high);
  return x || y || z;
}

bool clampUse(TextureUse& use) {
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    worst = std::max({worst, std::abs(use.rowU[i]), std::abs(use.rowV[i])});
  }
  if (std::isfinite(worst) && worst <= 1e6) {
    return false;
  }
  use.rowU = {1.0, 0.0, 0.0};
  use.rowV = {0.0, 1.0, 0.0};
  return true;
}

} // namespace

void makeSound(Mesh& mesh, Mended& mended) {
  dropTriangles(mesh, mended);
  dropVertices(mesh);
  mendNormals(mesh, mended);
  for (glm::vec2& uv : mesh.uvs) {
    // Beyond 2^20 a float has no digits left for the place within the texture.
    if (!(std::abs(uv.x) <= 1048576.0F && std::abs(uv.y) <= 1048576.0F)) {
      ++mended.badUvs;
      uv = glm::vec2(0.0F);
    }
  }
}

Mesh baked(const Mesh& mesh, const glm::dmat4& targetFromSource) {
  Mesh flat = mesh;
  flat.normals.clear();
  for (glm::vec3& position : flat.positions) {
    position = glm::vec3(glm::dvec3(targetFromSource * glm::dvec4(glm::dvec3(position), 1.0)));
  }
  return flat;
}

void clampMaterial(Material& material, Mended& mended) {
  constexpr double kBrightest = 1e30; // float has room for sums of it
  bool changed = clampTo(material.colour, 0.0, 1.0);
  changed |= clampTo(material.roughness, 0.0, 1.0);
  changed |= clampTo(material.metallic, 0.0, 1.0);
  changed |= clampTo(material.opacity, 0.0, 1.0);
  changed |= clampTo(material.alphaCutoff, 0.0, 2.0); // above 1: nothing is left
  changed |= clampTo(material.emission, 0.0, kBrightest);
  changed |= clampTo(material.ior, 1.0, 10.0);
  changed |= clampTo(material.normalScale, -100.0, 100.0);
  for (TextureUse* use :
       {&material.colourTexture, &material.metalRoughTexture, &material.normalTexture, &material.emissionTexture}) {
    changed |= clampUse(*use);
  }
  mended.clampedMaterials += changed;
}

std::vector<std::string> Mended::sentences() const {
  std::vector<std::string> said;
  const auto say = [&said](std::size_t count, const char* one, const char* many) {
    if (count > 0) {
      said.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
    }
  };
  say(badIndices, "face that names a vertex that is not there was left out.",
      "faces that name vertices that are not there were left out.");
  say(badPositions, "triangle with a vertex that is NaN or infinite was left out.",
      "triangles with a vertex that is NaN or infinite were left out.");
  say(noArea, "triangle without area was left out.", "triangles without area were left out.");
  say(badNormals, "vertex normal that was zero, NaN or infinite gave way to that of its faces.",
      "vertex normals that were zero, NaN or infinite gave way to those of their faces.");
  say(longNormals, "vertex normal that was not of unit length was normalised.",
      "vertex normals that were not of unit length were normalised.");
  say(badUvs, "texture coordinate that was missing, NaN, infinite or beyond 2^20 was set to 0.",
      "texture coordinates that were missing, NaN, infinite or beyond 2^20 were set to 0.");
  say(fannedPolygons, "polygon that crosses itself or is too large was cut as a fan.",
      "polygons that cross themselves or are too large were cut as fans.");
  say(clampedMaterials, "material with values out of range was clamped to it.",
      "materials with values out of range were clamped to it.");
  return said;
}

std::uint32_t Untextured::of(std::uint32_t material) {
  if (material == kNone) {
    return kNone;
  }
  Material copy = model_.materials[material];
  bool textured = false;
  for (TextureUse* use : {&copy.colourTexture, &copy.metalRoughTexture, &copy.normalTexture, &copy.emissionTexture}) {
    textured |= use->texture != kNone;
    *use = {};
  }
  if (!textured) {
    return material;
  }
  const auto [place, isNew] = copies_.try_emplace(material, static_cast<std::uint32_t>(model_.materials.size()));
  if (isNew) {
    model_.warnings.push_back(fmt::format(
        "Material \"{}\" has textures, but some triangles with it have no texture coordinates: they go without.",
        copy.name));
    model_.materials.push_back(std::move(copy));
  }
  return place->second;
}

} // namespace tyndall::geometry

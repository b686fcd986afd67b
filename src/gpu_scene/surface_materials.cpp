// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/surface_materials.h"

#include "base/error.h"
#include "math/colour.h"

#include <algorithm>
#include <cmath>

namespace tyndall::gpu_scene {
namespace {

using geometry::Material;

const Material kDefaultMaterial{};

bool refracts(const Material& material) { return material.model == MaterialId::Dielectric; }

std::uint32_t flagsOf(const Material& material) {
  std::uint32_t flags = material.twoSided ? interop::kMaterialTwoSided : 0u;
  if (material.alpha == geometry::Alpha::Mask) {
    flags |= interop::kMaterialAlphaMask;
  }
  if (material.alpha == geometry::Alpha::Blend ||
      (material.alpha == geometry::Alpha::Opaque && material.opacity < 1.0)) {
    flags |= interop::kMaterialAlphaBlend;
  }
  return flags;
}

double linearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace

SurfaceMaterials::SurfaceMaterials(const scene::Scene& scene, const MeshSet& meshes,
                                   const std::vector<std::uint32_t>& mediumIndex, PackedSurfaces& out)
    : scene_(scene), meshes_(meshes), mediumIndex_(mediumIndex), out_(out) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    object_ = i;
    const geometry::Model* file = model();
    const bool any = !ownMaterial().empty() || file == nullptr
                         ? refracts(source(geometry::kNone))
                         : std::any_of(file->materials.begin(), file->materials.end(), refracts);
    refracting_ += any ? 1 : 0;
  }
}

const geometry::Model* SurfaceMaterials::model() const {
  return meshes_.uses[object_] ? &meshes_.models[*meshes_.uses[object_]] : nullptr;
}

const Material& SurfaceMaterials::source(std::uint32_t fileMaterial) const {
  if (!ownMaterial().empty()) {
    const auto found = std::find_if(scene_.materials.begin(), scene_.materials.end(),
                                    [&](const Material& material) { return material.name == ownMaterial(); });
    TYNDALL_CHECK(found != scene_.materials.end());
    return *found;
  }
  return fileMaterial == geometry::kNone ? kDefaultMaterial : model()->materials[fileMaterial];
}

void SurfaceMaterials::begin(std::size_t object) {
  object_ = object;
  interior_ = interop::kNoInterior;
  const scene::Object& described = scene_.objects[object];
  std::uint32_t medium = interop::kNoMedium;
  for (std::size_t i = 0; i < scene_.media.size() && !described.medium.empty(); ++i) {
    medium = scene_.media[i].name == described.medium ? mediumIndex_[i] : medium;
  }
  const Material* glass = nullptr;
  if (!ownMaterial().empty() || model() == nullptr) {
    glass = refracts(source(geometry::kNone)) ? &source(geometry::kNone) : nullptr;
  } else {
    const auto found = std::find_if(model()->materials.begin(), model()->materials.end(), refracts);
    glass = found != model()->materials.end() ? &*found : nullptr;
  }
  const bool closed = described.kind != scene::Object::Kind::Quad;
  if (closed && (medium != interop::kNoMedium || glass != nullptr)) {
    if (out_.interiors.size() >= interop::kMaxInteriors) {
      fail("objects.{}: more than {} objects are filled with a medium or refract; fill fewer, or join their meshes",
           object, interop::kMaxInteriors);
    }
    interior_ = static_cast<std::uint32_t>(out_.interiors.size());
    out_.interiors.push_back(
        {medium, glass != nullptr ? static_cast<float>(glass->ior) : interop::kNotRefracting, described.priority});
  }
}

std::uint32_t SurfaceMaterials::device(std::uint32_t fileMaterial) {
  const Material& material = source(fileMaterial);
  const auto [entry, isNew] = made_.try_emplace({&material, interior_}, 0u);
  if (isNew) {
    entry->second = make(material);
  }
  return entry->second;
}

std::uint32_t SurfaceMaterials::make(const Material& material) {
  interop::Material made{};
  made.model = static_cast<std::uint32_t>(material.model);
  made.flags = flagsOf(material);
  made.colour = material.colour;
  made.eta = material.eta;
  made.k = material.k;
  made.roughness = static_cast<float>(material.roughness);
  made.metallic = static_cast<float>(material.metallic);
  made.ior = static_cast<float>(material.ior);
  made.alpha = static_cast<float>(material.opacity);
  made.alphaCutoff = static_cast<float>(material.alphaCutoff);
  made.emission = material.emission;
  made.normalScale = static_cast<float>(material.normalScale);
  made.interior = interior_;
  made.colourTexture = packUse(material.colourTexture);
  made.metalRoughTexture = packUse(material.metalRoughTexture);
  made.normalTexture = packUse(material.normalTexture);
  made.emissionTexture = packUse(material.emissionTexture);
  out_.materialMask |= 1u << made.model;
  out_.materials.push_back(made);
  const bool shines = luminance(material.emission) > 0.0;
  emissionScale_.push_back(shines ? static_cast<float>(meanOf(material.emissionTexture)) : 0.0f);
  const auto index = static_cast<std::uint32_t>(out_.materials.size() - 1);
  out_.passing |= !opaque(index);
  return index;
}

interop::TextureUse SurfaceMaterials::packUse(const geometry::TextureUse& use) {
  interop::TextureUse packed{interop::kNoTexture, glm::vec3(use.rowU), glm::vec3(use.rowV)};
  if (use.texture == geometry::kNone) {
    return packed;
  }
  const geometry::Texture* texture = &model()->textures[use.texture];
  const auto [entry, isNew] = textures_.try_emplace(texture, static_cast<std::uint32_t>(out_.textures.size()));
  if (isNew) {
    out_.textures.push_back(texture);
  }
  packed.texture = entry->second;
  out_.textured = true;
  return packed;
}

/// A guess for choosing lights; never 0 where a texel shines.
double SurfaceMaterials::meanOf(const geometry::TextureUse& use) const {
  if (use.texture == geometry::kNone) {
    return 1.0;
  }
  const geometry::Texture& texture = model()->textures[use.texture];
  double sum = 0.0;
  for (const std::uint32_t texel : texture.texels) {
    const glm::dvec3 encoded = glm::dvec3(texel & 255u, (texel >> 8) & 255u, (texel >> 16) & 255u) / 255.0;
    sum += luminance(glm::dvec3(linearFromSrgb(encoded.x), linearFromSrgb(encoded.y), linearFromSrgb(encoded.z)));
  }
  return sum / std::max<double>(1.0, double(texture.texels.size()));
}

bool SurfaceMaterials::emits(const geometry::Mesh& mesh, const geometry::Model* file) const {
  const auto shines = [](const Material& material) { return luminance(material.emission) > 0.0; };
  if (!ownMaterial().empty() || file == nullptr) {
    return shines(source(geometry::kNone));
  }
  return std::any_of(mesh.materials.begin(), mesh.materials.end(), [&](std::uint32_t material) {
    return material != geometry::kNone && shines(file->materials[material]);
  });
}

bool SurfaceMaterials::opaque(std::uint32_t deviceMaterial) const {
  const interop::Material& material = out_.materials[deviceMaterial];
  const bool overlapping = material.model == static_cast<std::uint32_t>(MaterialId::Dielectric) && refracting_ > 1;
  return material.model != static_cast<std::uint32_t>(MaterialId::Null) && !overlapping &&
         (material.flags & (interop::kMaterialAlphaMask | interop::kMaterialAlphaBlend)) == 0;
}

void SurfaceMaterials::finish() {
  if (out_.interiors.size() > 0 && refracting_ > 1) {
    // Inside another refracting object a boundary of lower priority is not there: shadow rays must pass it.
    out_.passing = true;
  }
}

} // namespace tyndall::gpu_scene

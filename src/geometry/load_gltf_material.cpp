// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "geometry/load_gltf_parts.h"

#include <cmath>

namespace tyndall::geometry {
namespace {

const tinygltf::Value* find(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found == extensions.end() || !found->second.IsObject() ? nullptr : &found->second;
}

glm::dvec2 pairOf(const tinygltf::Value& object, const char* key, const glm::dvec2& fallback) {
  if (!object.Has(key) || !object.Get(key).IsArray() || object.Get(key).ArrayLen() != 2 ||
      !object.Get(key).Get(0).IsNumber() || !object.Get(key).Get(1).IsNumber()) {
    return fallback;
  }
  return {object.Get(key).Get(0).GetNumberAsDouble(), object.Get(key).Get(1).GetNumberAsDouble()};
}

/// KHR_texture_transform: scale, then turn, then move. A turn is counter-clockwise as the picture is seen, with v
/// pointing down: the extension's own example (its lower left quarter) fixes the sign.
void setTransform(const tinygltf::Value& extension, TextureUse& use) {
  const glm::dvec2 offset = pairOf(extension, "offset", glm::dvec2(0.0));
  const glm::dvec2 scale = pairOf(extension, "scale", glm::dvec2(1.0));
  const double turn = numberOf(extension, "rotation", 0.0);
  use.rowU = {std::cos(turn) * scale.x, std::sin(turn) * scale.y, offset.x};
  use.rowV = {-std::sin(turn) * scale.x, std::cos(turn) * scale.y, offset.y};
}

Wrap wrapOf(int mode) {
  return mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::Clamp
         : mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::Mirror
                                                         : Wrap::Repeat;
}

glm::dvec3 colourOf(const std::vector<double>& values, const glm::dvec3& fallback) {
  return values.size() >= 3 ? glm::dvec3(values[0], values[1], values[2]) : fallback;
}

/// The bytes of an image: kept when it was parsed, or in a buffer view that is checked here.
std::string_view bytesOf(const tinygltf::Model& source, const tinygltf::Image& image) {
  if (image.bufferView < 0) {
    if (image.image.empty()) {
      fail("the file is missing or empty");
    }
    return {reinterpret_cast<const char*>(image.image.data()), image.image.size()};
  }
  const auto index = static_cast<std::size_t>(image.bufferView);
  if (index >= source.bufferViews.size()) {
    fail("its buffer view is missing");
  }
  const tinygltf::BufferView& view = source.bufferViews[index];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= source.buffers.size()) {
    fail("its buffer is missing");
  }
  const std::vector<unsigned char>& data = source.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    fail("it reaches beyond its buffer");
  }
  return {reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength};
}

} // namespace

void GltfMaterials::warn(const std::string& sentence) {
  if (said_.insert(sentence).second) {
    model_.warnings.push_back(sentence);
  }
}

void GltfMaterials::readAll() {
  for (const tinygltf::Material& from : source_.materials) {
    model_.materials.push_back(read(from));
  }
}

std::uint32_t GltfMaterials::textureOf(const tinygltf::Texture& from, bool srgb) {
  if (from.source < 0 || static_cast<std::size_t>(from.source) >= source_.images.size()) {
    warn("A texture without an image in a format that Tyndall reads is not used.");
    return kNone;
  }
  tinygltf::Sampler sampler;
  if (from.sampler >= 0 && static_cast<std::size_t>(from.sampler) < source_.samplers.size()) {
    sampler = source_.samplers[static_cast<std::size_t>(from.sampler)];
  }
  const bool nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  const Key key{from.source, wrapOf(sampler.wrapS), wrapOf(sampler.wrapT), nearest, srgb};
  if (const auto known = textures_.find(key); known != textures_.end()) {
    return known->second;
  }
  std::uint32_t& index = textures_[key] = kNone;
  const tinygltf::Image& image = source_.images[static_cast<std::size_t>(from.source)];
  const std::string name = !image.uri.empty()    ? image.uri
                           : !image.name.empty() ? image.name
                                                 : fmt::format("image {}", from.source);
  try {
    Texture texture = decodeImage(bytesOf(source_, image), false);
    texture.name = name;
    texture.wrapU = wrapOf(sampler.wrapS);
    texture.wrapV = wrapOf(sampler.wrapT);
    texture.nearest = nearest;
    texture.srgb = srgb;
    index = static_cast<std::uint32_t>(model_.textures.size());
    model_.textures.push_back(std::move(texture));
  } catch (const Error& problem) {
    warn(fmt::format("The image \"{}\" is not used: {}.", name, problem.what()));
  }
  return index;
}

TextureUse GltfMaterials::use(int texture, int uvSet, const tinygltf::ExtensionMap& extensions, bool srgb) {
  TextureUse use;
  if (texture < 0) {
    return use;
  }
  if (static_cast<std::size_t>(texture) >= source_.textures.size()) {
    warn("A material names a texture that is not there: it goes without.");
    return use;
  }
  const tinygltf::Value* transform = find(extensions, "KHR_texture_transform");
  if (transform != nullptr) {
    uvSet = static_cast<int>(numberOf(*transform, "texCoord", uvSet));
    setTransform(*transform, use);
  }
  if (uvSet != 0) {
    warn("Textures that read another set of texture coordinates than TEXCOORD_0 are not used.");
    return {};
  }
  use.texture = textureOf(source_.textures[static_cast<std::size_t>(texture)], srgb);
  return use.texture == kNone ? TextureUse{} : use;
}

/// Glass where all light that enters is transmitted, which is what the model Dielectric does.
void GltfMaterials::readTransmission(const tinygltf::Material& from, Material& material) {
  const tinygltf::Value* extension = find(from.extensions, "KHR_materials_transmission");
  const double factor = extension == nullptr ? 0.0 : numberOf(*extension, "transmissionFactor", 0.0);
  if (factor <= 0.0) {
    return;
  }
  if (factor >= 1.0 && !extension->Has("transmissionTexture") && material.metallic == 0.0) {
    material.model = MaterialId::Dielectric;
  } else {
    warn(fmt::format("Material \"{}\" transmits in part, which Tyndall does not model: it is opaque.", from.name));
  }
}

Material GltfMaterials::read(const tinygltf::Material& from) {
  Material material;
  material.name = from.name;
  material.model = MaterialId::MetalRough;
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  material.colour = colourOf(pbr.baseColorFactor, glm::dvec3(1.0));
  material.opacity = pbr.baseColorFactor.size() == 4 ? pbr.baseColorFactor[3] : 1.0;
  material.metallic = pbr.metallicFactor;
  material.roughness = pbr.roughnessFactor;
  material.colourTexture =
      use(pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord, pbr.baseColorTexture.extensions, true);
  material.metalRoughTexture = use(pbr.metallicRoughnessTexture.index, pbr.metallicRoughnessTexture.texCoord,
                                   pbr.metallicRoughnessTexture.extensions, false);
  material.normalTexture =
      use(from.normalTexture.index, from.normalTexture.texCoord, from.normalTexture.extensions, false);
  material.normalScale = from.normalTexture.scale;
  material.emissionTexture =
      use(from.emissiveTexture.index, from.emissiveTexture.texCoord, from.emissiveTexture.extensions, true);
  material.emission = colourOf(from.emissiveFactor, glm::dvec3(0.0));
  if (const tinygltf::Value* extension = find(from.extensions, "KHR_materials_emissive_strength")) {
    material.emission *= numberOf(*extension, "emissiveStrength", 1.0);
  }
  if (const tinygltf::Value* extension = find(from.extensions, "KHR_materials_ior")) {
    material.ior = numberOf(*extension, "ior", 1.5);
  }
  material.alpha = from.alphaMode == "MASK" ? Alpha::Mask : from.alphaMode == "BLEND" ? Alpha::Blend : Alpha::Opaque;
  material.alphaCutoff = from.alphaCutoff;
  material.twoSided = from.doubleSided;
  readTransmission(from, material);
  return material;
}

} // namespace tyndall::geometry

// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "peer_scene/parts.h"
#include "scene/field_names.h"

namespace tyndall::peer_scene {
namespace {

void requirePlain(const geometry::Material& material) {
  for (const geometry::TextureUse* use :
       {&material.colourTexture, &material.metalRoughTexture, &material.normalTexture, &material.emissionTexture}) {
    if (use->texture != geometry::kNone) {
      fail("material \"{}\": textures cannot be exported", material.name);
    }
  }
  if (material.opacity < 1.0) {
    fail("material \"{}\": an opacity below 1 cannot be exported", material.name);
  }
}

std::string_view nameOf(MaterialId model) {
  for (const auto& [name, id] : scene::kMaterialTypes) {
    if (id == model) {
      return name;
    }
  }
  return "";
}

Json jsonOf(const geometry::Material& material) {
  Json json{{"name", material.name}, {"type", nameOf(material.model)}};
  if (material.model == MaterialId::Null) {
    return json;
  }
  json["colour"] = inJson(material.colour);
  json["emission"] = inJson(material.emission);
  json["two_sided"] = material.twoSided;
  if (material.model == MaterialId::Diffuse) {
    return json;
  }
  json["roughness"] = material.roughness;
  if (material.model == MaterialId::Conductor) {
    json["eta"] = inJson(material.eta);
    json["k"] = inJson(material.k);
    return json;
  }
  json["ior"] = material.ior;
  if (material.model == MaterialId::MetalRough) {
    json["metallic"] = material.metallic;
  }
  return json;
}

} // namespace

std::size_t Materials::index(const geometry::Material& material) {
  const auto [entry, isNew] = indices_.try_emplace(&material, list_.size());
  if (isNew) {
    requirePlain(material);
    list_.push_back(jsonOf(material));
  }
  return entry->second;
}

} // namespace tyndall::peer_scene

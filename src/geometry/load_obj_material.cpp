// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "geometry/load_obj_parts.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tyndall::geometry {
namespace {

glm::dvec3 colourOf(const float (&values)[3]) { return {double{values[0]}, double{values[1]}, double{values[2]}}; }

/// -s and -o say u' = scale u + offset with v upwards; ours points down, v = 1 - v.
TextureUse useOf(std::uint32_t texture, const tinyobj::texture_option_t& options) {
  TextureUse use;
  if (texture == kNone) {
    return use;
  }
  use.texture = texture;
  const double scaleV = double{options.scale[1]};
  use.rowU = {double{options.scale[0]}, 0.0, double{options.origin_offset[0]}};
  use.rowV = {0.0, scaleV, 1.0 - scaleV - double{options.origin_offset[1]}};
  return use;
}

/// Refraction (illumination models 6 and 7) is glass; a highlight is a coat; else the surface is matt.
MaterialId modelOf(const tinyobj::material_t& from) {
  const bool shines = std::max({from.specular[0], from.specular[1], from.specular[2]}) > 0.0F;
  if ((from.illum == 6 || from.illum == 7) && from.ior > 1.0F) {
    return MaterialId::Dielectric;
  }
  const bool physical = from.roughness > 0.0F || from.metallic > 0.0F;
  return physical || (shines && from.illum >= 2) ? MaterialId::MetalRough : MaterialId::Diffuse;
}

class Converter {
public:
  Converter(const std::filesystem::path& folder, Model& model) : images_(folder, model), model_(model) {}

  Material convert(const tinyobj::material_t& from) {
    Material material;
    material.name = from.name;
    material.model = modelOf(from);
    material.colour = colourOf(from.diffuse);
    material.metallic = double{from.metallic};
    material.roughness = from.roughness > 0.0F ? double{from.roughness} : roughnessOfExponent(double{from.shininess});
    material.ior = from.ior > 1.0F ? double{from.ior} : 1.5; // 1 is what files say that do not say it
    material.emission = colourOf(from.emission);
    material.opacity = double{from.dissolve};
    if (material.model == MaterialId::Dielectric) {
      const glm::dvec3 tint = colourOf(from.transmittance);
      material.colour = tint == glm::dvec3(0.0) ? glm::dvec3(1.0) : tint;
      material.roughness = double{from.roughness};
      material.opacity = 1.0;
    }
    readTextures(from, material);
    const bool picture = material.colourTexture.texture != kNone && hasAlpha(material.colourTexture.texture);
    material.alpha = material.opacity < 1.0 || picture ? Alpha::Blend : Alpha::Opaque;
    warn(from);
    return material;
  }

private:
  void readTextures(const tinyobj::material_t& from, Material& material) {
    const auto use = [this](const std::string& name, const tinyobj::texture_option_t& options, bool srgb) {
      return name.empty() ? TextureUse{}
                          : useOf(images_.load(name, srgb, options.clamp ? Wrap::Clamp : Wrap::Repeat), options);
    };
    material.colourTexture = use(from.diffuse_texname, from.diffuse_texopt, true);
    material.emissionTexture = use(from.emissive_texname, from.emissive_texopt, true);
    material.normalTexture = use(from.normal_texname, from.normal_texopt, false);
    if (material.emissionTexture.texture != kNone && material.emission == glm::dvec3(0.0)) {
      material.emission = glm::dvec3(1.0);
    }
  }

  bool hasAlpha(std::uint32_t texture) const {
    return std::ranges::any_of(model_.textures[texture].texels,
                               [](std::uint32_t texel) { return (texel >> 24U) != 255U; });
  }

  void warn(const tinyobj::material_t& from) {
    std::vector<std::string> passed;
    const auto note = [&passed](const std::string& name, const char* key) {
      if (!name.empty()) {
        passed.emplace_back(key);
      }
    };
    note(from.specular_texname, "map_Ks");
    note(from.specular_highlight_texname, "map_Ns");
    note(from.bump_texname, "bump");
    note(from.displacement_texname, "disp");
    note(from.alpha_texname, "map_d");
    note(from.roughness_texname, "map_Pr");
    note(from.metallic_texname, "map_Pm");
    if (!passed.empty()) {
      model_.warnings.push_back(fmt::format("Material \"{}\": {} passed over.", from.name, joinNames(passed)));
    }
  }

  ImageFiles images_;
  Model& model_;
};

} // namespace

double roughnessOfExponent(double exponent) { return std::pow(2.0 / (std::max(exponent, 0.0) + 2.0), 0.25); }

bool MaterialLibraries::operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                                   std::map<std::string, int>* places, std::string* /*warning*/, std::string* error) {
  std::string relative = name.substr(0, name.find_last_not_of("\r\t ") + 1);
  std::ranges::replace(relative, '\\', '/');
  try {
    std::istringstream stream(readBytes(folder_ / relative, std::uint64_t{1} << 28));
    std::string ignored; // of what tinyobjloader misses, only files that are not there matter
    tinyobj::LoadMtl(places, materials, &stream, &ignored, error);
    materials_ = *materials;
    return true;
  } catch (const Error& problem) {
    warnings_.push_back(fmt::format("The material library \"{}\" is not used: {}.", name, problem.what()));
    return false;
  }
}

void MaterialLibraries::convert(const std::filesystem::path& folder, Model& model) const {
  model.warnings.insert(model.warnings.end(), warnings_.begin(), warnings_.end());
  Converter converter(folder, model);
  for (const tinyobj::material_t& material : materials_) {
    model.materials.push_back(converter.convert(material));
  }
}

} // namespace tyndall::geometry

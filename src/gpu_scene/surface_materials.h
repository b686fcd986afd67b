// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/surfaces.h"

#include <map>
#include <string>
#include <tuple>

namespace tyndall::gpu_scene {

/// Makes the device's materials, textures and interiors, object by object.
class SurfaceMaterials {
public:
  SurfaceMaterials(const scene::Scene& scene, const MeshSet& meshes, const std::vector<std::uint32_t>& mediumIndex,
                   PackedSurfaces& out);

  /// What follows belongs to this object.
  void begin(std::size_t object);
  /// Of the object: index, or kNoInterior.
  std::uint32_t interior() const { return interior_; }
  /// Name of the scene's material that the object has, or empty.
  const std::string& ownMaterial() const { return scene_.objects[object_].material; }
  /// Index of the device's material for one of the object's file (kNone: it has none).
  std::uint32_t device(std::uint32_t fileMaterial);
  /// Whether any of the mesh's triangles shines.
  bool emits(const geometry::Mesh& mesh, const geometry::Model* model) const;
  /// Nothing ever passes it.
  bool opaque(std::uint32_t deviceMaterial) const;
  /// Mean of the emission texture's luminance, 1 without; 0 for what does not shine.
  float emissionScale(std::uint32_t deviceMaterial) const { return emissionScale_[deviceMaterial]; }
  void finish();

private:
  const geometry::Material& source(std::uint32_t fileMaterial) const;
  const geometry::Model* model() const;
  std::uint32_t make(const geometry::Material& material);
  interop::TextureUse packUse(const geometry::TextureUse& use);
  double meanOf(const geometry::TextureUse& use) const;

  const scene::Scene& scene_;
  const MeshSet& meshes_;
  const std::vector<std::uint32_t>& mediumIndex_;
  PackedSurfaces& out_;
  std::size_t object_ = 0;
  std::uint32_t interior_ = interop::kNoInterior;
  std::size_t refracting_ = 0; ///< objects that refract
  std::map<std::pair<const geometry::Material*, std::uint32_t>, std::uint32_t> made_;
  std::map<const geometry::Texture*, std::uint32_t> textures_;
  std::vector<float> emissionScale_;
};

} // namespace tyndall::gpu_scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/load_parts.h"

#include <tiny_gltf.h>

#include <set>
#include <tuple>

/// What the parts of the glTF reader share.
namespace tyndall::geometry {

/// A glTF file as its library read it. @throws Error also for extensions that it requires and Tyndall does not know.
tinygltf::Model parseGltf(const std::filesystem::path& path);

/// An accessor's elements as floats, sparse values applied, normalised integers as fractions.
/// @param components of an element, as many as the accessor must have
/// @return count * components values. @throws Error without a file's name if it reaches beyond its buffer.
std::vector<float> readFloats(const tinygltf::Model& source, int accessor, int components);

/// The same for indices: unsigned integers of 8, 16 or 32 bits.
std::vector<std::uint32_t> readIndices(const tinygltf::Model& source, int accessor);

/// A member of an extension, or `fallback` where it is missing or of another type.
double numberOf(const tinygltf::Value& object, const std::string& key, double fallback);

/// Puts the nodes to where the file's animations, all at once, have them; says what of these is passed over.
void poseGltf(tinygltf::Model& source, double seconds, Model& model);

/// Materials and the textures that they use.
class GltfMaterials {
public:
  GltfMaterials(const tinygltf::Model& source, Model& model) : source_(source), model_(model) {}
  void readAll();

private:
  using Key = std::tuple<int, Wrap, Wrap, bool, bool>; ///< image, wrap along u and v, nearest, sRGB

  Material read(const tinygltf::Material& from);
  void readTransmission(const tinygltf::Material& from, Material& material);
  TextureUse use(int texture, int uvSet, const tinygltf::ExtensionMap& extensions, bool srgb);
  std::uint32_t textureOf(const tinygltf::Texture& from, bool srgb);
  void warn(const std::string& sentence);

  const tinygltf::Model& source_;
  Model& model_;
  std::map<Key, std::uint32_t> textures_;
  std::set<std::string> said_;
};

/// Meshes: one for each of the file's, in its order, those without triangles empty.
void readGltfMeshes(const tinygltf::Model& source, Model& model, Mended& mended);

/// Nodes, cameras and lights of the scene to be shown.
void readGltfScene(const tinygltf::Model& source, Model& model);

} // namespace tyndall::geometry

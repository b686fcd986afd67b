// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/model.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the readers of the formats share.
namespace tyndall::geometry {

/// What was mended or left out while a file was read, in triangles, vertices and polygons.
struct Mended {
  std::size_t badIndices = 0;   ///< triangles and polygons that name a vertex that is not there
  std::size_t badPositions = 0; ///< triangles with a vertex that is NaN or infinite
  std::size_t noArea = 0;       ///< triangles whose area is 0, or below or beyond what a float can hold
  std::size_t badNormals = 0;   ///< zero, NaN or infinite
  std::size_t longNormals = 0;  ///< off unit length by more than 1 %
  std::size_t badUvs = 0;       ///< NaN, infinite, or naming one that is not there
  std::size_t fannedPolygons = 0;
  std::size_t clampedMaterials = 0;

  /// One sentence for each count that is not 0.
  std::vector<std::string> sentences() const;
};

/// At most 2^28 - 1: what a leaf of the BVH can name.
inline constexpr std::size_t kMostTriangles = (std::size_t{1} << 28) - 1;

/// Makes `mesh` what Mesh promises: drops triangles that cannot be drawn, then vertices that no triangle uses; makes
/// normals unit or 0 0 0 and uvs finite. Normals and uvs must be as many as positions, or none.
void makeSound(Mesh& mesh, Mended& mended);

/// `mesh` with its vertices moved by `targetFromSource`, without normals. For transforms that have no inverse.
Mesh baked(const Mesh& mesh, const glm::dmat4& targetFromSource);

/// Cuts polygons into triangles by clipping ears; what it may spend is bounded over all polygons of a file.
class PolygonCutter {
public:
  /// Corner numbers of n - 2 triangles with the polygon's own winding. The corners need not lie in a plane; the cut is
  /// that of their projection along the vector area. False: not a simple polygon or too large; then a fan.
  /// @param corners three or more
  bool cut(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

private:
  std::uint64_t tests_ = 0; ///< pairs of ears and corners looked at
};

/// A file's bytes. @throws Error if it is not there, no regular file, not readable, empty or larger than `limit` bytes.
std::string readBytes(const std::filesystem::path& path, std::uint64_t limit = std::uint64_t{1} << 36);

/// A texture of 8 bits a channel from the bytes of a PNG, JPEG, BMP or TGA file (`tga`: it has no magic number).
/// @throws Error without a file's name: what is wrong.
Texture decodeImage(std::string_view bytes, bool tga);

/// Images by name, read from beside a file, each once. What cannot be read is said in a warning.
class ImageFiles {
public:
  ImageFiles(std::filesystem::path folder, Model& model) : folder_(std::move(folder)), model_(model) {}
  /// Index into Model::textures, or kNone with a warning.
  std::uint32_t load(const std::string& name, bool srgb, Wrap wrap);

private:
  std::filesystem::path folder_;
  Model& model_;
  std::map<std::string, std::uint32_t> known_;
};

/// Copies of materials without their textures, for triangles that have no uv; warns once per material.
class Untextured {
public:
  explicit Untextured(Model& model) : model_(model) {}
  /// `material`, or the index of its copy where it has textures. kNone stays kNone.
  std::uint32_t of(std::uint32_t material);

private:
  Model& model_;
  std::map<std::uint32_t, std::uint32_t> copies_;
};

/// Clamps what a file says to what the models allow; counts the material if anything changed.
void clampMaterial(Material& material, Mended& mended);

/// The readers: what a file holds, before what is common to all formats. @throws Error
Model loadGltf(const std::filesystem::path& path, double seconds, Mended& mended);
Model loadObj(const std::filesystem::path& path, Mended& mended);
Model loadPly(const std::filesystem::path& path, Mended& mended);

} // namespace tyndall::geometry

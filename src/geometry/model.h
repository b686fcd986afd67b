// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/bounds.h"
#include "material/list.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Surfaces as plain host values, whatever file they came from.
namespace tyndall::geometry {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

enum class Wrap { Repeat, Clamp, Mirror };

/// Eight bits a channel, R lowest; rows from the top (v = 0) down.
struct Texture {
  std::string name;
  glm::uvec2 size{0};
  std::vector<std::uint32_t> texels;
  Wrap wrapU = Wrap::Repeat;
  Wrap wrapV = Wrap::Repeat;
  bool srgb = false;    ///< R, G, B are encoded; decided by the use
  bool nearest = false; ///< no filtering
};

/// A texture as a material reads it. (u', v') = rows * (u, v, 1).
struct TextureUse {
  std::uint32_t texture = kNone;
  glm::dvec3 rowU{1.0, 0.0, 0.0};
  glm::dvec3 rowV{0.0, 1.0, 0.0};
};

enum class Alpha { Opaque, Mask, Blend };

/// See shaders/interop/material.h for what the members mean to each model.
struct Material {
  std::string name;
  MaterialId model = MaterialId::Diffuse;
  glm::dvec3 colour{0.8};
  glm::dvec3 eta{0.0};
  glm::dvec3 k{0.0};
  double roughness = 0.0; ///< perceptual, [0, 1]: GGX alpha = roughness^2
  double metallic = 0.0;
  double ior = 1.5;
  double opacity = 1.0;
  Alpha alpha = Alpha::Opaque;
  double alphaCutoff = 0.5;
  glm::dvec3 emission{0.0}; ///< radiance, W / (m2 sr)
  bool twoSided = false;    ///< emits on both sides
  double normalScale = 1.0;
  TextureUse colourTexture, metalRoughTexture, normalTexture, emissionTexture;
};

/// Triangles in object space. Sound: indices in range, positions finite.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals; ///< one per position, or none
  std::vector<glm::vec2> uvs;     ///< one per position, or none
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> materials; ///< per triangle: index into Model::materials, kNone = the object's own
};

struct Node {
  std::uint32_t mesh = 0;
  glm::dmat4 worldFromObject{1.0};
};

/// KHR_lights_punctual. Its candela and lux are taken for W/sr and W/m2, 1 : 1, as emission's nits are for radiance.
struct PunctualLight {
  enum class Kind { Point, Spot, Directional };
  Kind kind = Kind::Point;
  std::string name;
  glm::dvec3 position{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0}; ///< the way the light travels, unit
  glm::dvec3 intensity{1.0};            ///< W/sr; directional: W/m2
  double innerAngle = 0.0;              ///< degrees, half angle (spot)
  double outerAngle = 45.0;
};

struct ModelCamera {
  std::string name;
  glm::dmat4 worldFromCamera{1.0}; ///< looks along -z, y up
  bool perspective = true;
  double verticalFov = 40.0;       ///< degrees
  double height = 2.0;             ///< orthographic
};

/// What a file holds.
struct Model {
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<PunctualLight> lights;
  std::vector<ModelCamera> cameras;
  std::vector<std::string> warnings; ///< what was mended or left out, with counts, in whole sentences
};

/// Reads .gltf, .glb, .obj and .ply, by its extension. Triangulates; drops triangles with NaN, infinite or missing
/// vertices and those without area, and says so with counts.
/// Triangles without a material of their own have kNone. A node whose transform has no inverse gets a baked mesh.
/// glTF: MetalRough, or Dielectric where KHR_materials_transmission is 1. OBJ: Dielectric for illumination models 6 and
/// 7, MetalRough with a highlight (Ks, illum >= 2; roughness = (2 / (Ns + 2))^(1/4)) or Pr, Pm, else Diffuse.
/// @param seconds the time that animations of glTF are shown at.
/// @throws Error with the file's name, what is wrong and what to do: not there, not readable, nothing to draw.
Model loadModel(const std::filesystem::path& path, double seconds = 0.0);

} // namespace tyndall::geometry

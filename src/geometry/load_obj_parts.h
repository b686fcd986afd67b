// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/load_parts.h"

#include <tiny_obj_loader.h>

namespace tyndall::geometry {

/// The .mtl files that an OBJ names, read once each from beside it.
class MaterialLibraries : public tinyobj::MaterialReader {
public:
  explicit MaterialLibraries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Called by tinyobjloader, whose indices into `materials` stay those of the faces.
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* places, std::string* warning, std::string* error) override;

  /// Fills model.materials in the order of the indices, and the textures and warnings that belong to them.
  void convert(const std::filesystem::path& folder, Model& model) const;

private:
  std::filesystem::path folder_;
  std::vector<tinyobj::material_t> materials_;
  std::vector<std::string> warnings_;
};

/// A Blinn-Phong exponent as perceptual roughness: alpha^2 = 2 / (Ns + 2) [Walter et al. 2007], alpha = roughness^2.
double roughnessOfExponent(double exponent);

} // namespace tyndall::geometry

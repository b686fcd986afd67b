// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// The lists of scene.json, each with the files that it names.
namespace tyndall::peer_scene {

using Json = nlohmann::ordered_json;

inline Json inJson(const glm::dvec3& vector) { return {vector.x, vector.y, vector.z}; }

/// Row by row, as in scene files.
inline Json inJson(const glm::dmat4& matrix) {
  Json numbers = Json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      numbers.push_back(matrix[column][row]);
    }
  }
  return numbers;
}

struct WrittenMedia {
  Json list = Json::array();
  std::map<std::string, std::size_t> indexOf; ///< of media by the name that objects fill themselves with
};
WrittenMedia writeMedia(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                        const std::filesystem::path& folder);

Json writeLights(const scene::Scene& scene, const std::filesystem::path& folder);

/// The materials that objects use, each once.
class Materials {
public:
  /// Its place in the list. @throws Error if it cannot be said.
  std::size_t index(const geometry::Material& material);
  const Json& list() const { return list_; }

private:
  Json list_ = Json::array();
  std::map<const geometry::Material*, std::size_t> indices_;
};

Json writeObjects(const scene::Scene& scene, const gpu_scene::MeshSet& meshes, const WrittenMedia& media,
                  Materials& materials, const std::filesystem::path& folder);

} // namespace tyndall::peer_scene

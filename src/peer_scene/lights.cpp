// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/lights.h"

#include "film/exr.h"
#include "peer_scene/parts.h"

#include <fmt/format.h>

namespace tyndall::peer_scene {
namespace fs = std::filesystem;
namespace {

using light::EnvironmentTable;

void writeMap(const fs::path& path, const EnvironmentTable& table) {
  film::Image image;
  image.displaySize = table.size;
  image.window.max = table.size;
  for (int c = 0; c < 3; ++c) {
    std::vector<float>& channel = image.channels[std::string(1, "RGB"[c])];
    channel.reserve(table.texels.size());
    for (const glm::vec3& texel : table.texels) {
      channel.push_back(texel[c]);
    }
  }
  film::writeExr(path, image);
}

class LightWriter {
public:
  LightWriter(const fs::path& folder, Json& list) : folder_(folder), list_(list) {}

  void add(const scene::NamedLight& named, bool transparent) {
    named_ = &named;
    visible_ = named.visible && !transparent;
    std::visit([this](const auto& light) { addLight(light); }, named.light);
  }

private:
  void addLight(const scene::PointLight& light) {
    list_.push_back({{"type", "point"}, {"position", inJson(light.position)}, {"intensity", inJson(light.intensity)}});
  }

  void addLight(const scene::SpotLight& light) {
    list_.push_back({{"type", "spot"},
                     {"position", inJson(light.position)},
                     {"direction", inJson(light.direction)},
                     {"intensity", inJson(light.intensity)},
                     {"outer_angle", light.outerAngle},
                     {"inner_angle", light.innerAngle}});
  }

  void addLight(const scene::SunLight& light) {
    list_.push_back({{"type", "sun"},
                     {"direction", inJson(light.direction)},
                     {"irradiance", inJson(light.irradiance)},
                     {"angular_diameter", light.angularDiameter},
                     {"visible", visible_}});
  }

  void addLight(const scene::ConstantEnvironment& light) {
    list_.push_back({{"type", "constant"}, {"radiance", inJson(light.radiance)}, {"visible", visible_}});
  }

  void addLight(const scene::MapEnvironment& light) { addMap(light.rotation); }
  void addLight(const scene::SkyEnvironment&) { addMap(0.0); }

  /// The table that the device would get, its scale applied; a black one is no light.
  void addMap(double rotation) {
    scene::Scene alone;
    alone.lights.push_back(*named_);
    const gpu_scene::PackedLights packed = gpu_scene::packLights(alone, {glm::dvec3(-1.0), glm::dvec3(1.0)}, {});
    if (packed.tables.empty()) {
      return;
    }
    const std::string file = fmt::format("environment_{}.exr", list_.size());
    const EnvironmentTable& table = packed.tables.front();
    writeMap(folder_ / file, table);
    list_.push_back({{"type", "map"},
                     {"file", file},
                     {"size", {table.size.x, table.size.y}},
                     {"rotation", rotation},
                     {"visible", visible_}});
  }

  const fs::path& folder_;
  Json& list_;
  const scene::NamedLight* named_ = nullptr;
  bool visible_ = true;
};

} // namespace

Json writeLights(const scene::Scene& scene, const fs::path& folder) {
  Json list = Json::array();
  LightWriter writer(folder, list);
  for (const scene::NamedLight& named : scene.lights) {
    writer.add(named, scene.film.transparent);
  }
  return list;
}

} // namespace tyndall::peer_scene

// SPDX-License-Identifier: Apache-2.0
#include "app/surface_counts.h"

#include "app/quantities.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tyndall::app {
namespace {

template <class T>
double bytesOf(const std::vector<T>& values) {
  return double(values.size() * sizeof(T));
}

} // namespace

SurfaceCounts countSurfaces(const gpu_scene::PackedSurfaces& surfaces, const gpu_scene::PackedEmitters& emitters) {
  SurfaceCounts counts{.triangles = surfaces.triangles.size(),
                       .spheres = surfaces.spheres.size(),
                       .instances = surfaces.instances.size(),
                       .primitives = surfaces.bvh.primitives.size(),
                       .nodes = surfaces.bvh.nodes.size(),
                       .materials = surfaces.materials.size(),
                       .textures = surfaces.textures.size(),
                       .interiors = surfaces.interiors.size(),
                       .emitters = emitters.emitters.size(),
                       .lightTreeNodes = emitters.nodes.size()};
  if (counts.materials > 0) { // else none of it is uploaded
    counts.bytes = bytesOf(surfaces.bvh.nodes) + bytesOf(surfaces.bvh.primitives) + bytesOf(surfaces.triangles) +
                   bytesOf(surfaces.vertices) + bytesOf(surfaces.spheres) + bytesOf(surfaces.instances) +
                   bytesOf(surfaces.materials) + bytesOf(surfaces.interiors) + sizeof(interop::Surfaces) +
                   double(counts.textures * sizeof(interop::Texture));
  }
  for (const geometry::Texture* texture : surfaces.textures) {
    counts.bytes += bytesOf(texture->texels);
  }
  if (counts.emitters > 0) {
    counts.bytes += bytesOf(emitters.emitters) + bytesOf(emitters.nodes) + sizeof(interop::Emitters);
  }
  return counts;
}

std::string toText(const SurfaceCounts& counts) {
  std::string text;
  const auto add = [&text](std::size_t count, const char* what) {
    if (count > 0) {
      text += fmt::format("{} {}{}, ", count, what, count == 1 ? "" : "s");
    }
  };
  add(counts.triangles, "triangle");
  add(counts.spheres, "sphere");
  add(counts.instances, "instance");
  add(counts.textures, "texture");
  add(counts.interiors, "interior");
  add(counts.emitters, "emitter");
  return text + inBytes(counts.bytes);
}

nlohmann::ordered_json toJson(const SurfaceCounts& counts) {
  return {{"triangles", counts.triangles}, {"spheres", counts.spheres},
          {"instances", counts.instances}, {"primitives", counts.primitives},
          {"nodes", counts.nodes},         {"materials", counts.materials},
          {"textures", counts.textures},   {"interiors", counts.interiors},
          {"emitters", counts.emitters},   {"light_tree_nodes", counts.lightTreeNodes},
          {"device_bytes", counts.bytes}};
}

} // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#include "peer_scene/ply.h"

#include "base/error.h"
#include "base/file.h"

#include <fmt/format.h>

#include <bit>
#include <fstream>

namespace tyndall::peer_scene {
namespace {

static_assert(std::endian::native == std::endian::little, "the header says so");

template <class Value>
void put(std::ofstream& stream, const Value& value) {
  stream.write(reinterpret_cast<const char*>(&value), sizeof value);
}

} // namespace

void writePly(const std::filesystem::path& path, const geometry::Mesh& mesh, const std::vector<glm::uvec3>& triangles) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
                          "property float x\nproperty float y\nproperty float z\n{}"
                          "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                          mesh.positions.size(),
                          mesh.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n",
                          triangles.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      put(stream, mesh.positions[i]);
      if (!mesh.normals.empty()) {
        put(stream, mesh.normals[i]);
      }
    }
    for (const glm::uvec3& triangle : triangles) {
      put(stream, std::uint8_t(3));
      put(stream, triangle);
    }
    if (!stream.flush()) {
      fail("{}: cannot be written; is the disk full?", path.string());
    }
  });
}

} // namespace tyndall::peer_scene

// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_files.h"

#include "base/error.h"

#include <cstdint>
#include <cstring>
#include <fstream>

namespace tyndall::test {
namespace {

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

} // namespace

std::filesystem::path write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string bmp(int width, int height, const std::vector<unsigned>& pixels) {
  std::string rows;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const unsigned pixel = pixels[static_cast<std::size_t>(y * width + x)];
      rows += {static_cast<char>(pixel & 0xffU), static_cast<char>(pixel >> 8U & 0xffU),
               static_cast<char>(pixel >> 16U & 0xffU)};
    }
    rows.resize((rows.size() + 3) / 4 * 4);
  }
  std::string file = "BM";
  append(file, static_cast<std::uint32_t>(54 + rows.size()));
  append(file, std::uint32_t{0});
  append(file, std::uint32_t{54});
  append(file, std::uint32_t{40});
  append(file, width);
  append(file, -height); // from the top down
  append(file, std::uint16_t{1});
  append(file, std::uint16_t{24});
  for (int i = 0; i < 6; ++i) {
    append(file, std::uint32_t{0});
  }
  return file + rows;
}

std::string squareBuffer() {
  std::string bytes;
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 0.F, // positions
                            0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, // normals
                            0.F, 1.F, 1.F, 1.F, 1.F, 0.F, 0.F, 0.F}) {                  // uvs
    append(bytes, value);
  }
  for (const int index : {0, 1, 2, 0, 2, 3}) {
    append(bytes, static_cast<std::uint16_t>(index));
  }
  return bytes;
}

std::string squareGltf(const std::string& rest) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"buffers":[{"byteLength":140,"uri":"square.bin"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48},
  {"buffer":0,"byteOffset":96,"byteLength":32},{"buffer":0,"byteOffset":128,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
  {"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"},
  {"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"},
  {"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}])" +
         rest + "}";
}

std::string squareMesh(const std::string& primitive) {
  return R"(,"nodes":[{"mesh":0}],"meshes":[{"name":"square","primitives":[{
"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3)" +
         primitive + "}]}]";
}

std::string glb(const std::string& json, const std::string& buffer) {
  std::string text = json;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string data = buffer;
  data.resize((data.size() + 3) / 4 * 4);
  std::string file = "glTF";
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(28 + text.size() + data.size()));
  append(file, static_cast<std::uint32_t>(text.size()));
  file += "JSON" + text;
  append(file, static_cast<std::uint32_t>(data.size()));
  file += std::string("BIN\0", 4) + data;
  return file;
}

geometry::Model loadSquare(const std::filesystem::path& folder, const std::string& rest) {
  write(folder / "square.bin", squareBuffer());
  return geometry::loadModel(write(folder / "square.gltf", squareGltf(rest)));
}

std::string refusal(const std::filesystem::path& path) {
  try {
    geometry::loadModel(path);
  } catch (const Error& problem) {
    return problem.what();
  }
  return "";
}

double area(const geometry::Model& model) {
  double sum = 0.0;
  const geometry::Mesh& mesh = model.meshes.at(0);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions.at(t.x));
    sum +=
        0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions.at(t.y)) - a, glm::dvec3(mesh.positions.at(t.z)) - a));
  }
  return sum;
}

std::string warnings(const geometry::Model& model) {
  std::string text;
  for (const std::string& warning : model.warnings) {
    text += warning + "\n";
  }
  return text;
}

} // namespace tyndall::test

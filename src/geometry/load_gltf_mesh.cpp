// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "geometry/load_gltf_parts.h"

#include <numeric>

namespace tyndall::geometry {
namespace {

/// Triangles of one primitive; empty for points and lines.
std::vector<glm::uvec3> trianglesOf(const std::vector<std::uint32_t>& corners, int mode) {
  std::vector<glm::uvec3> triangles;
  const std::size_t count = corners.size();
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t i = 0; i + 2 < count; i += 3) {
      triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
    }
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t i = 0; i + 2 < count; ++i) { // every second one winds the other way
      triangles.emplace_back(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    }
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (std::size_t i = 1; i + 1 < count; ++i) {
      triangles.emplace_back(corners[i], corners[i + 1], corners[0]);
    }
  }
  return triangles;
}

template <class Vector>
std::vector<Vector> vectorsOf(const tinygltf::Model& source, int accessor) {
  constexpr int kWidth = Vector::length();
  const std::vector<float> values = readFloats(source, accessor, kWidth);
  std::vector<Vector> vectors(values.size() / kWidth);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    for (int c = 0; c < kWidth; ++c) {
      vectors[i][c] = values[i * kWidth + static_cast<std::size_t>(c)];
    }
  }
  return vectors;
}

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

class MeshReader {
public:
  MeshReader(const tinygltf::Model& source, Model& model, Mended& mended)
      : source_(source), model_(model), mended_(mended), untextured_(model) {}

  Mesh read(const tinygltf::Mesh& from) {
    Mesh mesh;
    mesh.name = from.name;
    for (std::size_t i = 0; i < from.primitives.size(); ++i) {
      try {
        append(mesh, readPrimitive(from.primitives[i]));
      } catch (const Error& problem) {
        model_.warnings.push_back(
            fmt::format("Primitive {} of mesh \"{}\" was left out: {}.", i, from.name, problem.what()));
      }
      triangles_ += mesh.triangles.size();
      if (triangles_ > kMostTriangles) {
        fail("it holds more than {} triangles; split the file", kMostTriangles);
      }
    }
    return mesh;
  }

  void warn() const {
    if (others_ > 0) {
      model_.warnings.push_back(fmt::format("{} primitives of points or lines were left out.", others_));
    }
    if (morphs_) {
      model_.warnings.push_back("Morph targets are passed over.");
    }
    if (colours_) {
      model_.warnings.push_back("Passed over: the vertices' colours.");
    }
    if (incomplete_ > 0) {
      model_.warnings.push_back(
          fmt::format("{} triangles that lack a corner at their primitive's end were left out.", incomplete_));
    }
  }

private:
  Mesh readPrimitive(const tinygltf::Primitive& from) {
    if (from.mode < TINYGLTF_MODE_TRIANGLES || from.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
      ++others_;
      return {};
    }
    morphs_ |= !from.targets.empty();
    const int positions = attribute(from, "POSITION");
    if (positions < 0) {
      fail("it has no positions");
    }
    Mesh part;
    part.positions = vectorsOf<glm::vec3>(source_, positions);
    std::vector<std::uint32_t> corners;
    if (from.indices >= 0) {
      corners = readIndices(source_, from.indices);
    } else {
      corners.resize(part.positions.size());
      std::iota(corners.begin(), corners.end(), 0U);
    }
    part.triangles = trianglesOf(corners, from.mode);
    colours_ |= attribute(from, "COLOR_0") >= 0;
    incomplete_ += from.mode == TINYGLTF_MODE_TRIANGLES ? corners.size() % 3 != 0 : part.triangles.empty();
    readNormals(from, part);
    readUvs(from, part);
    std::uint32_t material = materialOf(from.material);
    material = part.uvs.empty() ? untextured_.of(material) : material;
    part.materials.assign(part.triangles.size(), material);
    makeSound(part, mended_); // here, so that a part of shared vertices keeps its own alone
    return part;
  }

  void readNormals(const tinygltf::Primitive& from, Mesh& part) {
    const int accessor = attribute(from, "NORMAL");
    if (accessor < 0) {
      return;
    }
    part.normals = vectorsOf<glm::vec3>(source_, accessor);
    dropUnlessOnePerPosition(part, part.normals, "normals");
    for (const glm::vec3& normal : part.normals) {
      mended_.badNormals += normal == glm::vec3(0.0F);
    }
  }

  void readUvs(const tinygltf::Primitive& from, Mesh& part) {
    if (const int accessor = attribute(from, "TEXCOORD_0"); accessor >= 0) {
      part.uvs = vectorsOf<glm::vec2>(source_, accessor);
      dropUnlessOnePerPosition(part, part.uvs, "texture coordinates");
    }
  }

  template <class Vector>
  void dropUnlessOnePerPosition(const Mesh& part, std::vector<Vector>& values, const char* what) {
    if (values.size() != part.positions.size()) {
      model_.warnings.push_back(
          fmt::format("{} {} for {} vertices were left out.", values.size(), what, part.positions.size()));
      values.clear();
    }
  }

  std::uint32_t materialOf(int index) {
    if (index < 0) {
      return kNone;
    }
    if (static_cast<std::size_t>(index) >= source_.materials.size()) {
      fail("it names material {}, which is not there", index);
    }
    return static_cast<std::uint32_t>(index);
  }

  /// Parts without normals or uvs get 0 where another has some.
  static void append(Mesh& mesh, const Mesh& part) {
    const std::size_t before = mesh.positions.size();
    const std::size_t after = before + part.positions.size();
    if (after >= kNone) {
      fail("the mesh has more than 2^32 vertices; split it");
    }
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    if (!mesh.normals.empty() || !part.normals.empty()) {
      mesh.normals.resize(before, glm::vec3(0.0F));
      mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
      mesh.normals.resize(after, glm::vec3(0.0F));
    }
    if (!mesh.uvs.empty() || !part.uvs.empty()) {
      mesh.uvs.resize(before, glm::vec2(0.0F));
      mesh.uvs.insert(mesh.uvs.end(), part.uvs.begin(), part.uvs.end());
      mesh.uvs.resize(after, glm::vec2(0.0F));
    }
    for (const glm::uvec3& t : part.triangles) {
      mesh.triangles.push_back(t + static_cast<std::uint32_t>(before));
    }
    mesh.materials.insert(mesh.materials.end(), part.materials.begin(), part.materials.end());
  }

  const tinygltf::Model& source_;
  Model& model_;
  Mended& mended_;
  Untextured untextured_;
  std::size_t triangles_ = 0;
  std::size_t others_ = 0;
  bool morphs_ = false;
  bool colours_ = false;
  std::size_t incomplete_ = 0;
};

} // namespace

void readGltfMeshes(const tinygltf::Model& source, Model& model, Mended& mended) {
  MeshReader reader(source, model, mended);
  for (const tinygltf::Mesh& mesh : source.meshes) {
    model.meshes.push_back(reader.read(mesh));
  }
  reader.warn();
}

} // namespace tyndall::geometry

// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "geometry/load_parts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <new>

namespace tyndall::geometry {
namespace {

namespace fs = std::filesystem;

bool isFinite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) {
        return false;
      }
    }
  }
  return true;
}

/// Relative to the lengths of the columns, so that tiny scales are no reason.
bool hasInverse(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const double volume = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  return volume > 0.0 && std::abs(glm::determinant(linear)) > 1e-12 * volume;
}

/// Nodes with a transform that has no inverse get a mesh of their own, flattened as the transform says.
void settleTransforms(Model& model, Mended& mended) {
  std::size_t lost = 0;
  std::erase_if(model.nodes, [&](const Node& node) {
    const bool bad = !isFinite(node.worldFromObject);
    lost += bad;
    return bad;
  });
  if (lost > 0) {
    model.warnings.push_back(fmt::format("{} nodes with a transform that is NaN or infinite were left out.", lost));
  }
  std::size_t triangles = 0;
  for (Node& node : model.nodes) {
    if (!hasInverse(node.worldFromObject)) {
      triangles += model.meshes[node.mesh].triangles.size();
      if (triangles > kMostTriangles) {
        fail("too many nodes with a scale of 0; remove them");
      }
      Mesh flat = baked(model.meshes[node.mesh], node.worldFromObject);
      makeSound(flat, mended);
      node = {static_cast<std::uint32_t>(model.meshes.size()), glm::dmat4(1.0)};
      model.meshes.push_back(std::move(flat));
    }
  }
}

/// Drops meshes that are empty or in no node, and the nodes of those that are empty.
void dropEmptyMeshes(Model& model) {
  std::vector<bool> used(model.meshes.size(), false);
  std::erase_if(model.nodes, [&](const Node& node) { return model.meshes[node.mesh].triangles.empty(); });
  for (const Node& node : model.nodes) {
    used[node.mesh] = true;
  }
  std::vector<std::uint32_t> place(model.meshes.size(), kNone);
  std::vector<Mesh> kept;
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    if (used[i]) {
      place[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(std::move(model.meshes[i]));
    }
  }
  model.meshes = std::move(kept);
  for (Node& node : model.nodes) {
    node.mesh = place[node.mesh];
  }
}

Model read(const fs::path& path, const std::string& extension, double seconds, Mended& mended) {
  if (extension == ".gltf" || extension == ".glb") {
    return loadGltf(path, seconds, mended);
  }
  if (extension == ".obj") {
    return loadObj(path, mended);
  }
  if (extension == ".ply") {
    return loadPly(path, mended);
  }
  fail("no mesh file that Tyndall reads: its name must end in .gltf, .glb, .obj or .ply");
}

Model readAndSettle(const fs::path& path, const std::string& extension, double seconds) {
  Mended mended;
  Model model = read(path, extension, seconds, mended);
  std::size_t triangles = 0;
  for (Mesh& mesh : model.meshes) {
    makeSound(mesh, mended);
    triangles += mesh.triangles.size();
  }
  if (triangles > kMostTriangles) {
    fail("{} triangles are more than the {} that Tyndall takes; split the file", triangles, kMostTriangles);
  }
  settleTransforms(model, mended);
  dropEmptyMeshes(model);
  for (Material& material : model.materials) {
    clampMaterial(material, mended);
  }
  for (std::string& sentence : mended.sentences()) {
    model.warnings.push_back(std::move(sentence));
  }
  if (model.nodes.empty()) {
    std::string why;
    for (std::size_t i = 0; i < std::min<std::size_t>(model.warnings.size(), 4); ++i) {
      why += " " + model.warnings[i];
    }
    fail("nothing to draw: it holds no triangle with an area; export it with its surfaces.{}", why);
  }
  return model;
}

} // namespace

std::string readBytes(const fs::path& path, std::uint64_t limit) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    fail("no such file; check the name");
  }
  if (!fs::is_regular_file(status)) {
    fail("not a regular file; name a file");
  }
  const std::uint64_t size = fs::file_size(path, error);
  if (error || size > limit) {
    fail("{} bytes are more than the {} that Tyndall reads; split the file", size, limit);
  }
  if (size == 0) {
    fail("empty (0 bytes); export it again");
  }
  std::string bytes(size, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) {
    fail("not readable; check its permissions");
  }
  return bytes;
}

Model loadModel(const fs::path& path, double seconds) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  try {
    return readAndSettle(path, extension, seconds);
  } catch (const Error& problem) {
    fail("{}: {}", path.string(), problem.what());
  } catch (const std::bad_alloc&) {
    fail("{}: not enough memory for what it says it holds; check the file or split it", path.string());
  } catch (const std::exception& problem) { // a library's own, out of range and the like
    fail("{}: damaged: {}; export it again", path.string(), problem.what());
  }
}

} // namespace tyndall::geometry

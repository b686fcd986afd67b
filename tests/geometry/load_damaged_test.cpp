// SPDX-License-Identifier: Apache-2.0
// Whatever a file holds, it is read, mended with a word, or refused with an Error that names it.
#include "base/error.h"
#include "geometry/load_parts.h"
#include "geometry/mesh_files.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

namespace tyndall::geometry {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// What Model promises of its parts.
void expectSound(const Model& model, const std::string& name) {
  std::size_t broken = model.nodes.empty();
  for (const Mesh& mesh : model.meshes) {
    broken += mesh.materials.size() != mesh.triangles.size();
    broken += !mesh.normals.empty() && mesh.normals.size() != mesh.positions.size();
    broken += !mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size();
    for (const glm::vec3& p : mesh.positions) {
      broken += !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
    }
    for (const glm::vec3& n : mesh.normals) {
      broken += n != glm::vec3(0.0F) && !(std::abs(glm::length(n) - 1.0F) < 1e-5F);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const glm::uvec3& t = mesh.triangles[i];
      broken += std::max({t.x, t.y, t.z}) >= mesh.positions.size();
      broken += mesh.materials[i] != kNone && mesh.materials[i] >= model.materials.size();
    }
  }
  for (const Node& node : model.nodes) {
    broken += node.mesh >= model.meshes.size();
  }
  for (const Material& material : model.materials) {
    for (const TextureUse& use :
         {material.colourTexture, material.metalRoughTexture, material.normalTexture, material.emissionTexture}) {
      broken += use.texture != kNone && use.texture >= model.textures.size();
    }
  }
  EXPECT_EQ(broken, 0U) << name;
}

/// True if the file was taken. Anything but an Error that names the file fails the test.
bool survives(const fs::path& path) {
  try {
    expectSound(loadModel(path), path.string());
    return true;
  } catch (const Error& problem) {
    EXPECT_THAT(problem.what(), HasSubstr(path.filename().string() + ": "));
  }
  return false;
}

std::string damaged(const std::string& original, std::mt19937& random) {
  std::string bytes = original;
  for (std::uint32_t change = 0; change <= random() % 4; ++change) {
    const std::size_t place = random() % bytes.size();
    switch (random() % 4) {
    case 0:
      bytes[place] = static_cast<char>(random());
      break;
    case 1:
      bytes[place] = static_cast<char>('0' + random() % 10);
      break;
    case 2:
      bytes.insert(place, bytes.substr(random() % bytes.size(), random() % 20));
      break;
    default:
      bytes.resize(place + 1);
    }
  }
  return bytes;
}

struct Sample {
  std::string name;
  std::string bytes;
};

/// One file of each format, with a picture and a material where it can have them.
std::vector<Sample> samples(const test::TemporaryFolder& folder) {
  test::write(folder / "a.bmp", test::bmp(2, 2, {1, 2, 3, 4}));
  test::write(folder / "m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd a.bmp\n");
  test::write(folder / "square.bin", test::squareBuffer());
  const std::string rest = test::squareMesh(R"(,"material":0)") + R"(,"images":[{"uri":"a.bmp"}],
    "textures":[{"source":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])";
  std::string json = test::squareGltf(rest);
  const std::string uri = R"(,"uri":"square.bin")";
  std::string inside = json;
  inside.erase(inside.find(uri), uri.size());
  inside.replace(inside.find(R"("uri":"a.bmp")"), 13, R"("bufferView":3,"mimeType":"image/png")");
  return {{"a.gltf", json},
          {"a.glb", test::glb(inside, test::squareBuffer())},
          {"a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl a\n"
                    "f 1/1/1 2/1/1 3/1/1 4/1/1\n"},
          {"a.ply",
           "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
          {"b.ply", "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
                    "property char z\nelement face 1\nproperty list uchar uchar vertex_index\nend_header\n" +
                        std::string("\0\0\0\1\0\0\0\1\0\3\0\1\2", 13)}};
}

TEST(Damaged, FilesAreReadMendedOrRefused) {
  const test::TemporaryFolder folder;
  const char* effort = std::getenv("TYNDALL_TEST_EFFORT");
  const int files = 250 * (effort == nullptr ? 1 : std::atoi(effort));
  std::mt19937 random(1);
  for (const Sample& sample : samples(folder)) {
    ASSERT_TRUE(survives(test::write(folder / sample.name, sample.bytes))) << sample.name;
    int refused = 0;
    for (int i = 0; i < files; ++i) {
      refused += !survives(test::write(folder / sample.name, damaged(sample.bytes, random)));
    }
    EXPECT_GT(refused, files / 20) << sample.name; // else the damage does not reach the reader
    EXPECT_LT(refused, files) << sample.name;
  }
}

TEST(Damaged, WhatIsNoFileOrNoMeshIsNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(test::refusal(folder / "none.obj"), HasSubstr("none.obj: no such file"));
  EXPECT_THAT(test::refusal(test::write(folder / "a.fbx", "x")), HasSubstr(".gltf, .glb, .obj or .ply"));
  EXPECT_THAT(test::refusal(test::write(folder / "zero.glb", "")), HasSubstr("empty (0 bytes)"));
  EXPECT_THAT(test::refusal(test::write(folder / "bin.gltf", test::squareGltf(test::squareMesh()))),
              HasSubstr("File not found : square.bin"));
  fs::create_directory(folder / "folder.ply");
  EXPECT_THAT(test::refusal(folder / "folder.ply"), HasSubstr("not a regular file"));
  test::write(folder / "square.bin", test::squareBuffer());
  std::string deep =
      test::squareGltf(test::squareMesh() + R"(,"extras":)" + std::string(100000, '[') + std::string(100000, ']'));
  EXPECT_THAT(test::refusal(test::write(folder / "deep.gltf", deep)), HasSubstr("nested more than"));
  std::string zeros = test::squareGltf(test::squareMesh());
  const std::string accessor = R"({"bufferView":0,"componentType":5126,"count":4)";
  zeros.replace(zeros.find(accessor), accessor.size(), R"({"componentType":5126,"count":4000000000)");
  EXPECT_THAT(test::refusal(test::write(folder / "zeros.gltf", zeros)), HasSubstr("more than Tyndall takes"));
}

TEST(Damaged, PicturesAreCheckedBeforeTheyAreDecoded) {
  std::string huge = test::bmp(2, 2, {1, 2, 3, 4});
  huge[19] = '\x20'; // 8194 x 8194 texels in 70 bytes
  huge[23] = '\xdf';
  EXPECT_THROW(decodeImage(huge, false), Error);
  EXPECT_THROW(decodeImage("GIF89a", false), Error);
  std::mt19937 random(2);
  int decoded = 0;
  for (int i = 0; i < 2000; ++i) {
    try {
      decoded += decodeImage(damaged(test::bmp(3, 2, {1, 2, 3, 4, 5, 6}), random), false).size.x > 0;
    } catch (const Error&) { // said in words
    }
  }
  EXPECT_GT(decoded, 0);
}

/// More meshes, of the user's choice: TYNDALL_TEST_MESHES=FOLDER. Prints what each holds.
TEST(Damaged, FilesOfTheEnvironmentAreReadMendedOrRefused) {
  const char* folder = std::getenv("TYNDALL_TEST_MESHES");
  if (folder == nullptr) {
    GTEST_SKIP() << "TYNDALL_TEST_MESHES is not set";
  }
  int seen = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension != ".gltf" && extension != ".glb" && extension != ".obj" && extension != ".ply") {
      continue;
    }
    ++seen;
    const std::string name = fs::relative(entry.path(), folder).string();
    try {
      const Model model = loadModel(entry.path());
      expectSound(model, name);
      std::size_t triangles = 0;
      for (const Mesh& mesh : model.meshes) {
        triangles += mesh.triangles.size();
      }
      std::printf("%s: %zu triangles, %zu meshes, %zu nodes, %zu materials, %zu textures, %zu lights, %zu cameras\n",
                  name.c_str(), triangles, model.meshes.size(), model.nodes.size(), model.materials.size(),
                  model.textures.size(), model.lights.size(), model.cameras.size());
      std::printf("%s", test::warnings(model).c_str());
    } catch (const Error& problem) {
      std::printf("%s\n", problem.what());
      EXPECT_THAT(problem.what(), HasSubstr(entry.path().filename().string()));
    }
  }
  EXPECT_GT(seen, 0);
}

} // namespace
} // namespace tyndall::geometry

// SPDX-License-Identifier: Apache-2.0
// What other renderers are given is what the scene says: places, extinctions, voxels, and which side is the front.
#include "base/error.h"
#include "peer_scene/peer_scene.h"
#include "support/fixtures.h"
#include "volume/grid_write.h"
#include "volume/load.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <iterator>

namespace tyndall::peer_scene {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

json exported(const scene::Scene& scene, const fs::path& folder) {
  writePeerScene(scene, folder);
  std::ifstream stream(folder / "scene.json");
  return json::parse(stream);
}

std::string bytesOf(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

glm::dmat4 matrixOf(const json& rows) {
  glm::dmat4 matrix(1.0);
  for (int i = 0; i < 16; ++i) {
    matrix[i % 4][i / 4] = rows[static_cast<std::size_t>(i)].get<double>();
  }
  return matrix;
}

glm::dvec3 vectorOf(const json& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

double difference(const glm::dmat4& a, const glm::dmat4& b) {
  double worst = 0.0;
  for (int column = 0; column < 4; ++column) {
    worst = std::max(worst, glm::length(a[column] - b[column]));
  }
  return worst;
}

/// 1 + its own index in a small box of voxels, so that no two are alike.
constexpr glm::ivec3 kSize{4, 3, 2};
constexpr glm::ivec3 kFirst{-1, 5, 7};

volume::BrickGrid numbered(const glm::dmat4& worldFromIndex) {
  std::vector<float> values(static_cast<std::size_t>(kSize.x * kSize.y * kSize.z));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = 1.0f + static_cast<float>(i);
  }
  return volume::gridFromDense(values, kSize, kFirst, worldFromIndex);
}

/// Bounds: double rounding of products of matrices (1e-12), none for voxels. Fails with the matrix written by columns,
/// with the medium's transform before the grid's, with z fastest, and with OpenVDB's matrix transposed.
TEST(PeerScene, GridsHaveTheirPlaceAndTheirVoxels) {
  for (const test::NamedTransform& own : test::affineTransforms()) {
    SCOPED_TRACE(own.name);
    const test::TemporaryFolder folder;
    volume::writeGrid(folder / "v.vdb", numbered(own.worldFromIndex), own.worldFromIndex);
    scene::Scene scene;
    scene::Medium& medium = scene.media.emplace_back();
    medium.file = (folder / "v.vdb").string();
    medium.densityScale = 3.0;
    medium.extinctionColour = {1.0, 0.5, 0.25};
    medium.worldFromMedium = glm::rotate(glm::translate(glm::dmat4(1.0), {1.0, 2.0, 3.0}), 0.7, {0.0, 1.0, 0.0});
    const glm::dmat4 worldFromIndex = medium.worldFromMedium * own.worldFromIndex;
    const json written = exported(scene, folder / "out")["media"][0];
    EXPECT_LT(glm::distance(vectorOf(written["sigma_t"]), glm::dvec3(3.0, 1.5, 0.75)), 1e-12);
    const json& shape = written["shape"];
    EXPECT_LT(difference(matrixOf(shape["world_from_index"]), worldFromIndex), 1e-12);
    EXPECT_EQ(shape["size"], json({kSize.x, kSize.y, kSize.z}));
    EXPECT_EQ(shape["index_min"], json({kFirst.x, kFirst.y, kFirst.z}));
    const std::string raw = bytesOf(folder / "out" / shape["values"].get<std::string>());
    ASSERT_EQ(raw.size(), 4u * 24u);
    for (std::size_t i = 0; i < 24; ++i) {
      float value = 0.0f;
      std::memcpy(&value, raw.data() + 4 * i, 4);
      EXPECT_EQ(value, 1.0f + static_cast<float>(i)) << i;
    }
    volume::LoadOptions exact;
    exact.storage = volume::Storage::Float;
    const volume::BrickGrid again = volume::loadGrid(folder / "out" / shape["vdb"].get<std::string>(), exact);
    EXPECT_LT(difference(again.worldFromIndex, worldFromIndex), 1e-12);
    EXPECT_EQ(again.voxel(kFirst + glm::ivec3(1, 2, 1)), 1.0f + 1.0f + 4.0f * (2.0f + 3.0f * 1.0f));
  }
}

/// A plane through three points of a binary PLY of floats without normals.
glm::dvec3 frontOf(const fs::path& ply) {
  const std::string bytes = bytesOf(ply);
  const std::size_t head = bytes.find("end_header\n") + std::strlen("end_header\n");
  constexpr std::size_t kVertices = 4;
  glm::vec3 positions[kVertices];
  std::memcpy(positions, bytes.data() + head, sizeof positions);
  glm::uvec3 triangle;
  std::memcpy(&triangle, bytes.data() + head + sizeof positions + 1, sizeof triangle);
  const glm::dvec3 corner(positions[triangle.x]);
  return glm::normalize(
      glm::cross(glm::dvec3(positions[triangle.y]) - corner, glm::dvec3(positions[triangle.z]) - corner));
}

/// A quad whose front looks up still does so when it is mirrored along x; a copy turned upside down does not. Bound:
/// float corners. Fails where mirrored triangles keep their order.
TEST(PeerScene, FrontsStayFronts) {
  const test::TemporaryFolder folder;
  scene::Scene scene;
  scene::Object& quad = scene.objects.emplace_back();
  quad.kind = scene::Object::Kind::Quad;
  quad.instances = {glm::dmat4(1.0), glm::scale(glm::dmat4(1.0), {-1.0, 1.0, 1.0}),
                    glm::rotate(glm::dmat4(1.0), 3.14159265358979, {1.0, 0.0, 0.0})};
  const json objects = exported(scene, folder / "out")["objects"];
  ASSERT_EQ(objects.size(), 3u);
  const double expected[] = {1.0, 1.0, -1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const fs::path file = folder / "out" / objects[i]["file"].get<std::string>();
    EXPECT_LT(glm::distance(frontOf(file), glm::dvec3(0.0, expected[i], 0.0)), 1e-6) << i;
  }
}

/// Bounds: 1e-12, double rounding. Fails with the transform's scale left out.
TEST(PeerScene, SpheresAndMediaOfObjectsAreNamedByTheirIndex) {
  const test::TemporaryFolder folder;
  scene::Scene scene;
  scene.media.resize(2);
  scene.media[0].shape = scene::MediumShape::Box;
  scene.media[0].box = {glm::dvec3(0.0), glm::dvec3(1.0)};
  scene.media[0].instances.resize(3, glm::dmat4(1.0));
  scene.media[1].name = "tea";
  scene.media[1].shape = scene::MediumShape::Objects;
  scene::Object& ball = scene.objects.emplace_back();
  ball.kind = scene::Object::Kind::Sphere;
  ball.centre = {1.0, 0.0, 0.0};
  ball.radius = 0.5;
  ball.medium = "tea";
  ball.worldFromObject = glm::scale(glm::translate(glm::dmat4(1.0), {0.0, 4.0, 0.0}), glm::dvec3(2.0));
  const json written = exported(scene, folder / "out");
  EXPECT_EQ(written["media"].size(), 4u);
  const json& sphere = written["objects"][0];
  EXPECT_EQ(sphere["medium"], 3);
  EXPECT_LT(glm::distance(vectorOf(sphere["centre"]), glm::dvec3(2.0, 4.0, 0.0)), 1e-12);
  EXPECT_NEAR(sphere["radius"].get<double>(), 1.0, 1e-12);
}

void expectRefused(const scene::Scene& scene, const std::string& feature) {
  const test::TemporaryFolder folder;
  try {
    writePeerScene(scene, folder / "out");
    FAIL() << feature << " was exported";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(feature));
  }
  EXPECT_FALSE(fs::exists(folder / "out" / "scene.json"));
}

/// What cannot be said is named, and no scene is left that looks whole. Fails without the two checks.
TEST(PeerScene, RefusesWhatItCannotSay) {
  scene::Scene glowing;
  glowing.media.emplace_back().emission.emplace();
  expectRefused(glowing, "emission");
  scene::Scene thin;
  thin.materials.emplace_back().name = "veil";
  thin.materials.back().opacity = 0.5;
  scene::Object& quad = thin.objects.emplace_back();
  quad.kind = scene::Object::Kind::Quad;
  quad.material = "veil";
  expectRefused(thin, "opacity");
}

} // namespace
} // namespace tyndall::peer_scene

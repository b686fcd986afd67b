// SPDX-License-Identifier: Apache-2.0
// OBJ, its materials, PLY, and the polygons of both.
#include "geometry/load_parts.h"
#include "geometry/mesh_files.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace tyndall::geometry {
namespace {

using test::warnings;
using testing::HasSubstr;

Model obj(const test::TemporaryFolder& folder, const std::string& text) {
  return loadModel(test::write(folder / "mesh.obj", text));
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, CornersShareVerticesWhereAllThatTheyNameIsTheSame) {
  const test::TemporaryFolder folder;
  const Model model = obj(folder, kSquare + "vt 0 0\nvt 1 0\nvt 1 0.75\nvt 0 1\nvn 0 0 2\n"
                                            "f 1/1/1 2/2/1 3/3/1\nf -4/-4/-1 -2/-2/-1 -1/-1/-1\n");
  const Mesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 4U);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.uvs[2], glm::vec2(1.0F, 0.25F)); // the file's v points up
  EXPECT_EQ(mesh.normals[0], glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_THAT(warnings(model), HasSubstr("4 vertex normals that were not of unit length"));
}

TEST(Obj, NumbersAndLinesInTheirManyForms) {
  const test::TemporaryFolder folder;
  const Model model = obj(folder, "v +0. 0 0 # origin\r\nv 1e0\t0 0\r\nv 1.0E+0 1. \\\r\n 2\r\n f 1 2 3");
  EXPECT_EQ(model.meshes[0].positions[2], glm::vec3(1.0F, 1.0F, 2.0F));
  std::string wide = "\xfe\xff"; // UTF-16, big endian
  for (const char c : kSquare + "f 1 2 3 4\n") {
    wide += {'\0', c};
  }
  EXPECT_DOUBLE_EQ(test::area(obj(folder, wide)), 1.0);
}

TEST(Obj, MaterialsOfTheLibrary) {
  const test::TemporaryFolder folder;
  test::write(folder / "a.bmp", test::bmp(2, 1, {0xff0000, 0x00ff00}));
  test::write(folder / "m.mtl",
              "newmtl matt\nKd 0.1 0.2 0.3\nKe 1 2 3\n\nnewmtl coat\nKd 1 1 1\nKs 1 1 1\nNs 30\nillum 2\n"
              "map_Kd -s 2 3 1 -o 0.5 0.25 0 a.bmp\n\nnewmtl glass\nNi 1.4\nillum 7\nd 0.2\n"
              "\nnewmtl lace\nd 0.5\nmap_Kd none.png\n");
  const Model model = obj(folder, kSquare + "vt 0 0\nmtllib m.mtl\nusemtl coat\nf 1/1 2/1 3/1\nusemtl glass\nf 1 3 4\n"
                                            "usemtl brass\nf 1 2 4\n");
  ASSERT_EQ(model.materials.size(), 4U);
  EXPECT_EQ(model.meshes[0].materials, (std::vector<std::uint32_t>{1, 2, kNone}));
  EXPECT_EQ(model.materials[0].model, MaterialId::Diffuse);
  EXPECT_NEAR(glm::length(model.materials[0].colour - glm::dvec3(0.1, 0.2, 0.3)), 0.0, 1e-7);
  EXPECT_EQ(model.materials[0].emission, glm::dvec3(1.0, 2.0, 3.0));
  const Material& coat = model.materials[1];
  EXPECT_EQ(coat.model, MaterialId::MetalRough);
  EXPECT_NEAR(coat.roughness, 0.5, 1e-12); // alpha^2 = 2 / 32 = 1 / 16, alpha = 1 / 4
  ASSERT_NE(coat.colourTexture.texture, kNone);
  EXPECT_TRUE(model.textures[coat.colourTexture.texture].srgb);
  EXPECT_EQ(coat.colourTexture.rowU, glm::dvec3(2.0, 0.0, 0.5));
  // The file's v = 0.5 reads 3 * 0.5 + 0.25 = 1.75 upwards, which is 1 - 1.75 downwards.
  EXPECT_NEAR(glm::dot(coat.colourTexture.rowV, glm::dvec3(0.0, 0.5, 1.0)), -0.75, 1e-12);
  EXPECT_EQ(model.materials[2].model, MaterialId::Dielectric);
  EXPECT_NEAR(model.materials[2].ior, 1.4, 1e-6);
  EXPECT_EQ(model.materials[2].opacity, 1.0);
  EXPECT_EQ(model.materials[3].alpha, Alpha::Blend);
  EXPECT_THAT(warnings(model), HasSubstr("No library has the material \"brass\""));
  EXPECT_THAT(warnings(model), HasSubstr("image \"none.png\" is not used"));
}

TEST(Obj, WhatCannotBeDrawnIsCountedOrRefused) {
  const test::TemporaryFolder folder;
  const Model model = obj(folder, kSquare + "v nan 0 0\nv 1e99 0 0\nv 2 0 0\nf 1 2 3\nf 1 2 5\nf 1 2 6\nf 1 2 7\n"
                                            "f 1 2 9\nf 1 2 -9\nf 1 2\nf 1 1 2\n");
  EXPECT_EQ(model.meshes[0].triangles.size(), 1U);
  EXPECT_EQ(model.meshes[0].positions.size(), 3U);
  EXPECT_THAT(warnings(model), HasSubstr("2 triangles with a vertex that is NaN or infinite"));
  EXPECT_THAT(warnings(model), HasSubstr("2 triangles without area"));
  EXPECT_THAT(warnings(model), HasSubstr("2 faces that name vertices that are not there"));
  EXPECT_THAT(warnings(model), HasSubstr("1 faces with less than 3 corners"));
  test::write(folder / "points.obj", kSquare);
  EXPECT_THAT(test::refusal(folder / "points.obj"), HasSubstr("points.obj: it holds 4 points and no faces"));
}

TEST(Obj, ColoursOfVerticesAreNamed) {
  const test::TemporaryFolder folder;
  const std::string face = "f 1 2 3\n";
  EXPECT_EQ(warnings(obj(folder, "v 0 0 0 1 # a weight 2 3\nv 1 0 0\nv 0 1 0\n" + face)), "");
  EXPECT_EQ(warnings(obj(folder, "v 0 0 0\nv 1 0 0 .5  .5 1 \nv 0 1 0\n" + face)),
            "Passed over: the vertices' colours.\n");
}

/// An L turned out of its plane, as one polygon: its reflex corner makes a plain fan wrong.
TEST(Polygons, ConcaveOnesKeepTheirAreaAndWinding) {
  const std::vector<glm::dvec2> outline{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (std::size_t first = 0; first < outline.size(); ++first) { // whatever corner comes first
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec2& p = outline[(first + i) % outline.size()];
      corners.emplace_back(p.x * 0.6, p.y, p.x * 0.8);
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    EXPECT_TRUE(PolygonCutter().cut(corners, triangles));
    ASSERT_EQ(triangles.size(), 4U);
    double total = 0.0;
    for (const auto& [a, b, c] : triangles) {
      const glm::dvec3 area = 0.5 * glm::cross(corners[b] - corners[a], corners[c] - corners[a]);
      EXPECT_GT(glm::dot(area, glm::dvec3(-0.8, 0.0, 0.6)), 0.0); // the polygon's own side
      total += glm::length(area);
    }
    EXPECT_NEAR(total, 5.0, 1e-12);
  }
}

/// A comb with many teeth: its convex corners have other corners behind them. Only triangles that neither overlap nor
/// leave the comb have its area in all without one that is turned round.
TEST(Polygons, CombsWithManyTeethAreCutExactly) {
  constexpr int kTeeth = 100;
  std::vector<glm::dvec3> corners{{0.0, 7.0, 0.0}, {kTeeth, 7.0, 0.0}};
  for (int i = kTeeth; i > 0; --i) {
    corners.emplace_back(i, 7.0, -5.0);
    corners.emplace_back(i - 0.5, 7.0, -0.1);
  }
  corners.emplace_back(0.0, 7.0, -5.0);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  EXPECT_TRUE(PolygonCutter().cut(corners, triangles));
  ASSERT_EQ(triangles.size(), corners.size() - 2);
  double total = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double area = 0.5 * glm::cross(corners[b] - corners[a], corners[c] - corners[a]).y;
    EXPECT_GE(area, 0.0);
    total += area;
  }
  EXPECT_NEAR(total, kTeeth * (5.0 - 0.5 * 4.9), 1e-9);
}

TEST(Polygons, OnesThatCrossThemselvesAreCutAsFans) {
  const std::vector<glm::dvec3> bow{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}; // its vector area is 0
  std::vector<std::array<std::uint32_t, 3>> triangles;
  EXPECT_FALSE(PolygonCutter().cut(bow, triangles));
  EXPECT_EQ(triangles.size(), 2U);
}

std::string plyHeader(const std::string& format, int vertices, int faces) {
  return "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
         "property float nz\nproperty float s\nproperty float t\nelement face " +
         std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

const float kPlyVertices[4][8] = {
    {0, 0, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 0, 1, 1, 0}, {1, 1, 0, 0, 0, 1, 1, 0.75F}, {0, 1, 0, 0, 0, 1, 0, 1}};

/// The square in an encoding; values are turned round for the big end.
std::string plySquare(const std::string& format) {
  std::string file = plyHeader(format, 4, 1);
  const auto put = [&](auto value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    if (format == "binary_big_endian") {
      std::reverse(bytes, bytes + sizeof(value));
    }
    file.append(bytes, sizeof(value));
  };
  for (const auto& vertex : kPlyVertices) {
    for (const float value : vertex) {
      if (format == "ascii") {
        file += std::to_string(value) + " ";
      } else {
        put(value);
      }
    }
  }
  if (format == "ascii") {
    return file + "\n4 0 1 2 3";
  }
  file += '\4';
  for (int i = 0; i < 4; ++i) {
    put(i);
  }
  return file;
}

TEST(Ply, TheThreeEncodingsHoldTheSame) {
  const test::TemporaryFolder folder;
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const Model model = loadModel(test::write(folder / "square.ply", plySquare(format)));
    const Mesh& mesh = model.meshes[0];
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}})) << format;
    EXPECT_EQ(mesh.positions[2], glm::vec3(1.0F, 1.0F, 0.0F)) << format;
    EXPECT_EQ(mesh.normals[3], glm::vec3(0.0F, 0.0F, 1.0F)) << format;
    EXPECT_EQ(mesh.uvs[2], glm::vec2(1.0F, 0.25F)) << format;
    EXPECT_EQ(warnings(model), "") << format;
  }
}

TEST(Ply, CountsThatTheFileCannotHoldAreRefused) {
  const test::TemporaryFolder folder;
  std::string file = plySquare("binary_little_endian");
  file.replace(file.find("vertex 4"), 8, "vertex 4000000000");
  EXPECT_THAT(test::refusal(test::write(folder / "huge.ply", file)), HasSubstr("announces 4000000000 of \"vertex\""));
  file = plySquare("ascii");
  file.replace(file.find("\n4 0 1"), 6, "\n4000000000 0 1");
  EXPECT_THAT(test::refusal(test::write(folder / "list.ply", file)), HasSubstr("a list of 4000000000 values"));
  file = plySquare("ascii");
  EXPECT_THAT(test::refusal(test::write(folder / "cut.ply", file.substr(0, file.size() - 5))),
              HasSubstr("which the file cannot hold"));
  EXPECT_THAT(test::refusal(test::write(folder / "points.ply", plyHeader("ascii", 0, 0))), HasSubstr("no faces"));
}

} // namespace
} // namespace tyndall::geometry

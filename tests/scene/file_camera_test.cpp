// SPDX-License-Identifier: Apache-2.0
// Cameras that a scene takes from a glTF file.
#include "support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace tyndall::scene {
namespace {

/// A triangle and two cameras: "front" stands at (0, 0, 5) as it is, "side" at (7, 0, 0) turned by 90 degrees about +y.
constexpr const char* kModel = R"({
  "asset": {"version": "2.0"}, "scene": 0,
  "scenes": [{"nodes": [0, 1, 2]}],
  "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5]},
            {"camera": 1, "translation": [7, 0, 0], "rotation": [0, 0.70710678118, 0, 0.70710678118]}],
  "cameras": [{"name": "front", "type": "perspective", "perspective": {"yfov": 0.7853981634, "znear": 0.1}},
              {"name": "side", "type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1.5, "znear": 0.1, "zfar": 9}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
})";

class FileCamera : public testing::Test {
protected:
  void SetUp() override { std::ofstream(test::folder() / "cameras.gltf") << kModel; }

  static LoadResult parse(const std::string& camera) { return test::parse("{\"camera\": " + camera + "}"); }
};

void expectNear(const glm::dvec3& value, const glm::dvec3& expected) {
  EXPECT_LT(glm::length(value - expected), 1e-6) << value.x << ' ' << value.y << ' ' << value.z;
}

TEST_F(FileCamera, TheFirstOneIsTaken) {
  const LoadResult result = parse(R"({"type": "file", "file": "cameras.gltf"})");
  ASSERT_TRUE(result.ok()) << test::listed(result);
  const Camera& camera = result.scene.camera;
  EXPECT_EQ(camera.kind, Camera::Kind::Perspective);
  expectNear(camera.position, {0, 0, 5});
  expectNear(camera.target, {0, 0, 4});
  EXPECT_NEAR(camera.verticalFov, 45.0, 1e-4);
}

TEST_F(FileCamera, AnotherOneByItsName) {
  const LoadResult result = parse(R"({"type": "file", "file": "cameras.gltf", "name": "side"})");
  ASSERT_TRUE(result.ok()) << test::listed(result);
  const Camera& camera = result.scene.camera;
  EXPECT_EQ(camera.kind, Camera::Kind::Orthographic);
  expectNear(camera.position, {7, 0, 0});
  expectNear(camera.target, {6, 0, 0}); // -z turned by 90 degrees about +y
  expectNear(camera.up, {0, 1, 0});
  EXPECT_NEAR(camera.height, 3.0, 1e-6);
}

TEST_F(FileCamera, WhatIsWrongIsSaid) {
  using testing::HasSubstr;
  EXPECT_THAT(test::listed(parse(R"({"type": "file", "file": "cameras.gltf", "name": "top"})")),
              HasSubstr("which has \"front\", \"side\""));
  EXPECT_THAT(test::listed(parse(R"({"type": "file"})")), HasSubstr("camera.file"));
  EXPECT_THAT(test::listed(parse(R"({"type": "file", "file": "cameras.gltf", "position": [0, 0, 1]})")),
              HasSubstr("camera.position"));
  std::ofstream(test::folder() / "broken.gltf") << "{";
  EXPECT_THAT(test::listed(parse(R"({"type": "file", "file": "broken.gltf"})")), HasSubstr("camera.file"));
}

} // namespace
} // namespace tyndall::scene

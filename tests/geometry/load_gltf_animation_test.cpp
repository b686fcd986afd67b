// SPDX-License-Identifier: Apache-2.0
// Nodes of glTF stand where their animations have them at a time.
#include "geometry/mesh_files.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace tyndall::geometry {
namespace {

/// Keys of one channel of the square's node.
struct Keys {
  std::string path = "translation";
  std::string interpolation = "LINEAR";
  std::vector<float> times;
  std::vector<float> values;
  std::string node = R"({"mesh":0})";
};

void replace(std::string& text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
}

/// The file of a square that moves.
std::filesystem::path moving(const std::filesystem::path& folder, const Keys& keys) {
  std::string bytes((keys.times.size() + keys.values.size()) * sizeof(float), '\0');
  const std::size_t split = keys.times.size() * sizeof(float);
  std::memcpy(bytes.data(), keys.times.data(), split);
  std::memcpy(bytes.data() + split, keys.values.data(), bytes.size() - split);
  test::write(folder / "keys.bin", bytes);
  test::write(folder / "square.bin", test::squareBuffer());
  const std::size_t components = keys.path == "rotation" ? 4 : 3;
  std::string text = test::squareGltf(
      test::squareMesh() + R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":")" + keys.path +
      R"("}}],"samplers":[{"input":4,"output":5,"interpolation":")" + keys.interpolation + R"("}]}])");
  replace(text, R"({"mesh":0})", keys.node);
  replace(text, R"("uri":"square.bin"})",
          R"("uri":"square.bin"},{"uri":"keys.bin","byteLength":)" + std::to_string(bytes.size()) + "}");
  replace(text, R"("byteOffset":128,"byteLength":12})",
          R"("byteOffset":128,"byteLength":12},{"buffer":1,"byteLength":)" + std::to_string(split) +
              R"(},{"buffer":1,"byteOffset":)" + std::to_string(split) + R"(,"byteLength":)" +
              std::to_string(bytes.size() - split) + "}");
  replace(text, R"("count":6,"type":"SCALAR"})",
          R"("count":6,"type":"SCALAR"},{"bufferView":4,"componentType":5126,"type":"SCALAR","count":)" +
              std::to_string(keys.times.size()) + R"(},{"bufferView":5,"componentType":5126,"type":"VEC)" +
              std::to_string(components) + R"(","count":)" + std::to_string(keys.values.size() / components) + "}");
  return test::write(folder / "moving.gltf", text);
}

class GltfAnimation : public testing::Test {
protected:
  glm::dmat4 at(const Keys& keys, double seconds) const {
    const Model model = loadModel(moving(folder_.path(), keys), seconds);
    EXPECT_EQ(test::warnings(model), "");
    return model.nodes.at(0).worldFromObject;
  }
  void expectPlace(const Keys& keys, double seconds, const glm::dvec3& place) const {
    const glm::dvec3 found(at(keys, seconds)[3]);
    EXPECT_LT(glm::distance(found, place), 1e-6) << keys.interpolation << " at " << seconds << ": " << found.x;
  }

  test::TemporaryFolder folder_;
};

const Keys kLinear{.times = {1.0f, 2.0f, 4.0f}, .values = {0, 0, 0, 1, 2, 3, 1, 2, 7}};

TEST_F(GltfAnimation, LinearKeysAreInterpolatedAndHeldBeyond) {
  expectPlace(kLinear, 0.0, {0, 0, 0});
  expectPlace(kLinear, 1.25, {0.25, 0.5, 0.75});
  expectPlace(kLinear, 2.0, {1, 2, 3});
  expectPlace(kLinear, 3.0, {1, 2, 5});
  expectPlace(kLinear, 9.0, {1, 2, 7});
}

TEST_F(GltfAnimation, StepsAreHeld) {
  Keys keys = kLinear;
  keys.interpolation = "STEP";
  expectPlace(keys, 1.99, {0, 0, 0});
  expectPlace(keys, 2.0, {1, 2, 3});
  expectPlace(keys, 3.99, {1, 2, 3});
}

TEST_F(GltfAnimation, CubicSplinesHaveTheirTangents) {
  // One cubic, x = s^3 of the seconds, from 1 to 3: its values and slopes at the keys give it back everywhere.
  Keys keys;
  keys.interpolation = "CUBICSPLINE";
  keys.times = {1.0f, 3.0f};
  keys.values = {9, 9, 9, 1, 0, 0, 3, 0, 0, 27, 0, 0, 27, 0, 0, 9, 9, 9};
  for (const double seconds : {1.0, 1.5, 2.0, 2.75, 3.0}) {
    const glm::dvec3 place(at(keys, seconds)[3]);
    EXPECT_NEAR(place.x, std::pow(seconds, 3.0), 1e-5) << seconds;
  }
}

TEST_F(GltfAnimation, TurnsTakeTheShortWayAtConstantSpeed) {
  const float half = std::sqrt(0.5f);
  Keys keys{.path = "rotation", .times = {0.0f, 1.0f}, .values = {0, 0, 0, 1, 0, 0, -half, -half}}; // 90 about z
  for (const double share : {0.0, 0.25, 1.0 / 3.0, 1.0}) {
    const glm::dvec3 x(at(keys, share)[0]);
    EXPECT_NEAR(std::atan2(x.y, x.x), share * std::acos(0.0), 1e-6) << share;
  }
}

TEST_F(GltfAnimation, WhatTheNodeHasBesideStays) {
  Keys keys{.path = "scale", .times = {0.0f, 1.0f}, .values = {1, 1, 1, 3, 3, 3}};
  keys.node = R"({"mesh":0,"translation":[5,6,7]})";
  const glm::dmat4 place = at(keys, 0.5);
  EXPECT_EQ(place[3], glm::dvec4(5, 6, 7, 1));
  EXPECT_NEAR(place[1][1], 2.0, 1e-6);
}

TEST_F(GltfAnimation, WhatCannotBeFollowedIsSaid) {
  Keys keys = kLinear;
  keys.node = R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,8,0,0,1]})";
  Keys tooFew = kLinear;
  tooFew.values.resize(6);
  for (const Keys& bad : {keys, tooFew}) {
    const Model model = loadModel(moving(folder_.path(), bad), 2.0);
    EXPECT_THAT(test::warnings(model), testing::HasSubstr("1 channels of animations are passed over"));
    EXPECT_EQ(model.nodes.at(0).worldFromObject[3].x, bad.node == keys.node ? 8.0 : 0.0);
  }
}

} // namespace
} // namespace tyndall::geometry

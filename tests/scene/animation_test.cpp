// SPDX-License-Identifier: Apache-2.0
// What moves stands where its tracks say; a track that cannot be followed is reported where it stands.
#include "scene/marked.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tyndall::scene {
namespace {

using test::expectOne;
using test::listed;
using test::Malformed;
using testing::HasSubstr;

/// A scene with one of each that tracks may move.
std::string moving(const std::string& tracks) {
  return R"({"media": [{"name": "fog", "type": "homogeneous", "extinction": 1, "shape": {"type": "sphere"}}],
 "lights": [{"name": "lamp", "type": "point", "position": [7, 7, 7]}, {"name": "map", "type": "map", "file": "sky.exr"}],
 "objects": [{"name": "ball", "type": "sphere", "transform": [{"translate": [9, 9, 9]}, {"scale": 2}]}],
 "animation": {"tracks": [
  )" + tracks +
         "]}}";
}

LoadResult at(const std::string& text, double frame, const std::vector<Override>& overrides = {}) {
  return parseScene(text, "test.json", test::folder(), overrides, frame);
}

glm::dvec3 lampOf(const LoadResult& result) { return std::get<PointLight>(result.scene.lights[0].light).position; }

constexpr const char* kLamp =
    R"({"target": "lights.lamp.position", "keys": [[2, [0, 1, 2]], [4, [4, 1, 0]], [8, [4, 5, 0]]]})";

TEST(Animation, InterpolatesBetweenKeysAndHoldsBeyondThem) {
  const std::vector<std::pair<double, glm::dvec3>> expected{{-5, {0, 1, 2}}, {2, {0, 1, 2}}, {2.5, {1, 1, 1.5}},
                                                            {3, {2, 1, 1}},  {4, {4, 1, 0}}, {5, {4, 2, 0}},
                                                            {7, {4, 4, 0}},  {8, {4, 5, 0}}, {1e9, {4, 5, 0}}};
  for (const auto& [frame, position] : expected) {
    const LoadResult result = at(moving(kLamp), frame);
    ASSERT_TRUE(result.ok()) << listed(result);
    EXPECT_EQ(lampOf(result), position) << frame; // powers of two: exact
  }
}

TEST(Animation, StepsHoldAnythingUntilTheNextKey) {
  const std::string text = moving(R"({"target": "objects.0", "interpolation": "step", "keys": [
    [1, {"type": "sphere", "radius": 3}], [5, {"type": "quad"}]]})");
  EXPECT_EQ(at(text, 4.999).scene.objects[0].radius, 3.0);
  EXPECT_EQ(at(text, 4.999).scene.objects[0].kind, Object::Kind::Sphere);
  EXPECT_EQ(at(text, 5).scene.objects[0].kind, Object::Kind::Quad);
  const std::string numbers =
      moving(R"({"target": "objects.0.radius", "interpolation": "step", "keys": [[1, 1], [5, 3]]})");
  EXPECT_EQ(at(numbers, 4.999).scene.objects[0].radius, 1.0);
}

TEST(Animation, MovesWhatAFileDoesNotMention) {
  const std::string text = moving(R"({"target": "camera.position", "keys": [[1, [0, 0, 5]], [3, [0, 0, 9]]]},
    {"target": "media.fog.phase.type", "interpolation": "step", "keys": [[1, "rayleigh"]]},
    {"target": "film.size", "keys": [[1, [10, 20]], [3, [20, 40]]]})");
  const LoadResult result = at(text, 2);
  ASSERT_TRUE(result.ok()) << listed(result);
  EXPECT_EQ(result.scene.camera.position, glm::dvec3(0, 0, 7));
  EXPECT_EQ(result.scene.media[0].phase.id, PhaseId::Rayleigh);
  EXPECT_EQ(result.scene.film.size, glm::uvec2(15, 30));
}

TEST(Animation, IsReadAtFrameOneUnlessAskedOtherwise) {
  const std::string text = moving(R"({"target": "lights.0.position", "keys": [[0, [0, 0, 0]], [4, [4, 0, 0]]]})");
  EXPECT_EQ(lampOf(test::parse(text)), glm::dvec3(1, 0, 0));
}

TEST(Animation, TheCommandLineHasTheLastWord) {
  const std::vector<Override> overrides{{"lights.0.position", "[3, 3, 3]"},
                                        {"lights.lamp.position", "[3, 3, 3]"},
                                        {"lights.lamp.position.1", "3"},
                                        {"lights.lamp", R"({"name": "lamp", "type": "point", "position": [3, 3, 3]})"}};
  for (const Override& override : overrides) {
    const LoadResult result = at(moving(kLamp), 3, {override});
    ASSERT_TRUE(result.ok()) << listed(result);
    EXPECT_EQ(lampOf(result)[1], 3.0) << override.path;
    EXPECT_TRUE(result.scene.animation.tracks.empty()) << "a scene written out has the same picture";
  }
  const LoadResult gone = at(moving(kLamp), 3, {{"lights", R"([{"type": "constant"}])"}});
  EXPECT_TRUE(gone.ok()) << listed(gone);
  const LoadResult empty = at(moving(R"({"target": "objects.ball.transform.0.translate", "keys": [[1, [1, 2, 3]]]})"),
                              3, {{"objects.0.transform", "[]"}});
  EXPECT_TRUE(empty.ok()) << listed(empty);
  const LoadResult beside = at(moving(kLamp), 3, {{"lights.lamp.intensity", "5"}});
  EXPECT_EQ(lampOf(beside), glm::dvec3(2, 1, 1)) << "what it leaves alone moves on";
  const LoadResult keys = at(moving(kLamp), 3, {{"animation.tracks.0.keys.1.1", "[8, 1, 0]"}});
  EXPECT_EQ(lampOf(keys), glm::dvec3(4, 1, 1));
}

TEST(Animation, WrittenOutItMovesTheSame) {
  const std::string text = moving(std::string(kLamp) + R"(,
    {"target": "objects.ball.transform.0.translate", "keys": [[1, [1, 0, 0]], [9, [9, 0, 8]]]},
    {"target": "lights.map.file", "interpolation": "step", "keys": [[1, "sky.exr"], [5, "./sky.exr"]]})");
  const LoadResult first = at(text, 6);
  ASSERT_TRUE(first.ok()) << listed(first);
  ASSERT_TRUE(nlohmann::json::accept(first.canonical));
  for (const std::filesystem::path& folder : {test::folder(), test::folder().parent_path()}) {
    const std::string written = toJson(first.scene, folder);
    for (const double frame : {1.0, 4.0, 6.0, 9.0}) {
      const LoadResult again = parseScene(written, "test.json", folder, {}, frame);
      ASSERT_TRUE(again.ok()) << listed(again);
      EXPECT_EQ(lampOf(again), lampOf(at(text, frame)));
      EXPECT_EQ(again.scene.objects[0].worldFromObject, at(text, frame).scene.objects[0].worldFromObject) << frame;
      EXPECT_TRUE(std::filesystem::equivalent(std::get<MapEnvironment>(again.scene.lights[1].light).file,
                                              test::folder() / "sky.exr"));
    }
  }
  EXPECT_EQ(at(first.canonical, 6).canonical, first.canonical);
}

TEST(Animation, FilesPlayAtItsSpeed) {
  EXPECT_EQ(at(moving(kLamp), 12).scene.animation.seconds, 0.5);
  EXPECT_EQ(at(R"({"animation": {"frames_per_second": 10}})", 12).scene.animation.seconds, 1.2);
  EXPECT_EQ(at("{}", 48).scene.animation.seconds, 2.0) << "24 frames a second unless it says otherwise";
}

TEST(Animation, KeyFramesAreListedOnce) {
  const std::string text = moving(std::string(kLamp) + R"(,
    {"target": "lights.lamp.intensity", "keys": [[-1, 1], [4, 2]]})");
  EXPECT_EQ(keyFrames(test::parse(text).scene.animation), (std::vector<double>{-1, 2, 4, 8}));
}

TEST(AnimationProblems, AreReportedWhereTheyStand) {
  const std::vector<Malformed> cases{
      {R"(@{"target": "name"})", "animation.tracks.0.keys: is missing; add \"keys\""},
      {R"({"target": "lights.lamp.position", "keys": @[]})", "has no key; give at least one"},
      {R"({"target": "lights.lamp.position", "keys": @3})", "must be a list"},
      {R"({"target": "lights.lamp.position", "keys": [@[1]]})", "keys.0: must be a frame and the value there"},
      {R"({"target": "lights.lamp.position", "keys": [[@"1", 2]]})", "keys.0.0: must be the number of a frame"},
      {R"({"target": "lights.lamp.intensity", "keys": [[3, 1], [@3, 2]]})",
       "keys.1.0: must be above 3, the frame of the key before it, not 3; sort the keys"},
      {R"({"target": "lights.lamp.intensity", "keys": [[3, 1], [5, @[1, 2, 3]]]})",
       "keys.1.1: must be of the shape of the first key's value, 1, not a list of 3"},
      {R"({"target": "lights.lamp.position", "keys": [[3, [1, 2, 3]], [5, @[1, 2]]]})",
       "the first key's value, a list of 3, not a list of 2"},
      {R"({"target": "lights.map.file", "keys": [[3, @"sky.exr"]]})", "write \"interpolation\": \"step\""},
      {R"({"target": "lights.lamp.position", "interpolation": @"cubic", "keys": [[1, [1, 2, 3]]]})",
       "must be \"linear\" or \"step\""},
      {R"({"target": @"lights.lmap.position", "keys": [[1, [1, 2, 3]]]})",
       "animation.tracks.0.target: there is no element \"lmap\": there is 0 (\"lamp\"), 1 (\"map\")"},
      {R"({"target": @"lights.lamp.positon", "keys": [[1, [1, 2, 3]]]})",
       "lights.0.positon: is not a known key; did you mean \"position\"?"},
      {R"({"target": @"lights.lamp.position.x", "keys": [[1, 5]]})", "there is no element \"x\""},
      {R"({"target": @"animation.frames_per_second", "keys": [[1, 5]]})", "is part of the animation itself"},
      {R"({"target": "lights.0.position", "keys": [[1, [1, 2, 3]]]},
          {"target": @"lights.lamp.position", "keys": [[1, [1, 2, 3]]]})",
       "animation.tracks.1.target: is that of animation.tracks.0.target too; join their keys"},
      {R"({"target": "objects.ball.radius", "keys": [[1, @-5], [3, 1]]})",
       "objects.0.radius: must be a number above 0"},
      {R"({"target": "lights.map.file", "interpolation": "step", "keys": [[1, @"no.exr"]]})", "there is no file"},
  };
  for (const Malformed& malformed : cases) {
    expectOne(moving(malformed.text), malformed.message, false);
  }
}

/// What is no JSON was reported by the parser, and nothing is said or done about the track that it stood in.
TEST(AnimationProblems, TextThatIsNoJsonIsReportedOnce) {
  const std::vector<std::string> keys{"@+", "[@+]", "[[@+, [1, 2, 3]]]", "[[1, @+]]",
                                      "[[1, [1, 2, 3]], [2, [1, 2, @+]]]"};
  for (const std::string& broken : keys) {
    expectOne(moving(R"({"target": "lights.lamp.position", "keys": )" + broken + "}"), "+ is not a number", false);
  }
}

TEST(AnimationProblems, EveryFrameIsValidated) {
  const std::string text = moving(R"({"target": "film.size", "keys": [[1, [10, 10]], [11, [20, 20]]]})");
  EXPECT_TRUE(at(text, 3).ok());
  EXPECT_THAT(listed(at(text, 2.5)), HasSubstr("must be two whole numbers"));
  const std::string shrinking = moving(R"({"target": "objects.ball.radius", "keys": [[1, 1], [2, -1]]})");
  EXPECT_TRUE(at(shrinking, 1).ok());
  EXPECT_FALSE(at(shrinking, 2).ok());
}

} // namespace
} // namespace tyndall::scene

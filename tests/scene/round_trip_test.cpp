// SPDX-License-Identifier: Apache-2.0
// Values arrive, canonical text reads back to the same scene, overrides change what they name.
#include "scene/support.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tyndall::scene {
namespace {

using test::everything;
using test::listed;
using test::parse;
using testing::HasSubstr;

TEST(SceneValues, ArriveInTheirUnits) {
  const LoadResult result = parse(everything());
  ASSERT_TRUE(result.problems.empty()) << listed(result);
  const Scene& scene = result.scene;
  EXPECT_EQ(scene.name, "everything, \"quoted\" \xc3\xa9\xf0\x9f\x98\x80");
  EXPECT_EQ(scene.camera.position, glm::dvec3(1.5, 2, 10));
  EXPECT_EQ(scene.camera.up, glm::dvec3(0, 1, 0)) << "directions are normalised";
  EXPECT_EQ(scene.camera.verticalFov, 37.5);
  EXPECT_EQ(scene.film.size, glm::uvec2(321, 240));
  EXPECT_EQ(scene.film.view, View::Filmic);
  EXPECT_TRUE(scene.film.transparent);
  EXPECT_EQ(scene.render.seed, 4294967295u);
  ASSERT_EQ(scene.media.size(), 7u);
  const Medium& smoke = scene.media[0];
  EXPECT_EQ(smoke.file, (test::folder() / "smoke.vdb").string());
  EXPECT_EQ(smoke.clip->max, glm::dvec3(1, 2, 3));
  EXPECT_EQ(smoke.phase.id, PhaseId::TwoLobe);
  EXPECT_EQ(smoke.phase.parameters, (std::array{0.7, -0.2, 0.6, 0.0}));
  EXPECT_EQ(smoke.emission->temperatureOffset, 273.15);
  EXPECT_FALSE(smoke.homogeneous());
  EXPECT_EQ(scene.media[1].emission->colour, glm::dvec3(2)) << "one number stands for all three";
  EXPECT_EQ(scene.media[2].box.min, glm::dvec3(-1));
  EXPECT_EQ(scene.media[2].emission->temperature, 2500.0);
  EXPECT_EQ(scene.media[3].radius, 0.25);
  EXPECT_EQ(std::get<PointLight>(scene.lights[0].light).intensity, glm::dvec3(1e12));
  EXPECT_NEAR(glm::length(std::get<SunLight>(scene.lights[1].light).direction), 1.0, 1e-15);
  EXPECT_FALSE(scene.lights[2].visible);
  EXPECT_EQ(std::get<MapEnvironment>(scene.lights[3].light).rotation, -30.0);
  EXPECT_EQ(std::get<SkyEnvironment>(scene.lights[4].light).groundAlbedo, glm::dvec3(0, 0.5, 1));
}

TEST(SceneValues, TransformStepsApplyInTheOrderWritten) {
  const LoadResult result = parse(everything());
  glm::dmat4 shear(1.0); // GLM counts columns first
  shear[1][0] = 0.5;
  shear[3] = glm::dvec4(4, 5, 6, 1);
  const glm::dmat4 rotation = glm::rotate(glm::dmat4(1.0), glm::radians(33.3), glm::normalize(glm::dvec3(1, 2, 3)));
  const glm::dmat4 scaling = glm::scale(glm::dmat4(1.0), glm::dvec3(0.1));
  const glm::dmat4 translation = glm::translate(glm::dmat4(1.0), glm::dvec3(1, 2, 3));
  const glm::dmat4 expected = shear * translation * scaling * rotation;
  for (int column = 0; column < 4; ++column) {
    EXPECT_LT(glm::length(result.scene.media[0].worldFromMedium[column] - expected[column]), 1e-14) << column;
  }
  const LoadResult turned =
      parse(everything(), {{"media.0.transform", R"([{"rotate": {"axis": [0, 0, 9], "degrees": 90}}])"}});
  const glm::dvec4 image = turned.scene.media[0].worldFromMedium * glm::dvec4(1, 0, 0, 1);
  EXPECT_LT(glm::length(image - glm::dvec4(0, 1, 0, 1)), 1e-15) << "+90 degrees about +z takes +x to +y";
}

TEST(SceneRoundTrip, CanonicalTextIsAFixedPoint) {
  const LoadResult first = parse(everything());
  ASSERT_TRUE(first.ok());
  const LoadResult second = parse(first.canonical);
  ASSERT_TRUE(second.problems.empty()) << listed(second);
  EXPECT_EQ(second.canonical, first.canonical);
  EXPECT_EQ(toJson(second.scene), toJson(first.scene));
  EXPECT_EQ(second.scene.media[0].worldFromMedium, first.scene.media[0].worldFromMedium);
  EXPECT_TRUE(nlohmann::json::accept(first.canonical));
}

TEST(SceneRoundTrip, NumbersSurviveToTheLastBit) {
  Scene scene = parse(everything()).scene;
  double number = 1.0 / 3.0;
  for (int i = 0; i < 200; ++i) {
    number = std::fmod(number * 97.13, 1.0);
    scene.media[2].albedo = glm::dvec3(number, number * 1e-9, std::nextafter(number, 0.0));
    scene.media[2].sigmaT = number * std::pow(10.0, i % 16 - 8);
    scene.lights[1].light = SunLight{.direction = glm::normalize(glm::dvec3(number, -number * number, 0.3))};
    const LoadResult read = parse(toJson(scene));
    ASSERT_TRUE(read.ok()) << listed(read);
    EXPECT_EQ(read.scene.media[2].albedo, scene.media[2].albedo);
    EXPECT_EQ(read.scene.media[2].sigmaT, scene.media[2].sigmaT);
    EXPECT_EQ(std::get<SunLight>(read.scene.lights[1].light).direction,
              std::get<SunLight>(scene.lights[1].light).direction);
  }
}

TEST(SceneRoundTrip, FileNamesFollowTheFolder) {
  const Scene scene = parse(everything()).scene;
  EXPECT_THAT(toJson(scene, test::folder()), HasSubstr("\"file\": \"smoke.vdb\""));
  EXPECT_THAT(toJson(scene, test::folder() / "deeper"), HasSubstr("\"file\": \"../smoke.vdb\""));
  EXPECT_THAT(toJson(scene), HasSubstr("\"file\": \"" + (test::folder() / "smoke.vdb").string() + "\""));
}

TEST(SceneRoundTrip, CanonicalTellsScenesApart) {
  const std::string canonical = parse(everything()).canonical;
  EXPECT_EQ(parse("// a comment\n" + everything()).canonical, canonical);
  EXPECT_NE(parse(everything(), {{"render.seed", "7"}}).canonical, canonical);
}

TEST(SceneDefaults, AnEmptyObjectIsAScene) {
  const LoadResult result = parse("{}");
  EXPECT_TRUE(result.ok()) << listed(result);
  EXPECT_EQ(result.problems.size(), 2u) << "no lights, no media: warnings";
  EXPECT_EQ(result.scene.name, "test") << "the file's name";
  EXPECT_EQ(result.scene.film.size, FilmSettings{}.size);
}

TEST(SceneDefaults, SequencesNeedOnlyTheirFolder) {
  const LoadResult result = parse(everything(), {{"media.0.file", (test::folder() / "smoke_####.vdb").string()}});
  EXPECT_TRUE(result.ok()) << listed(result);
}

TEST(SceneOverrides, ChangeWhatTheyName) {
  const LoadResult result = parse(everything(), {{"film.size", "[32, 24]"},
                                                 {"media.0.density_scale", "2"},
                                                 {"media.box.albedo", "0.25"},
                                                 {"lights.sun.irradiance", "3"},
                                                 {"lights.1.visible", "true"},
                                                 {"film.view", "standard"},
                                                 {"name", "\"quoted\""},
                                                 {"media.6.emission.type", "linear"},
                                                 {"media.6.extinction", "1"},
                                                 {"lights", R"([{"type": "point"}])"}});
  ASSERT_TRUE(result.ok()) << listed(result);
  EXPECT_EQ(result.scene.film.size, glm::uvec2(32, 24));
  EXPECT_EQ(result.scene.media[0].densityScale, 2.0);
  EXPECT_EQ(result.scene.media[2].albedo, glm::dvec3(0.25));
  EXPECT_EQ(result.scene.film.view, View::Standard);
  EXPECT_EQ(result.scene.name, "quoted");
  EXPECT_TRUE(result.scene.media[6].emission.has_value()) << "objects on the way are made";
  EXPECT_EQ(result.scene.lights.size(), 1u);
}

TEST(SceneOverrides, AreNamedInMessages) {
  struct Case {
    Override override;
    const char* message;
  };
  const std::vector<Case> cases{
      {{"film.size", "big"}, "--set film.size=big: film.size: must be two whole numbers"},
      {{"film.siez", "[1, 2]"}, "--set film.siez=[1, 2]: film.siez: is not a known key; did you mean \"size\"?"},
      {{"lights.moon.scale", "1"}, "there is no element \"moon\": there is 0 (\"lamp\"), 1 (\"sun\")"},
      {{"media.17.albedo", "1"}, "there is no element \"17\""},
      {{"name.x", "1"}, "\"x\" has no keys: what stands before it is the text"},
      {{"film.size", "[1, 2"}, "the value cannot be read: the file ends"},
      {{"film..size", "1"}, "a path is keys joined by dots"},
      {{"", "1"}, "a path is keys joined by dots"},
      {{"media.0.file", "nothing.vdb"}, "there is no file nothing.vdb"},
      {{"film.exposure", "NaN"}, "film.exposure: must be a number"},
  };
  for (const Case& broken : cases) {
    const LoadResult result = parse(everything(), {broken.override});
    EXPECT_FALSE(result.ok()) << broken.message;
    ASSERT_EQ(result.problems.size(), 1u) << listed(result);
    EXPECT_THAT(listed(result), HasSubstr(broken.message));
    EXPECT_THAT(listed(result), HasSubstr("--set " + broken.override.path + "=" + broken.override.value + ": "));
  }
}

} // namespace
} // namespace tyndall::scene

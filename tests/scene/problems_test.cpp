// SPDX-License-Identifier: Apache-2.0
// Every kind of mistake is found where it stands. In the texts below, @ marks where the problem must be reported.
#include "scene/marked.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace tyndall::scene {
namespace {

using test::expectOne;
using test::listed;
using test::Malformed;
using test::parse;

constexpr const char* kMedia = R"("media": [{"type": "homogeneous", "extinction": 1}], )";
constexpr const char* kLights = R"("lights": [{"type": "point"}])";

/// A member of an otherwise sound scene.
std::string inScene(const std::string& member) {
  return std::string("{") + kMedia + kLights + ",\n  " + member + "\n}";
}
std::string inMedium(const std::string& member) {
  return std::string("{") + kLights + ",\n \"media\": [\n  {" + member + "}]}";
}
std::string inLight(const std::string& member) {
  return "{\"media\": [{\"type\": \"homogeneous\", \"shape\": {\"type\": \"sphere\"}}],\n \"lights\": [\n  {" + member +
         "}]}";
}

TEST(SceneProblems, TheFramesAroundTheCasesAreSound) {
  for (const std::string& text :
       {inScene(R"("name": "a")"), inMedium(R"("type": "homogeneous")"), inLight(R"("type": "point")")}) {
    const LoadResult result = parse(text);
    EXPECT_TRUE(result.problems.empty()) << listed(result);
  }
}

TEST(SceneProblems, MalformedText) {
  const std::string deep = std::string(64, '[') + "@[" + std::string(65, ']');
  const std::vector<Malformed> cases{
      {"@", "there is no JSON value"},
      {"  \n // only a comment\n@", "there is no JSON value"},
      {"@\xff\xfe{\x00", "the byte 0xff, which is not UTF-8"},
      {"@]", "a value is needed, not ']'"},
      {"{}\n @{}", "follows the end of the value"},
      {"/* a\n b@", "the comment that starts in line 1 is not closed"},
      {"{\"name\": \"a@", "is not closed"},
      {"{\"name\": \"a@\n\"}", "the text that starts in line 1, column 10 is not closed"},
      {"{\"name\": \"a@\tb\"}", "control character 0x09 may not stand in text; write \\u0009"},
      {"{\"name\": \"\xc3\xa9\xe2\x82\xac@\xc0\xaf\"}", "the byte 0xc0"},
      {"{\"name\": \"@\xed\xa0\x80\"}", "save the file as UTF-8"},
      {"{\"camera\": {\n@", "the file ends before the { of line 1, column 12 is closed; add }"},
      {"{\"media\": [@", "the file ends before the [ of line 1, column 11 is closed; add ]"},
      {"{\"media\": @", "a value is needed, not the end of the file"},
      {"{\"media\": [1@", "the file ends before the [ of line 1, column 11 is closed; add ]"},
      {"{\"media\": [1@}", "] or a comma is needed here, not '}'"},
      {"{\"name\" @\"x\"}", "':' is needed after the key \"name\""},
      {"{\"name\": @}", "a value is needed, not '}'"},
      {"{@5: 1}", "a key in double quotes is needed, not '5'"},
      {"{@, \"name\": 1}", "a key in double quotes is needed"},
      {deep.c_str(), "nested more than 64 levels deep"},
      {"@[1, 2]", "a scene must be an object, { ... }, not a list of 2"},
      {"@null", "a scene must be an object"},
  };
  for (const Malformed& malformed : cases) {
    expectOne(malformed.text, malformed.message, false);
  }
}

TEST(SceneProblems, SlipsInTheText) {
  const std::vector<Malformed> cases{
      {R"("name": "a",
  @"name": "b")",
       "the key \"name\" was already given in line 2, column 3"},
      {R"("name": "a" @"film": {})", "a comma is missing"},
      {R"(@name: "a")", "keys stand in double quotes: write \"name\""},
      {R"("name": @'a')", "write double quotes, not single quotes"},
      {R"("name" @= "a")", "write ':' between a key and its value"},
      {R"("name": @smoke)", "text stands in double quotes: write \"smoke\""},
      {R"("film": {"exposure": @NaN})", "NaN is not allowed"},
      {R"("film": {"exposure": @-Infinity})", "-Infinity is not a number"},
      {R"("film": {"exposure": @Infinity})", "Infinity is not allowed"},
      {R"("film": {"exposure": @.5})", ".5 is not a number"},
      {R"("film": {"exposure": @5.})", "5. is not a number"},
      {R"("film": {"exposure": @+5})", "+5 is not a number"},
      {R"("film": {"exposure": @007})", "007 is not a number"},
      {R"("film": {"exposure": @0x10})", "0x10 is not a number"},
      {R"("film": {"exposure": @1e})", "1e is not a number"},
      {R"("film": {"exposure": @1e999})", "1e999 is too large or too small"},
      {R"("film": {"size": [@1e999, 2]})", "1e999 is too large or too small"},
      {R"("film": {"transparent": @True})", "write true in place of True"},
      {R"("name": "a@\q")", "\\ before 'q' means nothing"},
      {R"("name": "a@\u12")", "four hexadecimal digits"},
      {R"("name": "@\ud800 alone")", "four hexadecimal digits"},
      {R"("name": "@\udc00")", "four hexadecimal digits"},
  };
  for (const Malformed& malformed : cases) {
    expectOne(inScene(malformed.text), malformed.message, false);
  }
}

TEST(SceneProblems, ValuesThatDoNotFit) {
  const std::vector<Malformed> cases{
      {R"(@"flim": {})", "flim: is not a known key; did you mean \"film\"?"},
      {R"(@"zzzzzzzz": {})", "is not a known key; here stand"},
      {R"("camera": @[1])", "camera: must be an object, { ... }, not a list of 1"},
      {R"("camera": {"type": @"fisheye"})", "must be \"perspective\", \"orthographic\" or \"file\", not the text \"fisheye\""},
      {R"("camera": {"type": @"perspectiv"})", "did you mean \"perspective\"?"},
      {R"("camera": {"position": @[1, 2]})", "camera.position: must be three numbers"},
      {R"("camera": {"position": [1, @"2", 3]})", "camera.position.1: must be a number, not the text \"2\""},
      {R"("camera": {"position": [1, 2, @2e9]})", "must be a number from -1000000000 to 1000000000 (scene units)"},
      {R"("camera": {"target": @[0, 0, 5]})", "is the point where the camera stands"},
      {R"("camera": {"position": [0, 5, 0], "up": @[0, -3, 0]})", "is parallel to the direction of view"},
      {R"("camera": {"up": @[0, 0, 0]})", "camera.up: is zero"},
      {R"("camera": {"vertical_fov": @0})", "must be a number above 0 and up to 179 (degrees), not 0"},
      {R"("camera": {"vertical_fov": @180})", "must be a number above 0 and up to 179"},
      {R"("camera": {"lens_radius": @-1, "focus_distance": 1})", "from 0 to 1000000000 (scene units)"},
      {R"("camera": @{"lens_radius": 0.1})", "camera.focus_distance: is missing"},
      {R"("camera": {"focus_distance": @0})", "must be a number above 0"},
      {R"("camera": {"type": "orthographic", @"lens_radius": 1})", "only with type \"perspective\""},
      {R"("camera": {@"height": 1})", "has no meaning here, only with type \"orthographic\""},
      {R"("camera": {"type": "orthographic", "height": @-1})", "must be a number above 0"},
      {R"("film": {"size": @[0, 480]})", "film.size: must be two whole numbers from 1 to 65536"},
      {R"("film": {"size": @[65537, 480]})", "must be two whole numbers"},
      {R"("film": {"size": @[640.5, 480]})", "must be two whole numbers"},
      {R"("film": {"size": @640})", "must be two whole numbers from 1 to 65536, such as [640, 480], not 640"},
      {R"("film": {"exposure": @"1"})", "must be a number from -64 to 64 (stops), not the text \"1\""},
      {R"("film": {"transparent": @1})", "must be true or false, not 1"},
      {R"("film": {"view": @null})", "must be \"standard\" or \"filmic\", not null"},
      {R"("render": {"samples": @0})", "must be a whole number from 1 to"},
      {R"("render": {"seed": @-1})", "must be a whole number from 0 to 4294967295"},
      {R"("render": {"seed": @4294967296})", "must be a whole number from 0 to 4294967295"},
      {R"("render": {"depth": @65537})", "must be a whole number from 0 to 65536"},
      {R"("render": {"depth": @-1})", "must be a whole number from 0 to 65536"},
      {R"("name": @5)", "name: must be text in double quotes, not 5"},
  };
  for (const Malformed& malformed : cases) {
    expectOne(inScene(malformed.text), malformed.message, false);
  }
}

TEST(SceneProblems, Media) {
  const std::vector<Malformed> cases{
      {R"("type": @"gird")", "must be \"homogeneous\" or \"grid\""},
      {R"("type": "homogeneous", "extinction": @-1)", "media.0.extinction: must be a number from 0 to"},
      {R"("type": "homogeneous", "albedo": @1.5)", "must be a number from 0 to 1, or a list of three, not 1.5"},
      {R"("type": "homogeneous", "albedo": [0, 0, @-0.1])", "media.0.albedo.2: must be a number from 0 to 1"},
      {R"("type": "homogeneous", "albedo": @[1, 1])", "or a list of three, not a list of 2"},
      {R"("type": "homogeneous", @"file": "smoke.vdb")", "has no meaning here, only with type \"grid\""},
      {R"("type": "homogeneous", "extinction_colour": [1, @1.5, 0])",
       "extinction_colour.1: must be a number from 0 to 1"},
      {R"("type": "homogeneous", "phase": @{})", "media.0.phase.type: is missing"},
      {R"("type": "homogeneous", "phase": {"type": @"heyney-greenstein"})", "did you mean \"henyey-greenstein\"?"},
      {R"("type": "homogeneous", "phase": @{"type": "henyey-greenstein"})", "media.0.phase.g: is missing"},
      {R"("type": "homogeneous", "phase": {"type": "henyey-greenstein", "g": @1})", "from -0.9999 to 0.9999"},
      {R"("type": "homogeneous", "phase": {"type": "isotropic", @"g": 0})",
       "only with type \"henyey-greenstein\" and type \"draine\""},
      {R"("type": "homogeneous", "phase": {"type": "mie", "diameter": @4.9})", "from 5 to 50 (micrometres)"},
      {R"("type": "homogeneous", "shape": @{"type": "box", "min": [0, 0, 0]})", "media.0.shape.max: is missing"},
      {R"("type": "homogeneous", "shape": {"type": "box", "min": [0, 0, 0], "max": @[1, 0, 1]})",
       "must be above min in y, but 0 is not above 0"},
      {R"("type": "homogeneous", "shape": {"type": "sphere", "radius": @0})", "must be a number above 0"},
      {R"("type": "homogeneous", "transform": @{})", "must be a list, [ ... ], not an object"},
      {R"("type": "homogeneous", "transform": [@{}])", "must have one of translate, rotate, scale or matrix"},
      {R"("type": "homogeneous", "transform": [@{"scale": 1, "translate": [0, 0, 0]}])", "must have one of"},
      {R"("type": "homogeneous", "transform": [@{"scale": [1, 0, 1]}])", "flattens space"},
      {R"("type": "homogeneous", "transform": [{"scale": 2}, @{"matrix": [1,2,3,0, 2,4,6,0, 0,0,1,0, 0,0,0,1]}])",
       "media.0.transform.1: flattens space"},
      {R"("type": "homogeneous", "transform": [{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, @3,4,5,1]}])",
       "must end with the row 0, 0, 0, 1"},
      {R"("type": "homogeneous", "transform": [{"matrix": @[1, 2, 3]}])", "must be 16 numbers"},
      {R"("type": "homogeneous", "transform": @[{"scale": 1e9}, {"scale": 1e9}])", "keep it between"},
      {R"("type": "homogeneous", "transform": [{"rotate": @{"axis": [0, 0, 1]}}])", "rotate.degrees: is missing"},
      {R"("type": "homogeneous", "instances": @[[]])", "copies a medium that fills all space already"},
      {R"("type": "grid", "file": "smoke.vdb", "instances": @{})", "instances: must be a list, [ ... ]"},
      {R"("type": "grid", "file": "smoke.vdb", "instances": [@{"scale": 2}])", "instances.0: must be a list"},
      {R"("type": "grid", "file": "smoke.vdb", "instances": [[], [@{"scale": 0}]])", "instances.1.0: flattens space"},
      {R"("type": "homogeneous", "emission": {"type": "linear", @"grid": "flame"})",
       "only with a medium of type \"grid\""},
      {R"("type": "homogeneous", "emission": @{"type": "blackbody"})", "emission.temperature: is missing"},
      {R"("type": "homogeneous", "extinction": 0, "emission": @{"type": "linear"})", "shines from infinitely far"},
      {R"("type": "homogeneous", "extinction_colour": [1, 0, 1], "emission": @{"type": "linear"})",
       "an extinction above 0 in every channel"},
      {R"("type": "grid", "file": @"smok.vdb")", "did you mean \"smoke.vdb\"?"},
      {R"("type": "grid", "file": @"nowhere/smoke.vdb")", "there is no folder"},
      {R"("type": "grid", "file": @".")", "is not a file"},
      {R"("type": "grid", "file": @7)", "must be a file name in double quotes, not 7"},
      {R"("type": "grid", "file": "smoke.vdb", "storage": @"unorm16")", "must be \"auto\", \"unorm8\", \"half\" or"},
      {R"("type": "grid", "file": "smoke.vdb", "clip": {"min": [0, 0, 0], "max": @[1, 1, -1]})", "above min in z"},
      {R"("type": "grid", "file": "smoke.vdb", "emission": @{"type": "linear"})", "emission.grid: is missing"},
      {R"("type": "grid", "file": "smoke.vdb", "emission": @5)", "must be an object"},
  };
  for (const Malformed& malformed : cases) {
    expectOne(inMedium(malformed.text), malformed.message, false);
  }
  expectOne(inMedium(R"("type": "grid", "file": "smoke.vdb", "grid": @"none")"), "there is no emission", true);
}

TEST(SceneProblems, Lights) {
  const std::vector<Malformed> cases{
      {R"("type": @"spto")", "must be \"point\", \"sun\", \"constant\", \"map\", \"sky\" or \"spot\""},
      {R"("type": "spot", "outer_angle": @0)", "must be a number above 0 and up to 90 (degrees)"},
      {R"("type": "spot", "outer_angle": 10, "inner_angle": @10.5)", "is 10.5, beyond the outer_angle of 10"},
      {R"("type": "spot", "inner_angle": @91)", "must be a number above 0 and up to 90 (degrees)"},
      {R"("type": "spot", "direction": @[0, 0, 0])", "lights.0.direction: is zero"},
      {R"("type": "spot", @"visible": true)", "only with every type but \"point\" and \"spot\""},
      {R"("type": "sun", "direction": @[0, 0, 0])", "lights.0.direction: is zero"},
      {R"("type": "sun", "irradiance": @-1)", "must be a number from 0 to"},
      {R"("type": "sun", @"intensity": 1)", "only with type \"point\" and type \"spot\""},
      {R"("type": "sun", "angular_diameter": @91)", "from 0 to 90 (degrees)"},
      {R"("type": "point", @"visible": true)", "only with every type but \"point\" and"},
      {R"("type": "point", @"intensty": 1)", "did you mean \"intensity\"?"},
      {R"("type": "map", "file": @"sky.hdr")", "did you mean \"sky.exr\"?"},
      {R"("type": "sky", "turbidity": @0.5)", "from 1 to 10"},
  };
  for (const Malformed& malformed : cases) {
    expectOne(inLight(malformed.text), malformed.message, false);
  }
  expectOne("{\"media\": [{\"type\": \"homogeneous\"}], \"lights\": [@{}]}", "lights.0.type: is missing", false);
  expectOne(inLight(R"("type": "sky", "sun_direction": @[0, 1, 0])"), "the sun is below the horizon", true);
}

TEST(SceneProblems, SettingsOfGuiding) {
  const std::vector<Malformed> cases{
      {R"("guide": {"loads": @5})",
       "guide.loads: makes 20 lobes, 5 loads times 4 states, but 16 is the most; take at most 4 loads or 3 states"},
      {R"("guide": {"loads": @5, "states": 4})", "guide.loads: makes 20 lobes"},
      {R"("guide": {"loads": @16, "states": 16})", "take at most 1 loads or 1 states"},
      {R"("render": {"integrator": "mcpg-paper"}, "guide": {"states": @4})", "guide.states: makes 20 lobes, 5 loads times 4"},
      {R"("guide": {"least_share": @0.9})", "leaves nothing between the least_share of 0.9 and the most_share of 0.85"},
      {R"("guide": {"most_share": @0.2})", "guide.most_share: leaves nothing"},
      {R"("guide": {"least_share": @0.6, "most_share": 0.5})", "guide.least_share: leaves nothing"},
      {R"("guide": {"states": @0, "loads": 16})", "must be a whole number from 1 to 16"},
  };
  for (const Malformed& malformed : cases) {
    expectOne(inScene(malformed.text), malformed.message, false);
  }
  const std::string most = inScene(R"("guide": {"loads": 4, "states": 4, "least_share": 0.5, "most_share": 0.5})");
  EXPECT_TRUE(parse(most).problems.empty()) << listed(parse(most));
}

TEST(SceneProblems, SettingsOfGuidingFromTheCommandLine) {
  const std::string text = inScene(R"("guide": {"unit": 1})");
  const LoadResult result = parse(text, {{"guide.loads", "4"}, {"guide.states", "5"}});
  ASSERT_EQ(result.problems.size(), 1u) << listed(result);
  EXPECT_EQ(result.problems.front().location.file, "--set guide.loads=4");
  EXPECT_THAT(result.problems.front().message, testing::HasSubstr("makes 20 lobes"));
  EXPECT_TRUE(parse(text, {{"guide.loads", "4"}, {"guide.states", "4"}}).ok());
}

TEST(SceneProblems, WholeScenes) {
  expectOne(R"({"media": [{"type": "homogeneous", "shape": @{"type": "unbounded"}}], "lights": [{"type": "sun"}]})",
            "is unbounded: no light comes from infinity (lights.0)", false);
  expectOne(R"({"media": [@{"type": "homogeneous"}], "lights": [{"type": "point"}, {"type": "sky"}]})",
            "no light comes from infinity (lights.1)", false);
  expectOne(R"({"media": [{"type": "homogeneous"}], "lights": @[]})", "the picture will be black", true);
  expectOne(R"({"lights": [{"type": "sun"}], "media": @[]})", "there are no media", true);
  expectOne(R"({"media": [{"name": "a", "type": "homogeneous"}, {"name": @"a", "type": "homogeneous"}],
                "lights": [{"type": "point"}]})",
            "media.1.name: is also the name of media.0", false);
  expectOne(R"({"media": [{"type": "homogeneous"}],
                "lights": [{"name": "a", "type": "point"}, {"type": "point", "name": @"a"}]})",
            "is also the name of lights.0", false);
}

TEST(SceneProblems, AllAreCollectedInFileOrder) {
  const LoadResult result = parse("{\"film\": {\"size\": 3, \"exposre\": 1},\n"
                                  " \"camera\": {\"up\": [0, 0, 1]},\n"
                                  " \"render\": {\"samples\": 0, \"depth\": -2},\n"
                                  " \"media\": [{\"type\": \"homogeneous\", \"albedo\": 2}],\n"
                                  " \"lights\": [{\"type\": \"sun\"}]}");
  std::vector<std::pair<int, int>> places;
  for (const Problem& problem : result.problems) {
    places.emplace_back(problem.location.line, problem.location.column);
  }
  const std::vector<std::pair<int, int>> expected{{1, 19}, {1, 22}, {2, 19}, {3, 24}, {3, 36}, {4, 12}, {4, 46}};
  EXPECT_EQ(places, expected) << listed(result);
}

TEST(SceneProblems, AreBoundedInNumber) {
  std::string text = "{\"media\": [";
  for (int i = 0; i < 5000; ++i) {
    text += "7, ";
  }
  const LoadResult result = parse(text + "]}");
  EXPECT_FALSE(result.ok());
  EXPECT_LT(result.problems.size(), 300u);
}

TEST(SceneProblems, LoadSceneThrowsThemAll) {
  const std::filesystem::path file = test::folder() / "broken.json";
  std::ofstream(file) << "{\"film\": {\"size\": 3},\n \"camera\": 4}";
  try {
    loadScene(file);
    FAIL() << "no exception";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(file.string() + ":1:19: film.size: must be"));
    EXPECT_THAT(error.what(), testing::HasSubstr(file.string() + ":2:12: camera: must be"));
  }
}

TEST(SceneProblems, FilesThatCannotBeRead) {
  EXPECT_THAT(listed(readScene("no/such.json")), testing::HasSubstr("no such file"));
  EXPECT_THAT(listed(readScene(test::folder())), testing::HasSubstr("is a folder"));
  const std::filesystem::path huge = test::folder() / "huge.json";
  std::ofstream(huge) << '{';
  std::filesystem::resize_file(huge, 5u << 20);
  EXPECT_THAT(listed(readScene(huge)), testing::HasSubstr("larger than 4 MB"));
}

} // namespace
} // namespace tyndall::scene

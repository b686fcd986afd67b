// SPDX-License-Identifier: Apache-2.0
// Scenes that move, as a user renders them: each frame is the picture of a scene that stands still there.
#include "app/program.h"
#include "film/exr.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace tyndall::test {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 24;
constexpr int kHeight = 18;

/// A shining square of 2 x 2 in the z plane, which the camera sees 8 wide and 6 high.
std::string square(const std::string& place, const std::string& members = "") {
  return R"({"camera": {"type": "orthographic", "height": 6, "position": [0, 0, 5]},
"film": {"size": [24, 18]}, "render": {"samples": 16},
"materials": [{"name": "lamp", "type": "diffuse", "colour": 0, "emission": 1}],
"objects": [{"name": "square", "type": "quad", "origin": [-1, -1, 0], "edge_u": [2, 0, 0], "edge_v": [0, 2, 0],
  "material": "lamp", "transform": [{"translate": )" +
         place + "}]}]" + members + "}";
}

const std::string kSliding = R"(, "animation": {"tracks": [
  {"target": "objects.square.transform.0.translate", "keys": [[1, [-2, 0, 0]], [5, [2, 0, 0]]]}]})";

class Moving : public testing::Test {
protected:
  Outcome run(const std::string& line) const { return runProgram(wordsOf(line, ""), folder_.path()); }
  void scene(const std::string& name, const std::string& text) const { writeFile(folder_ / name, text); }
  std::vector<float> green(const std::string& name) const { return film::readExr(folder_ / name).channels.at("G"); }

  TemporaryFolder folder_;
};

/// Where the light is: the mean column of the pixels' edges, weighted by radiance, and the sum.
std::pair<double, double> centreAndSum(const std::vector<float>& picture) {
  double sum = 0.0;
  double columns = 0.0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    sum += double(picture[i]);
    columns += double(picture[i]) * (double(i % kWidth) + 0.5);
  }
  return {columns / sum, sum};
}

TEST_F(Moving, ASquareSlidesFromFrameToFrame) {
  scene("slide.json", square("[9, 9, 9]", kSliding));
  const Outcome outcome = run("render slide.json --frames 1-3 --quiet -o f#.exr");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  // 3 pixels a unit; the square's 6 x 6 pixels are covered in full: one unit a frame, from 2 left of the middle.
  for (int frame = 1; frame <= 3; ++frame) {
    const auto [column, sum] = centreAndSum(green("f" + std::to_string(frame) + ".exr"));
    EXPECT_NEAR(column, kWidth / 2.0 + 3.0 * (frame - 3), 1e-5) << frame;
    EXPECT_NEAR(sum, 36.0, 1e-4) << frame;
  }
}

TEST_F(Moving, EachFrameIsThePictureOfAStillScene) {
  scene("slide.json", square("[9, 9, 9]", kSliding));
  scene("still.json", square("[-1, 0, 0]"));
  ASSERT_EQ(run("render slide.json --frames 1-2 --quiet -o f#.exr --write-scene sub.json").exitCode, 0);
  ASSERT_EQ(run("render still.json --quiet -o still.exr").exitCode, 0);
  ASSERT_EQ(run("render slide.json --quiet -o first.exr").exitCode, 0);
  ASSERT_EQ(run("render sub.json --frames 2-2 --quiet -o w#.exr").exitCode, 0);
  EXPECT_EQ(green("f2.exr"), green("still.exr"));
  EXPECT_EQ(green("f1.exr"), green("first.exr")) << "without --frames: frame 1";
  EXPECT_EQ(green("w2.exr"), green("f2.exr")) << "a scene written out keeps its animation";
  EXPECT_NE(green("f1.exr"), green("f2.exr"));
}

TEST_F(Moving, MistakesAreReportedWhereTheyStand) {
  scene("still.json", square("[0, 0, 0]"));
  EXPECT_THAT(run("render still.json --frames 1-2").errors, HasSubstr("--frames: nothing in the scene moves"));
  scene("flat.json", square("[0, 0, 0]", R"(, "animation": {"tracks": [
  {"target": "objects.square.edge_u", "keys": [[1, [2, 0, 0]], [4, [0, 2, 0]]]}]})"));
  EXPECT_EQ(run("render flat.json --frames 3-3 --quiet -o f#.exr").exitCode, 0);
  const Outcome check = run("check flat.json");
  EXPECT_EQ(check.exitCode, 1) << "every frame with a key is checked";
  EXPECT_THAT(check.errors, HasSubstr("flat.json:4:"));
  EXPECT_THAT(check.errors, HasSubstr("in frame 4: objects.0.edge_v: spans no area with edge_u"));
  const Outcome render = run("render flat.json --frames 3-4 --quiet -o f#.exr");
  EXPECT_NE(render.exitCode, 0);
  EXPECT_THAT(render.errors, HasSubstr("in frame 4: objects.0.edge_v: spans no area"));
}

} // namespace
} // namespace tyndall::test

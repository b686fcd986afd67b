// SPDX-License-Identifier: Apache-2.0
// What the subcommands do with good input, and with input that is odd but usable.
#include "app/inputs.h"
#include "app/program.h"
#include "film/checkpoint.h"
#include "film/exr.h"
#include "film/merge.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tyndall::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Runs a command line in a folder of its own, or in the one given.
class Commands : public testing::Test {
protected:
  Outcome run(const std::string& line, const std::vector<std::string>& environment = {}) const {
    return runProgram(wordsOf(line, inputs()), folder_.path(), environment);
  }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  TemporaryFolder folder_;
};

nlohmann::json parsed(const Outcome& outcome) { return nlohmann::json::parse(outcome.output); }

TEST_F(Commands, NoArgumentsShowTheTwoFirstExamples) {
  const Outcome outcome = run("");
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.output, HasSubstr("tyndall render scenes/first.json"));
  EXPECT_THAT(outcome.output, HasSubstr("tyndall render cloud.vdb"));
}

TEST_F(Commands, EveryCommandHasHelpAndTheProgramAVersion) {
  EXPECT_EQ(run("--version").exitCode, 0);
  for (const char* command :
       {"render", "info", "check", "compare", "merge", "export", "verify", "bench", "devices"}) {
    const Outcome outcome = run(std::string(command) + " --help");
    EXPECT_EQ(outcome.exitCode, 0) << command;
    EXPECT_THAT(outcome.output, HasSubstr("--help")) << command;
    EXPECT_EQ(outcome.errors, "") << command;
  }
}

TEST_F(Commands, InfoDescribesEveryReadableVolume) {
  const TemporaryFolder volumes;
  for (const std::string& name : writeFixtures(volumes.path())) {
    const Outcome text = run("info " + (volumes / name).string());
    EXPECT_EQ(text.exitCode, 0) << name << text.errors;
    const Outcome json = run("info --json " + (volumes / name).string());
    ASSERT_EQ(json.exitCode, 0) << name << json.errors;
    const nlohmann::json info = parsed(json);
    const bool nothing = !info["bare_render"]["nothing_to_render"].get<std::string>().empty();
    EXPECT_EQ(nothing, text.output.find("nothing to render") != std::string::npos) << name;
    EXPECT_TRUE(nothing || !info["bare_render"]["grids"].empty()) << name << text.output;
  }
}

TEST_F(Commands, InfoTellsWhyThereIsNothingToRender) {
  EXPECT_THAT(run("info {in}/points_only.vdb").output, HasSubstr("rasterise"));
  EXPECT_THAT(run("info {in}/vec3_only.vdb").output, HasSubstr("vectors"));
  EXPECT_THAT(run("info {in}/empty_grids.vdb").output, HasSubstr("no active voxel"));
  EXPECT_THAT(run("info {in}/no_grids.vdb").output, HasSubstr("holds no grids"));
}

TEST_F(Commands, InfoGivesTheNumbersOfTheFile) {
  const nlohmann::json info = parsed(run("info --json {in}/ramp_x_identity.vdb"));
  const nlohmann::json& grid = info["grids"][0];
  EXPECT_EQ(grid["name"], "density");
  EXPECT_EQ(grid["active_voxels"], kRampVoxels * kRampVoxels * kRampVoxels);
  EXPECT_EQ(grid["value_range"][0], kRampBase);
  EXPECT_EQ(grid["value_range"][1], kRampBase + kRampSlope * (kRampVoxels - 1));
  EXPECT_EQ(grid["world_bounds"][1], nlohmann::json({kRampVoxels - 0.5, kRampVoxels - 0.5, kRampVoxels - 0.5}));
  const nlohmann::json& bare = info["bare_render"];
  // Lines along x see the whole ramp, others at least its thin end over their chord: 20 voxels of 0.25 to 2.6.
  EXPECT_GT(bare["median_optical_depth"], 2.0);
  EXPECT_LT(bare["median_optical_depth"], 60.0);
  const double taken = bare["median_optical_depth"].get<double>() * bare["density_scale"].get<double>();
  EXPECT_GT(taken, 3.0);
  EXPECT_LT(taken, 8.0);
}

TEST_F(Commands, InfoPlansASceneAndNamesItsFiles) {
  writeFile(file("ball.json"), R"({"media": [{"type": "grid", "file": ")" + (inputs() / "plain.vdb").string() +
                                   R"("}], "lights": [{"type": "point", "position": [9, 9, 9]}]})");
  const Outcome text = run("info ball.json");
  EXPECT_EQ(text.exitCode, 0) << text.errors;
  EXPECT_THAT(text.output, HasSubstr("plain.vdb"));
  const nlohmann::json info = parsed(run("info --json ball.json"));
  EXPECT_EQ(info["files"][0]["bytes"], std::filesystem::file_size(inputs() / "plain.vdb"));
  EXPECT_GT(info["device_bytes"], 0);
  // Blocks of 9^3 floats per brick, whose own 8^3 voxels are stored in 1 to 4 bytes for tracking.
  EXPECT_GT(info["march_device_bytes"], info["device_bytes"]);
  EXPECT_EQ(info["film_bytes"], 640 * 480 * sizeof(film::PixelState));
}

TEST_F(Commands, CheckPassesSoundScenesAndListsAllProblems) {
  EXPECT_EQ(run("check {in}/sound.json").exitCode, 0);
  writeFile(file("two.json"), "{\"media\": [{\"type\": \"grid\", \"file\": \"cut.vdb\",\n \"albedo\": 2}],\n "
                              "\"lights\": [{\"type\": \"pint\"}]}");
  writeFile(file("cut.vdb"), "no volume");
  const Outcome outcome = run("check two.json");
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("two.json:1:37: error: media.0.file"));
  EXPECT_THAT(outcome.errors, HasSubstr("two.json:2:12: error: media.0.albedo"));
  EXPECT_THAT(outcome.errors, HasSubstr("two.json:3:22: error: lights.0.type"));
}

TEST_F(Commands, CheckWarnsOfEmptyGridsButPasses) {
  writeFile(file("empty.json"), R"({"media": [{"type": "grid", "file": ")" + (inputs() / "empty_grids.vdb").string() +
                                    R"(", "grid": "heat"}], "lights": [{"type": "point"}]})");
  const Outcome outcome = run("check empty.json");
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("warning: media.0.grid"));
}

TEST_F(Commands, CompareTellsScriptsHowItWent) {
  EXPECT_EQ(run("compare {in}/picture_8x8.exr {in}/picture_8x8.exr --max-rrmse 0 --max-bias 0%").exitCode, 0);
  film::Image brighter = film::readExr(inputs() / "picture_8x8.exr");
  for (float& value : brighter.channels["R"]) {
    value *= 1.1f;
  }
  film::writeExr(file("brighter.exr"), brighter);
  EXPECT_EQ(run("compare brighter.exr {in}/picture_8x8.exr --max-bias 11%").exitCode, 0);
  const Outcome beyond = run("compare brighter.exr {in}/picture_8x8.exr --max-bias 9% --difference d.png");
  EXPECT_EQ(beyond.exitCode, 1) << beyond.errors;
  EXPECT_THAT(beyond.output, HasSubstr("bias of R"));
  EXPECT_TRUE(std::filesystem::exists(file("d.png")));
  EXPECT_EQ(run("compare brighter.exr {in}/picture_8x4.exr").exitCode, 2);
}

TEST_F(Commands, MergeJoinsPartsExactlyAndCanBeMergedOn) {
  const Outcome outcome = run("merge {in}/left.part {in}/right.part -o whole.exr --mergeable");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_EQ(namesIn(folder_.path()), (std::vector<std::string>{"whole.exr", "whole.exr.part", "whole.png"}));
  const film::Image image = film::readExr(file("whole.exr"));
  EXPECT_EQ(image.window.extent(), glm::uvec2(8, 4));
  // Batches of 16 samples sum to 8 and 9: their mean is 17 / 32.
  EXPECT_THAT(image.channels.at("R"), testing::Each(17.0f / 32.0f));
  EXPECT_EQ(film::loadCheckpoint(file("whole.exr.part")).samples(0), 2 * film::kBatchSamples);
  EXPECT_EQ(run("merge whole.exr {in}/left.part -o again.exr").exitCode, 1);
}

TEST_F(Commands, DevicesNamesTheOneThatRenders) {
  const Outcome outcome = run("devices");
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("render takes this one"));
}

TEST_F(Commands, BadVoxelsAreReportedAndThePictureIsSound) {
  EXPECT_THAT(run("info {in}/bad_values.vdb").output, HasSubstr("3 active voxels are NaN or infinite"));
  const Outcome outcome = run("render {in}/bad_values.vdb -o out.exr --size 24x18 --spp 16 --stats stats.json");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_THAT(bytesOf(file("stats.json")), HasSubstr("\"nonfinite_voxels\": 3"));
  double sum = 0.0;
  for (const auto& [name, values] : film::readExr(file("out.exr")).channels) {
    for (const float value : values) {
      ASSERT_TRUE(std::isfinite(value)) << name;
      sum += double(value);
    }
  }
  EXPECT_GT(sum, 0.0);
}

TEST_F(Commands, ACheckpointOfAnotherRenderIsRefusedAndKept) {
  ASSERT_EQ(run("render {in}/sound.json -o a.exr --size 16x12 --spp 16 --resume").exitCode, 0);
  const std::string checkpoint = bytesOf(file("a.exr.checkpoint"));
  const std::string picture = bytesOf(file("a.exr"));
  for (const char* change : {"--size 16x12 --seed 5", "--size 16x12 --set media.0.albedo=0.5", "--size 16x8"}) {
    const Outcome outcome = run("render {in}/sound.json -o a.exr --spp 16 --resume " + std::string(change));
    EXPECT_NE(outcome.exitCode, 0) << change;
    EXPECT_THAT(outcome.errors, HasSubstr("a.exr.checkpoint")) << change;
    EXPECT_THAT(outcome.errors, HasSubstr("delete it")) << change;
  }
  EXPECT_EQ(bytesOf(file("a.exr.checkpoint")), checkpoint);
  EXPECT_EQ(bytesOf(file("a.exr")), picture);
}

TEST_F(Commands, ADamagedCheckpointIsRefused) {
  ASSERT_EQ(run("render {in}/sound.json -o a.exr --size 16x12 --spp 16 --resume").exitCode, 0);
  const std::string whole = bytesOf(file("a.exr.checkpoint"));
  std::string flipped = whole;
  flipped[whole.size() - 100] = char(flipped[whole.size() - 100] ^ 4);
  for (const std::string& damaged : {whole.substr(0, whole.size() / 2), flipped, std::string("text"), std::string()}) {
    writeFile(file("a.exr.checkpoint"), damaged);
    const Outcome outcome = run("render {in}/sound.json -o a.exr --size 16x12 --spp 32 --resume");
    EXPECT_EQ(outcome.exitCode, 1) << damaged.size();
    EXPECT_THAT(outcome.errors, HasSubstr("a.exr.checkpoint")) << damaged.size();
  }
}

TEST_F(Commands, TheValidationLayerHasNothingToSay) {
  const Outcome outcome = run("render {in}/plain.vdb -o out.exr --size 16x12 --spp 16", {"TYNDALL_VALIDATION=1"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, Not(HasSubstr("validation")));
  // Advice on best practices is always to be had: messages do reach the exit code.
  const Outcome advised =
      run("render {in}/plain.vdb -o out.exr --size 16x12 --spp 16",
          {"TYNDALL_VALIDATION=1", "VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT"});
  EXPECT_EQ(advised.exitCode, 3) << advised.errors;
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
// `tyndall render` as a user runs it: what it writes, and that no way of getting there changes a bit of the picture.
#include "app/program.h"
#include "film/checkpoint.h"
#include "film/exr.h"
#include "support/fixtures.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <random>
#include <thread>

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TYNDALL_SOURCE_FOLDER;
const std::string kCloud = (kRoot / "volumes/cloud.vdb").string();
const std::string kScene = (kRoot / "scenes/first.json").string();

Outcome render(const TemporaryFolder& folder, const std::string& line) {
  return runProgram(wordsOf("render " + line, kRoot), folder.path());
}

void expectDone(const Outcome& outcome) { EXPECT_EQ(outcome.exitCode, 0) << outcome.output << outcome.errors; }

/// Channels that differ in a bit.
std::vector<std::string> differences(const fs::path& a, const fs::path& b) {
  const film::Image first = film::readExr(a);
  const film::Image second = film::readExr(b);
  std::vector<std::string> names;
  EXPECT_EQ(first.channels.size(), second.channels.size());
  EXPECT_EQ(first.window, second.window);
  for (const auto& [name, values] : first.channels) {
    const auto other = second.channels.find(name);
    if (other == second.channels.end() || other->second.size() != values.size() ||
        std::memcmp(other->second.data(), values.data(), values.size() * sizeof(float)) != 0) {
      names.push_back(name);
    }
  }
  return names;
}

/// Starts the program and ends it with `signal` after a while. @return its exit status as waitpid gives it.
int interrupted(const TemporaryFolder& folder, const std::string& line, int signal, std::chrono::milliseconds after) {
  const pid_t child = startProgram(wordsOf("render " + line, kRoot), folder.path());
  std::this_thread::sleep_for(after);
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

const std::string kSmall = " --size 64x48 --spp 32 --quiet ";

TEST(Render, SettingsAndStopReasonAreInTheHeaderAndTheStatistics) {
  const TemporaryFolder folder;
  expectDone(render(folder, kScene + kSmall + "-o a.exr --stats a.json --seed 7 --aov depth,samples"));
  const film::Image image = film::readExr(folder / "a.exr");
  EXPECT_EQ(image.metadata.at("seed"), "7");
  EXPECT_EQ(image.metadata.at("stop.reason"), "samples");
  EXPECT_EQ(image.metadata.at("count.nonFinite"), "0");
  EXPECT_TRUE(image.channels.contains("depth.Z"));
  EXPECT_TRUE(fs::exists(folder / "a.png"));
  EXPECT_FALSE(fs::exists(folder / "a.exr.checkpoint"));
  const auto statistics = nlohmann::json::parse(bytesOf(folder / "a.json"));
  EXPECT_EQ(statistics["settings"]["seed"], 7);
  EXPECT_GT(statistics["seconds"]["render"], 0.0);
  EXPECT_EQ(statistics["pipeline"]["PointLights"], "left out");
  EXPECT_EQ(statistics["pipeline"]["Slots"], "1");
  EXPECT_GE(statistics["device_bytes"]["peak"], statistics["grids"][0]["device_bytes"]);
}

TEST(Render, QuietSaysNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = render(folder, kScene + kSmall + "-o a.exr");
  EXPECT_EQ(outcome.output + outcome.errors, "");
}

TEST(Render, KilledAnywhereAndResumedThePictureIsTheSameBitForBit) {
  for (const char* estimator : {"march", "tracking"}) {
    const std::string work =
        kScene + " --size 96x72 --spp 64 --quiet --checkpoint-every 0.01 -o a.exr --estimator " + estimator;
    const TemporaryFolder whole;
    const auto start = std::chrono::steady_clock::now();
    expectDone(render(whole, work));
    const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start);
    std::mt19937 random(20240611); // the moments: some fall before the first sample, some late
    for (int round = 0; round < 3; ++round) {
      const TemporaryFolder folder;
      for (int kill = 0; kill < 3; ++kill) {
        const auto after = took * static_cast<int>(random() % 90 + 10) / 100;
        interrupted(folder, work + (kill > 0 ? " --resume" : ""), SIGKILL, after);
      }
      expectDone(render(folder, work + " --resume"));
      EXPECT_EQ(differences(folder / "a.exr", whole / "a.exr"), std::vector<std::string>{}) << estimator << round;
    }
  }
}

TEST(Render, AnotherSeedIsAnotherPicture) { // so the comparison of bits can fail
  const TemporaryFolder folder;
  expectDone(render(folder, kScene + kSmall + "-o a.exr"));
  expectDone(render(folder, kScene + kSmall + "-o b.exr --seed 1"));
  EXPECT_NE(differences(folder / "a.exr", folder / "b.exr"), std::vector<std::string>{});
}

TEST(Render, CtrlCFinishesTheFileAndSaysSo) {
  const TemporaryFolder folder;
  const int status =
      interrupted(folder, kScene + " --size 320x240 --spp 100000 --quiet -o a.exr", SIGINT, std::chrono::seconds(4));
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(film::readExr(folder / "a.exr").metadata.at("stop.reason"), "interrupt");
  EXPECT_TRUE(film::isCheckpoint(folder / "a.exr.checkpoint"));
}

TEST(Render, ResumeExtendsAFinishedPicture) {
  const TemporaryFolder folder;
  const std::string work = kScene + " --size 64x48 --quiet ";
  expectDone(render(folder, work + "-o a.exr --spp 32 --resume"));
  expectDone(render(folder, work + "-o a.exr --spp 96 --resume"));
  expectDone(render(folder, work + "-o b.exr --spp 96"));
  EXPECT_EQ(differences(folder / "a.exr", folder / "b.exr"), std::vector<std::string>{});
}

TEST(Render, CropsMergeToTheWholeBitForBit) {
  const TemporaryFolder folder;
  const std::string work = kScene + kSmall + "--mergeable ";
  expectDone(render(folder, work + "-o whole.exr"));
  expectDone(render(folder, work + "-o left.exr --crop 0,0,23,48"));
  expectDone(render(folder, work + "-o right.exr --crop 23,0,64,48"));
  expectDone(runProgram({"merge", "left.exr.part", "right.exr.part", "-o", "joined.exr"}, folder.path()));
  EXPECT_EQ(differences(folder / "joined.exr", folder / "whole.exr"), std::vector<std::string>{});
}

TEST(RenderVolume, WrittenSceneGivesTheSameBits) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "scenes");
  expectDone(render(folder, kCloud + kSmall + "-o a.exr --write-scene scenes/made.json"));
  expectDone(render(folder, "scenes/made.json --quiet -o b.exr"));
  EXPECT_EQ(differences(folder / "a.exr", folder / "b.exr"), std::vector<std::string>{});
  EXPECT_EQ(bytesOf(folder / "a.png"), bytesOf(folder / "b.png"));
}

TEST(RenderVolume, SaysWhatItChose) {
  const TemporaryFolder folder;
  const Outcome outcome = render(folder, kCloud + " --size 48x36 --spp 16");
  expectDone(outcome);
  EXPECT_NE(outcome.output.find("grid 'density'"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("median optical depth 5 at density scale"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("device memory"), std::string::npos) << outcome.output;
  EXPECT_TRUE(fs::exists(folder / "cloud.exr"));
}

TEST(RenderVolume, SequencesKeepOneFraming) {
  const TemporaryFolder folder;
  fs::copy_file(kCloud, folder / "c_001.vdb");
  fs::copy_file(kRoot / "volumes/plume.vdb", folder / "c_002.vdb");
  expectDone(render(folder, "c_%03d.vdb --frames 1-2 --size 48x36 --spp 16 --quiet -o o.exr --write-scene s.json"));
  expectDone(render(folder, "s.json --frames 1-2 --size 48x36 --spp 16 --quiet -o p.exr"));
  for (const char* frame : {"0001", "0002"}) {
    EXPECT_EQ(differences(folder / (std::string("o_") + frame + ".exr"), folder / (std::string("p_") + frame + ".exr")),
              std::vector<std::string>{});
  }
}

TEST(RenderVolume, WithoutAScalarGridIsAnErrorAndLeavesNothing) {
  const TemporaryFolder inputs;
  const std::vector<std::string> names = writeFixtures(inputs.path());
  const TemporaryFolder folder;
  const Outcome outcome = render(folder, (inputs / "vec3_only.vdb").string());
  ASSERT_TRUE(fs::exists(inputs / "vec3_only.vdb")) << "fixture renamed?";
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.errors.find("no grid in it can be rendered"), std::string::npos) << outcome.errors;
  EXPECT_TRUE(namesIn(folder.path()).empty());
}

} // namespace
} // namespace tyndall::test

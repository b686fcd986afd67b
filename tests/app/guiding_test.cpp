// SPDX-License-Identifier: Apache-2.0
// Guided renders as a user starts, kills and resumes them.
#include "app/program.h"
#include "film/checkpoint.h"
#include "film/exr.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A ball of fog under a lamp that moves from frame to frame.
const std::string kFog = R"({"camera": {"position": [0, 0, 4], "target": [0, 0, 0], "vertical_fov": 40},
"film": {"size": [32, 24]}, "render": {"samples": 64, "depth": 3, "integrator": "mcpg"},
"media": [{"name": "fog", "type": "homogeneous", "extinction": 2, "albedo": 0.9,
  "shape": {"type": "sphere", "centre": [0, 0, 0], "radius": 1}}],
"lights": [{"name": "lamp", "type": "point", "position": [0, 1.2, 0], "intensity": 5}],
"animation": {"tracks": [{"target": "lights.lamp.position",
  "keys": [[1, [-0.4, 1.2, 0]], [3, [0.4, 1.2, 0]]]}]}})";

class Guiding : public testing::Test {
protected:
  Guiding() { writeFile(folder_ / "fog.json", kFog); }

  Outcome render(const std::string& options, const std::vector<std::string>& environment = {}) const {
    return runProgram(wordsOf("render fog.json " + options, ""), folder_.path(), environment);
  }
  /// Ends it when its checkpoint has been written `saves` times.
  void killed(const std::string& options, const std::string& checkpoint, int saves) const;
  std::map<std::string, std::vector<float>> picture(const std::string& name) const {
    return film::readExr(folder_ / name).channels;
  }
  /// The file beside the checkpoint that belongs to it.
  fs::path companion(const std::string& checkpoint) const {
    for (const std::string& name : namesIn(folder_.path())) {
      if (name.starts_with(checkpoint + ".")) {
        return folder_ / name;
      }
    }
    return {};
  }

  TemporaryFolder folder_;
};

void Guiding::killed(const std::string& options, const std::string& checkpoint, int saves) const {
  const pid_t child = startProgram(wordsOf("render fog.json " + options, ""), folder_.path());
  fs::path last = companion(checkpoint);
  int status = 0;
  while (saves > 0 && ::waitpid(child, &status, WNOHANG) == 0) {
    const fs::path now = companion(checkpoint);
    saves -= !now.empty() && now != last ? 1 : 0;
    last = now.empty() ? last : now;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, &status, 0);
}

TEST_F(Guiding, KilledAnywhereAndResumedADeterministicPictureIsTheSameBitForBit) {
  const std::string work = "--deterministic --quiet --checkpoint-every 0.001 ";
  ASSERT_EQ(render(work + "-o whole.exr", {"LP_NUM_THREADS=1"}).exitCode, 0);
  for (const int saves : {1, 2}) {
    killed(work + "-o a.exr --resume", "a.exr.checkpoint", saves);
    EXPECT_FALSE(fs::exists(folder_ / "a.exr")) << "it was done before it was killed";
  }
  const Outcome outcome = render("--deterministic --resume -o a.exr");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("deterministic"));
  EXPECT_EQ(picture("a.exr"), picture("whole.exr"));
  EXPECT_EQ(companion("whole.exr.checkpoint"), fs::path()) << "chains outlive a picture that is done";
}

TEST_F(Guiding, SequencesAreResumedWithTheChainsOfTheFramesBefore) {
  const std::string work = "--deterministic --quiet --spp 16 ";
  ASSERT_EQ(render(work + "--frames 1-2 -o whole#.exr").exitCode, 0);
  ASSERT_EQ(render(work + "--frames 1-1 -o f#.exr --resume").exitCode, 0);
  ASSERT_EQ(render(work + "--frames 1-2 -o f#.exr --resume").exitCode, 0);
  EXPECT_EQ(picture("f2.exr"), picture("whole2.exr"));
}

TEST_F(Guiding, ChainsThatDoNotBelongToTheCheckpointAreRefused) {
  ASSERT_EQ(render("--quiet --resume --spp 16 -o a.exr").exitCode, 0);
  const fs::path chains = companion("a.exr.checkpoint");
  const std::string whole = bytesOf(chains);
  const auto refused = [&](const std::string& options, const std::string& reason) {
    const Outcome outcome = render("--quiet --resume --spp 32 -o a.exr " + options);
    EXPECT_EQ(outcome.exitCode, 1) << options << reason;
    EXPECT_THAT(outcome.errors, HasSubstr("a.exr.checkpoint"));
    EXPECT_THAT(outcome.errors, HasSubstr(reason));
  };
  refused("--deterministic", "another render");
  refused("--set guide.states=2", "another render");
  refused("--memory 12M", "--memory");
  std::string damaged = whole;
  damaged[whole.size() / 2] ^= 1;
  writeFile(chains, damaged);
  refused("", "damaged");
  fs::remove(chains);
  refused("", "missing");
}

} // namespace
} // namespace tyndall::test

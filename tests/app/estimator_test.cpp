// SPDX-License-Identifier: Apache-2.0
// The choice of the estimator as a user meets it: what may be asked for, what is said about it, and that a biased or
// unsound picture never passes for a good one.
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

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path kRoot = TYNDALL_SOURCE_FOLDER;
const std::string kCloud = (kRoot / "volumes/cloud.vdb").string();
const std::string kLamp = R"("lights": [{"type": "point", "position": [9, 9, 9], "intensity": 10}])";

/// The cloud beside a lamp: one grid, one light cache, no maps.
const std::string kCloudAndLamp = R"({"media": [{"type": "grid", "file": ")" + kCloud +
                                  R"(", "density_scale": 0.03}], "lights": [{"type": "point", "position":)"
                                  R"( [0, 2000, 0], "intensity": 1e7}], "camera": {"position": [0, 400, 2900],)"
                                  R"( "target": [0, 400, 0]}})";

/// Balls of fog in a row.
std::string balls(int count) {
  std::string media;
  for (int i = 0; i < count; ++i) {
    media += (i > 0 ? ", " : "") + std::string(R"({"type": "homogeneous", "shape": {"type": "sphere", "centre": [)") +
             std::to_string(3 * i) + ", 0, 0]}}";
  }
  return R"({"media": [)" + media + "], " + kLamp + "}";
}

class Estimators : public testing::Test {
protected:
  void SetUp() override { writeFile(folder_ / "cloud.json", kCloudAndLamp); }

  Outcome run(const std::string& line) const { return runProgram(wordsOf(line, kRoot), folder_.path()); }
  /// A tiny picture of the cloud, `name`.exr, with its statistics.
  Outcome render(const std::string& name, const std::string& options = "") const {
    return run("render cloud.json --size 24x18 --spp 16 --stats " + name + ".json.stats -o " + name + ".exr " +
               options);
  }
  nlohmann::json statistics(const std::string& name) const {
    return nlohmann::json::parse(bytesOf(folder_ / (name + ".json.stats")));
  }
  film::Metadata header(const std::string& name) const { return film::readExr(folder_ / (name + ".exr")).metadata; }

  TemporaryFolder folder_;
};

TEST_F(Estimators, TheChoiceAndItsReasonAreSaid) {
  const Outcome chosen = render("a");
  ASSERT_EQ(chosen.exitCode, 0) << chosen.errors;
  EXPECT_THAT(chosen.output, HasSubstr("estimator: march ("));
  EXPECT_THAT(chosen.output, HasSubstr("light caches of suns and lamps: 1 of 1, "));
  EXPECT_EQ(statistics("a")["estimator"]["name"], "march");
  EXPECT_EQ(statistics("a")["estimator"]["biased"], false);
  EXPECT_EQ(statistics("a")["light_caches"]["count"], 1);
  EXPECT_EQ(statistics("a")["pipeline"]["Corrections"], "4");
  EXPECT_EQ(statistics("a")["counters"]["cut_rays"], 0);
  EXPECT_EQ(header("a").at("estimator"), "march");
  EXPECT_EQ(header("a").at("estimator.biased"), "0");
  const Outcome asked = render("b", "--estimator tracking");
  EXPECT_THAT(asked.output, HasSubstr("estimator: tracking (as asked for)"));
  EXPECT_THAT(asked.output, Not(HasSubstr("light caches")));
  EXPECT_EQ(header("b").at("estimator"), "tracking");
}

TEST_F(Estimators, ATrackerIsPutToWork) {
  ASSERT_EQ(render("a", "--tracker delta").exitCode, 0);
  EXPECT_EQ(statistics("a")["estimator"]["name"], "tracking");
  EXPECT_EQ(statistics("a")["pipeline"]["Weighted"], "left out");
}

TEST_F(Estimators, WhereTheMarchDoesNotServeTheReasonIsGiven) {
  writeFile(folder_ / "nine.json", balls(9));
  const std::string work = "render nine.json --size 24x18 --spp 16 -o a.exr ";
  const Outcome automatic = run(work);
  EXPECT_EQ(automatic.exitCode, 0) << automatic.errors;
  EXPECT_THAT(automatic.output, HasSubstr("estimator: tracking (the march does not serve: there are 9 homogeneous"));
  for (const char* option : {"--estimator march", "--preview"}) {
    const Outcome wanted = run(work + option);
    EXPECT_EQ(wanted.exitCode, 1) << option;
    EXPECT_THAT(wanted.errors, HasSubstr(option));
    EXPECT_THAT(wanted.errors, HasSubstr("there are 9 homogeneous media")) << option;
  }
}

TEST_F(Estimators, APreviewSaysEverywhereThatItIsBiased) {
  EXPECT_THAT(run("render --help").output, HasSubstr("BIASED"));
  const Outcome outcome = render("a", "--preview");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("BIASED"));
  EXPECT_THAT(outcome.errors, HasSubstr("a.exr is BIASED (--preview)"));
  EXPECT_THAT(render("a", "--preview --quiet").errors, HasSubstr("BIASED"));
  EXPECT_EQ(statistics("a")["estimator"]["biased"], true);
  EXPECT_EQ(statistics("a")["pipeline"]["Corrections"], "0");
  EXPECT_THAT(header("a").at("estimator"), HasSubstr("biased"));
  EXPECT_EQ(header("a").at("estimator.biased"), "1");
  const Outcome unbiased = render("b");
  EXPECT_THAT(unbiased.output + unbiased.errors, Not(HasSubstr("BIASED")));
}

TEST_F(Estimators, BiasedPartsStayAmongThemselves) {
  ASSERT_EQ(render("a", "--mergeable").exitCode, 0);
  ASSERT_EQ(render("b", "--mergeable --preview --seed 1").exitCode, 0);
  ASSERT_EQ(render("c", "--mergeable --preview --seed 2").exitCode, 0);
  const Outcome mixed = run("merge a.exr.part b.exr.part -o ab.exr");
  EXPECT_EQ(mixed.exitCode, 1);
  EXPECT_THAT(mixed.errors, HasSubstr("b.exr.part"));
  const Outcome biased = run("merge b.exr.part c.exr.part -o bc.exr");
  EXPECT_EQ(biased.exitCode, 0) << biased.errors;
  EXPECT_THAT(biased.errors, HasSubstr("bc.exr: is BIASED"));
  EXPECT_EQ(header("bc").at("estimator.biased"), "1");
  ASSERT_EQ(render("d", "--resume").exitCode, 0);
  const Outcome resumed = render("d", "--resume --preview");
  EXPECT_EQ(resumed.exitCode, 1);
  EXPECT_THAT(resumed.errors, HasSubstr("another render"));
}

TEST_F(Estimators, CutRaysMakeAPictureUnsound) {
  ASSERT_EQ(render("a", "--resume --mergeable").exitCode, 0);
  for (const char* name : {"a.exr.checkpoint", "a.exr.part"}) {
    film::Film film = film::loadCheckpoint(folder_ / name);
    film.metadata.at("count.cut") = "2"; // as from an earlier run
    film::saveCheckpoint(folder_ / name, film);
  }
  const Outcome merged = run("merge a.exr.part -o m.exr");
  EXPECT_EQ(merged.exitCode, 1);
  EXPECT_THAT(merged.errors, HasSubstr("2 samples"));
  const Outcome resumed = render("a", "--resume");
  EXPECT_EQ(resumed.exitCode, 1);
  EXPECT_THAT(resumed.errors, HasSubstr("2 rays were cut short"));
}

/// What a picture takes on the device, as its statistics tell.
struct DeviceBytes {
  explicit DeviceBytes(const nlohmann::json& statistics)
      : planned(statistics["device_bytes"]["planned"]), peak(statistics["device_bytes"]["peak"]),
        caches(statistics["light_caches"]["bytes"]) {}
  double planned;
  double peak;
  double caches;
};

TEST_F(Estimators, MemoryIsPlannedForTheLayoutThatIsUsed) {
  for (const char* estimator : {"march", "tracking"}) {
    ASSERT_EQ(render("a", std::string("--estimator ") + estimator).exitCode, 0);
    const DeviceBytes bytes(statistics("a"));
    EXPECT_NEAR(bytes.planned / bytes.peak, 1.0, 0.05) << estimator << " plans " << bytes.planned;
  }
}

TEST_F(Estimators, LittleMemoryCoarsensThenDropsCachesThenTracks) {
  writeFile(folder_ / "balls.json", balls(1));
  const auto ownBytes = [&](const std::string& estimator) { // of the estimator alone
    run("render balls.json --size 24x18 --spp 16 -o own.exr --stats own.json.stats --estimator " + estimator);
    return DeviceBytes(statistics("own")).planned;
  };
  const double ownMarch = ownBytes("march");
  const double ownTracking = ownBytes("tracking");
  ASSERT_EQ(render("a", "--estimator march").exitCode, 0);
  const DeviceBytes all(statistics("a"));
  const double cells = all.planned - all.caches - ownMarch;
  const auto memory = [](double bytes) { return " --memory " + std::to_string(std::llround(bytes)); };

  ASSERT_EQ(render("b", "--estimator march" + memory(ownMarch + cells + 0.5 * all.caches)).exitCode, 0);
  EXPECT_EQ(statistics("b")["light_caches"]["count"], 1);
  EXPECT_LT(DeviceBytes(statistics("b")).caches, 0.5 * all.caches);

  const Outcome dropped = render("c", "--estimator march" + memory(ownMarch + cells + 100));
  ASSERT_EQ(dropped.exitCode, 0) << dropped.errors;
  EXPECT_THAT(dropped.output, HasSubstr("light caches of suns and lamps: 0 of 1"));
  EXPECT_THAT(dropped.output, HasSubstr("1 light caches do not fit"));

  const Outcome tracked = render("d", memory(ownTracking + cells - 100));
  ASSERT_EQ(tracked.exitCode, 0) << tracked.errors;
  EXPECT_THAT(tracked.output, HasSubstr("estimator: tracking (the march does not serve: its grids need"));
  const Outcome refused = render("e", "--estimator march" + memory(ownMarch + cells - 100));
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_THAT(refused.errors, HasSubstr("--estimator march: its grids need"));
}

TEST_F(Estimators, TheExposureIsTheScenesAndItsSamplesAreNotThePictures) {
  double stops[2] = {};
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = render("a", std::string("--exposure auto --estimator ") + (i == 0 ? "march" : "tracking"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_EQ(statistics("a")["samples"], 24 * 18 * 16);
    stops[i] = statistics("a")["settings"]["exposure_stops"];
  }
  EXPECT_NEAR(stops[0], stops[1], 0.21); // each is rounded to a tenth, of 400 pixels
}

} // namespace
} // namespace tyndall::test

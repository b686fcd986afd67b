// SPDX-License-Identifier: Apache-2.0
// A report beside an earlier one.
#include "base/error.h"
#include "bench/baseline.h"

#include <gtest/gtest.h>

namespace tyndall::bench {
namespace {

constexpr double kError = 0.01;

/// One scene, one effort of ours and one of a peer, which has no say.
Report report(double relMse, double lookups, double segments) {
  Level level;
  level.label = "16";
  level.samples = 16;
  level.runs = 8;
  level.errors.relMse = {relMse, kError};
  level.errors.rRmse = {0.1, kError};
  level.cpu = level.wall = {1.0, kError};
  level.work = Work{1e6, lookups, segments, 0.0, 2.0};
  ContenderResult ours{"tyndall", "tyndall", true, {}, {level}, {}, {}, {}, {}, {}};
  ContenderResult peer{"peer", "Peer 1", false, {}, {level}, {}, {}, {}, {}, {}};
  peer.levels.front().work.reset();
  SceneResult scene{"a", "A.", {8, 8}, "path", "device", "scatter", {ours, peer}};
  return {"mine", "Mine", "tyndall bench", "2026-01-01 00:00:00", {{"processor", "x"}}, 8, {scene}};
}

const Change& changeOf(const std::vector<Change>& changes, const std::string& measure) {
  for (const Change& change : changes) {
    if (change.measure == measure) {
      return change;
    }
  }
  throw Error("no such measure: " + measure);
}

TEST(Baseline, TheSameIsNeitherBetterNorWorse) {
  const std::vector<Change> changes = compareReports(report(1e-2, 1e6, 1e5), report(1e-2, 1e6, 1e5));
  EXPECT_EQ(changes.size(), 3u) << "lookups, segments, dispatches; no pieces were counted";
  for (const Change& change : changes) {
    EXPECT_EQ(change.ratio.value, 1.0);
    EXPECT_FALSE(change.worse || change.better);
  }
}

TEST(Baseline, MoreWorkForTheSamePicturesIsWorse) {
  const std::vector<Change> changes = compareReports(report(1e-2, 1.2e6, 1e5), report(1e-2, 1e6, 1e5));
  EXPECT_TRUE(changeOf(changes, "relMSE x lookups").worse);
  EXPECT_FALSE(changeOf(changes, "relMSE x segments").worse);
}

TEST(Baseline, NoiseIsAllowedForAndMoreThanNoiseIsNot) {
  EXPECT_FALSE(changeOf(compareReports(report(1.03e-2, 1e6, 1e5), report(1e-2, 1e6, 1e5)), "relMSE x lookups").worse);
  EXPECT_TRUE(changeOf(compareReports(report(1.2e-2, 1e6, 1e5), report(1e-2, 1e6, 1e5)), "relMSE x lookups").worse);
  EXPECT_TRUE(changeOf(compareReports(report(0.8e-2, 1e6, 1e5), report(1e-2, 1e6, 1e5)), "relMSE x lookups").better);
}

TEST(Baseline, ReportsSurviveTheirFile) {
  const Report made = report(1e-2, 1e6, 1e5);
  const Report read = reportFromJson(toJson(made).dump(), "r.json");
  EXPECT_TRUE(toJson(made).contains("machine"));
  EXPECT_EQ(read.date, made.date);
  const std::vector<Change> changes = compareReports(report(2e-2, 1e6, 1e5), read);
  EXPECT_NEAR(changeOf(changes, "relMSE x segments").ratio.value, 2.0, 1e-12);
}

TEST(Baseline, WhatIsNoReportIsSaidToBeNone) {
  for (const char* text : {"{}", "[1", R"({"suite": 3})"}) {
    try {
      reportFromJson(text, "r.json");
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("r.json: not a report of tyndall bench"), std::string::npos);
    }
  }
}

TEST(Baseline, NothingInCommonIsAnError) {
  Report other = report(1e-2, 1e6, 1e5);
  other.scenes.front().name = "b";
  EXPECT_THROW(compareReports(report(1e-2, 1e6, 1e5), other), Error);
}

} // namespace
} // namespace tyndall::bench

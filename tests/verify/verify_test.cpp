// SPDX-License-Identifier: Apache-2.0
// `tyndall verify` as a library: checks pass on what is right, fail on planted bugs, and say what bias they see.
#include "base/error.h"
#include "support/probe.h"
#include "support/render_fixture.h"
#include "verify/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace tyndall::test {
namespace {

Result run(const Check& check, std::uint32_t bug = interop::kBugNone) {
  const Result result = runCheck(check, probeDevice(), {.plantedBug = bug}, rateOfEach(allChecks().size()));
  EXPECT_THAT(probeDevice().messages(), testing::IsEmpty());
  return result;
}

/// A check, and a bug that it must see.
struct Planted {
  const char* check;
  std::uint32_t bug;
  bool fast = false; ///< else in the long version alone
};

const Planted kPlanted[] = {{"airlight", interop::kBugPhaseSign},
                            {"airlight", interop::kBugJacobian},
                            {"lit-box", interop::kBugNoInverse4Pi},
                            {"lit-grid", interop::kBugHalfVoxel},
                            {"environment", interop::kBugBranchPdf, true},
                            {"sphere-light", interop::kBugBranchPdf},
                            {"ramp", interop::kBugHalfVoxel},
                            {"voxels", interop::kBugHalfVoxel, true},
                            {"furnace", interop::kBugBranchPdf},
                            {"furnace-grid", interop::kBugBranchPdf},
                            {"furnace-room", interop::kBugRoulette, true},
                            {"half-space", interop::kBugRoulette},
                            {"half-space-grid", interop::kBugRoulette},
                            {"march", interop::kBugNoCorrection},
                            {"march", interop::kBugOtherCache},
                            {"path", interop::kBugBranchPdf},
                            {"mcpg", interop::kBugChosenLobe},
                            {"mcpg", interop::kBugScatterShare},
                            {"mcpg-paper", interop::kBugScatterShare},
                            {"ray-query", interop::kBugRaySpheres}};

class Checks : public testing::TestWithParam<Planted> {};
INSTANTIATE_TEST_SUITE_P(, Checks, testing::ValuesIn(kPlanted));

TEST_P(Checks, PassAndSeeAPlantedBug) {
  if (!GetParam().fast && effort() == 1) {
    GTEST_SKIP() << "long version only";
  }
  const Check& check = *chosenChecks({GetParam().check}).front();
  const Result sound = run(check);
  if (sound.outcome == verify::Outcome::Skipped) {
    GTEST_SKIP() << sound.text;
  }
  EXPECT_EQ(sound.outcome, verify::Outcome::Passed) << sound.text;
  EXPECT_GT(sound.samples, 0u);
  ASSERT_TRUE(sound.detectable.has_value());
  EXPECT_LT(*sound.detectable, 0.25); // of the noisiest, paths guided as published
  const Result bad = run(check, GetParam().bug);
  EXPECT_EQ(bad.outcome, verify::Outcome::Failed) << GetParam().check << " bug " << GetParam().bug << " p " << bad.p;
  EXPECT_NE(bad.text, "");
}

/// 32 replicates of a picture of one tile: mean 1, spread 1 %.
Moments noise(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(1.0, 0.01);
  Moments moments;
  for (int replicate = 0; replicate < 32; ++replicate) {
    const double value = normal(random);
    moments.tileMeans.push_back({{value, value, value, value}});
  }
  return moments;
}

/// Share of runs in which a check of two means rejects the reference 1 + `bias` times what it says it sees.
double rejected(double bias) {
  static double reference = 1.0;
  static unsigned seed = 0;
  const Check check{"noise", "", "", [](Trial& trial) {
                      trial.mean("one", noise(seed), reference);
                      trial.mean("two", noise(seed + 1), 1.0);
                    }};
  int failed = 0;
  constexpr int kRuns = 400;
  for (int i = 0; i < kRuns; ++i) {
    seed = 2 * static_cast<unsigned>(i);
    reference = 1.0;
    const Result right = run(check);
    EXPECT_EQ(right.outcome, verify::Outcome::Passed) << right.text;
    reference = 1.0 + bias * right.detectable.value();
    failed += run(check).outcome == verify::Outcome::Failed ? 1 : 0;
  }
  return double(failed) / kRuns;
}

/// What it says rests on errors that are themselves estimated from 32 replicates.
TEST(Detectable, BiasIsFoundInHalfOfAllRuns) {
  EXPECT_NEAR(rejected(1.0), 0.5, 0.1);
  EXPECT_LT(rejected(0.5), 0.02);
  EXPECT_GT(rejected(1.5), 0.98);
}

TEST(Outcomes, WhatCannotRunNeverPasses) {
  const Check throws{"", "", "", [](Trial&) { fail("no memory"); }};
  EXPECT_EQ(run(throws).outcome, verify::Outcome::Failed);
  EXPECT_THAT(run(throws).text, testing::HasSubstr("no memory"));
  const Check skips{"", "", "", [](Trial& trial) { trial.skip("no such unit"); }};
  EXPECT_EQ(run(skips).outcome, verify::Outcome::Skipped);
  EXPECT_EQ(run(skips).text, "no such unit");
  const Check nothing{"", "", "", [](Trial& trial) {
                        Moments moments = noise(1);
                        moments.tileMeans[3][0][0] = std::numeric_limits<double>::quiet_NaN();
                        trial.mean("not finite", moments, 1.0);
                      }};
  EXPECT_EQ(run(nothing).outcome, verify::Outcome::Failed);
}

TEST(Names, AreUniqueAndTheNearestIsNamed) {
  const std::vector<std::string> names = checkNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(chosenChecks({}).size(), names.size());
  EXPECT_STREQ(chosenChecks({"mcpg", "airlight", "mcpg"}).front()->name, "airlight"); // the list's order, once each
  EXPECT_EQ(chosenChecks({"mcpg", "airlight", "mcpg"}).size(), 2u);
  try {
    chosenChecks({"furnance"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean furnace?"));
  }
}

/// All checks together, each at its own rate, raise one false alarm in 1 / kFamilyRate runs.
TEST(Rates, OfAllChecksComeToTheFamilys) {
  const double each = rateOfEach(21);
  EXPECT_NEAR(-std::expm1(21.0 * std::log1p(-each)), kFamilyRate, 1e-10);
  EXPECT_LT(each, kFamilyRate / 20.0);
}

} // namespace
} // namespace tyndall::test

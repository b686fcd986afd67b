// SPDX-License-Identifier: Apache-2.0
// `tyndall verify` as a user runs it, from a folder where there is nothing.
#include "app/program.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tyndall::test {
namespace {

using testing::HasSubstr;

class Verify : public testing::Test {
protected:
  Outcome run(const std::string& line) const { return runProgram(wordsOf(line, {}), folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(Verify, RunsTheNamedChecksAndSaysOnWhichDevice) {
  const Outcome outcome = run("verify furnace march-bits --json checks.json");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.output << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("2 of 2 checks passed"));
  EXPECT_THAT(namesIn(folder_.path()), testing::ElementsAre("checks.json"));
  const nlohmann::json json = nlohmann::json::parse(bytesOf(folder_ / "checks.json"));
  EXPECT_THAT(outcome.output, HasSubstr(json["device"].get<std::string>()));
  EXPECT_THAT(outcome.output, HasSubstr(json["driver"].get<std::string>()));
  EXPECT_TRUE(json["passed"].get<bool>());
  const nlohmann::json& furnace = json["checks"][0];
  EXPECT_EQ(furnace["name"], "furnace");
  EXPECT_EQ(furnace["outcome"], "passed");
  EXPECT_GT(furnace["p"], json["check_rate"]);
  EXPECT_LT(furnace["detectable_bias"], 0.01);
  EXPECT_TRUE(json["checks"][1]["detectable_bias"].is_null()); // bits have none
}

TEST_F(Verify, ListsWithoutRunning) {
  const Outcome outcome = run("verify --list");
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_THAT(outcome.output, HasSubstr("half-space-grid"));
  EXPECT_THAT(outcome.output, HasSubstr("Chandrasekhar"));
}

TEST_F(Verify, AnotherSeedIsAnotherSample) {
  const auto p = [&](const std::string& seed) {
    EXPECT_EQ(run("verify furnace --seed " + seed + " --json p.json").exitCode, 0);
    return nlohmann::json::parse(bytesOf(folder_ / "p.json"))["checks"][0]["p"].get<double>();
  };
  const double first = p("1");
  EXPECT_EQ(p("1"), first);
  EXPECT_NE(p("2"), first);
}

} // namespace
} // namespace tyndall::test

// SPDX-License-Identifier: Apache-2.0
#include "bench/process.h"

#include <gtest/gtest.h>

namespace tyndall::bench {
namespace {

TEST(Process, ToldByWhatItSaysAndHowItEnds) {
  const ProcessOutcome outcome = runProcess({"sh", "-c", "echo out; echo $NAME >&2; exit 3"}, {"NAME=value"}, 60.0);
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_EQ(outcome.output, "out\n");
  EXPECT_EQ(outcome.errors, "value\n");
  EXPECT_FALSE(outcome.timedOut);
  EXPECT_GT(outcome.peakBytes, 0u);
}

/// What a child of the program computes counts: `times` of the shell is the oracle, in the same process.
TEST(Process, TimeOfChildrenCounts) {
  const ProcessOutcome outcome =
      runProcess({"sh", "-c", "sh -c 'i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done'; exit 0"}, {}, 60.0);
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_GT(outcome.cpu, 0.005);
}

TEST(Process, OneThatTakesTooLongIsEndedWithItsChildren) {
  const ProcessOutcome outcome = runProcess({"sh", "-c", "sleep 100 & sleep 100"}, {}, 0.2);
  EXPECT_TRUE(outcome.timedOut);
  EXPECT_EQ(outcome.exitCode, -1);
}

TEST(Process, OneThatIsNotThere) { EXPECT_EQ(runProcess({"/no/such/program"}, {}, 60.0).exitCode, 127); }

/// More than a pipe holds.
TEST(Process, MuchOutputDoesNotBlock) {
  EXPECT_EQ(runProcess({"sh", "-c", "head -c 1000000 /dev/zero"}, {}, 60.0).output.size(), 1000000u);
}

TEST(Process, TheLastLineThatSaysSomething) {
  EXPECT_EQ(lastLine("a\nb \n\n"), "b");
  EXPECT_EQ(lastLine("a"), "a");
  EXPECT_EQ(lastLine("\n"), "");
}

} // namespace
} // namespace tyndall::bench

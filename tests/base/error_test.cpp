// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

TEST(Error, NamesFileLineAndColumn) {
  EXPECT_STREQ(Error({"a.json", 3, 7}, "albedo is 1.2").what(), "a.json:3:7: albedo is 1.2");
  EXPECT_STREQ(Error({"a.json", 0, 0}, "is empty").what(), "a.json: is empty");
  EXPECT_STREQ(Error({"", 3, 7}, "no device").what(), "no device");
}

TEST(NearestName, FindsTyposAndNothingFarAway) {
  const std::vector<std::string> names{"density", "temperature", "velocity"};
  EXPECT_EQ(nearestName("densty", names), "density");
  EXPECT_EQ(nearestName("temprature", names), "temperature");
  EXPECT_EQ(nearestName("xyz", names), "");
}

TEST(JoinNames, ReadsLikeASentence) {
  EXPECT_EQ(joinNames({}), "");
  EXPECT_EQ(joinNames({"a"}), "a");
  EXPECT_EQ(joinNames({"a", "b", "c"}), "a, b and c");
}

} // namespace
} // namespace tyndall

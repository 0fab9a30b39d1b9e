// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limber::names_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> kKnown = {"duration", "step", "fidelity"};

TEST(Names, NearestCorrectsASlip) {
  EXPECT_EQ(nearest_name("duraton", kKnown), "duration");
  EXPECT_EQ(nearest_name("stpe", kKnown), "step");
  EXPECT_EQ(nearest_name("fidelitty", kKnown), "fidelity");
}

TEST(Names, NearestOfAKnownNameIsItself) {
  for (const std::string& name : kKnown) {
    EXPECT_EQ(nearest_name(name, kKnown), name);
  }
}

TEST(Names, NothingIsNearAFarName) {
  EXPECT_EQ(nearest_name("completely_else", kKnown), "");
  EXPECT_EQ(nearest_name("anything", {}), "");
}

// A link of one of several robots without the robot's name.
TEST(Names, NearestIsQualified) {
  EXPECT_EQ(nearest_name("arm", {"arms", "left.arm"}), "left.arm");
  EXPECT_EQ(nearest_name("arm", {"left.arm", "arm"}), "arm");
  EXPECT_EQ(nearest_name("arm", {"left-arm", "leftarm"}), "");
}

TEST(Names, FirstOfEquallyNearNamesWins) {
  EXPECT_EQ(nearest_name("aa", {"ab", "ac"}), "ab");
}

TEST(Names, DescriptionSuggestsAndLists) {
  const std::string text = describe_unknown("key", "duraton", kKnown);
  EXPECT_THAT(text, HasSubstr("unknown key 'duraton'"));
  EXPECT_THAT(text, HasSubstr("did you mean 'duration'?"));
  EXPECT_THAT(text, HasSubstr("known: duration, step, fidelity"));
}

TEST(Names, DescriptionDoesNotGuessWildly) {
  EXPECT_THAT(describe_unknown("key", "zzzzzzzz", kKnown),
              Not(HasSubstr("did you mean")));
  EXPECT_THAT(describe_unknown("group", "tip", {}), HasSubstr("known: none"));
}

TEST(Names, DescriptionOfVeryManyNamesStaysShort) {
  std::vector<std::string> many;
  for (int i = 0; i < 5000; ++i) many.push_back("name" + std::to_string(i));
  const std::string text = describe_unknown("link", "nam1", many);
  EXPECT_THAT(text, HasSubstr("known: name0, name1, "));
  EXPECT_THAT(text, HasSubstr(" and 4970 more"));
  EXPECT_LT(text.size(), 500U);
}

}  // namespace
}  // namespace limber::names_test

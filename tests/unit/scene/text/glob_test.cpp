// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/glob.hpp"

#include <fnmatch.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace limber::scene::glob_test {
namespace {

// POSIX has the same rule for these two characters.
TEST(Glob, MatchesWhatTheShellDoes) {
  std::mt19937 random(7);
  const auto make_text = [&](const std::string& letters) {
    std::string text;
    const auto size = random() % 8;
    for (unsigned long i = 0; i < size; ++i) {
      text += letters[random() % letters.size()];
    }
    return text;
  };
  int matched = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string pattern = make_text("ab*?");
    const std::string name = make_text("ab");
    const bool expected = fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    EXPECT_EQ(matches(pattern, name), expected) << pattern << " " << name;
    matched += expected ? 1 : 0;
  }
  EXPECT_GT(matched, 1000);
}

TEST(Glob, TakesNoLongTimeForManyStars) {
  std::string pattern;
  for (int i = 0; i < 60; ++i) pattern += "a*";
  EXPECT_FALSE(matches(pattern + "b", std::string(200, 'a')));
}

TEST(Glob, KnowsPatternsByTheirCharacters) {
  EXPECT_TRUE(is_pattern("finger_*"));
  EXPECT_TRUE(is_pattern("finger_?"));
  EXPECT_FALSE(is_pattern("finger_1"));
}

}  // namespace
}  // namespace limber::scene::glob_test

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/path_step.hpp"

#include <gtest/gtest.h>

#include <set>

namespace limber::results::path_step_test {
namespace {

TEST(PathStep, OrdinaryNamesStayAsTheyAre) {
  for (const char* name : {"arm", "upper arm.ux", "Träger 梁", "..", "a.b"}) {
    EXPECT_EQ(to_path_step(name), name);
  }
}

TEST(PathStep, DifferentNamesStayDifferentStepsAndComeBack) {
  std::set<std::string> steps;
  const std::set<std::string> names = {
      "a/b", "a%2Fb", "a%252Fb", "a%b",   "a%25b", "/",    "//",  ".",
      "%2E", "%252E", "%",       "%%2F/", "./.",   "%/2F", "2F%", "a/./b"};
  for (const std::string& name : names) {
    const std::string step = to_path_step(name);
    EXPECT_EQ(step.find('/'), std::string::npos) << step;
    EXPECT_NE(step, ".");
    EXPECT_EQ(from_path_step(step), name);
    steps.insert(step);
  }
  EXPECT_EQ(steps.size(), names.size());
}

}  // namespace
}  // namespace limber::results::path_step_test

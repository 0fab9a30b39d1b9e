// SPDX-License-Identifier: BSD-3-Clause
// A comparison as a library, without a terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/compare/comparison.hpp"
#include "limber/runs/compare/comparison_selection.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::runs::compare_runs_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

/// A pendulum of 1 m that is released 1 rad from the vertical.
class ReleasedPendulum : public ::testing::Test {
 protected:
  ReleasedPendulum() { settings_.scenario = folder_.path() / "scenario.toml"; }

  [[nodiscard]] ComparisonPlan plan(std::vector<double> steps) const {
    return make_plan({.steps = std::move(steps)}, {}, scene_);
  }

  scene::test::SceneFolder folder_;
  scene::Scene scene_ = folder_.load(
      scene::test::kWorld +
          scene::test::rigid_link("bob", 2.0, 1e-3, "0 0 -1") +
          "<joint name='pin' type='continuous'><parent link='world'/>"
          "<child link='bob'/><axis xyz='0 1 0'/></joint>\n",
      scene::test::time_table(1.0, 0.01) +
          "output_interval = 0.1\n[gravity]\nacceleration = [0, 0, -9.81]\n"
          "[initial.joints]\npin = { position = 1.0 }\n"
          "[[probe]]\nname = 'angle'\njoint = 'pin'\n");
  ComparisonSettings settings_;
};

TEST_F(ReleasedPendulum, ErrsByTheSquareOfTheStep) {
  const Comparison found = compare_runs(plan({0.01, 0.005}), settings_);
  ASSERT_THAT(found.runs, SizeIs(2));
  const double coarse = found.runs[0].probes.at("angle.q").max;
  const double fine = found.runs[1].probes.at("angle.q").max;
  // Beside a reference with half the shortest step: (16 - 1) to (4 - 1).
  EXPECT_NEAR(coarse / fine, 5.0, 0.3);
  EXPECT_GT(fine, 1e-6);
  EXPECT_EQ(found.reference.probes.at("angle.q").max, 0.0);
}

TEST_F(ReleasedPendulum, SelectsTheLongerStepWithinATolerance) {
  const Comparison found = compare_runs(plan({0.01, 0.005}), settings_);
  const auto coarse =
      find_error(found.runs[0].error->error, ErrorMeasure::displacement);
  ASSERT_TRUE(coarse);
  const ComparedRun* cheapest = find_cheapest(
      found,
      {.tolerance = 0.99 * *coarse, .measure = ErrorMeasure::displacement});
  ASSERT_NE(cheapest, nullptr);
  EXPECT_EQ(cheapest->choice.step, 0.005);
}

TEST_F(ReleasedPendulum, GivesEachRunWithItsStatesWhileItLasts) {
  std::vector<std::size_t> states;
  settings_.keep = [&](const Choice&, const runs::Run& run) {
    states.push_back(run.history.states.size());
  };
  (void)compare_runs(plan({0.01}), settings_);
  EXPECT_THAT(states, ElementsAre(11U, 11U));
}

TEST_F(ReleasedPendulum, ShowsTheProgressOfAllRunsTogether) {
  double last = 0.0;
  settings_.progress = [&](std::string_view what, double fraction) {
    if (what != "all 3 runs") return;
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  (void)compare_runs(plan({0.01, 0.005}), settings_);
  EXPECT_NEAR(last, 1.0, 1e-12);
}

TEST_F(ReleasedPendulum, EndsARunWhereWatchThrows) {
  settings_.watch = [](std::string_view what, double) {
    if (what == "simulating") throw dynamics::Interrupted("enough");
  };
  EXPECT_THROW((void)compare_runs(plan({0.01}), settings_),
               dynamics::Interrupted);
}

}  // namespace
}  // namespace limber::runs::compare_runs_test

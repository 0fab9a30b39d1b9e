// SPDX-License-Identifier: BSD-3-Clause
// A scene run as a library, without a terminal.
#include "limber/runs/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::runs::run_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kGravity = 9.81;

/// A ball that is thrown upwards by 3 m/s at t = 0.
class ThrownBall : public ::testing::Test {
 protected:
  scene::test::SceneFolder folder_;
  scene::Scene scene_ = folder_.load(
      scene::test::rigid_link("ball", 2.0, 1.0),
      scene::test::time_table(1.0, 0.01) +
          "output_interval = 0.1\n[gravity]\nacceleration = [0, 0, -9.81]\n"
          "[initial.base]\nvelocity = [0, 0, 3]\n");
};

TEST_F(ThrownBall, FliesAsInAParabolaWithoutATerminal) {
  const runs::Run run = simulate_scene(scene_, {});
  ASSERT_FALSE(run.failure);
  ASSERT_THAT(run.history.times, SizeIs(11));
  for (std::size_t i = 0; i < run.history.times.size(); ++i) {
    const double t = run.history.times[i];
    const double z = 3.0 * t - 0.5 * kGravity * t * t;
    EXPECT_NEAR(run.history.states[i].bodies[0].p_WB.z(), z, 1e-12);
  }
  EXPECT_THAT(run.given_warnings, IsEmpty());
}

TEST_F(ThrownBall, KeepsWhatWasComputedBeforeProgressEndedIt) {
  RunOptions options;
  options.progress = [](std::string_view what, double fraction) {
    if (what == "simulating" && fraction >= 0.5) {
      throw dynamics::Interrupted("enough");
    }
  };
  scene_.scenario.settings.most_steps = 1'000'000;
  scene_.scenario.settings.step = 1e-6;  // long enough for reports of progress
  const runs::Run run = simulate_scene(scene_, options);
  ASSERT_TRUE(run.failure);
  EXPECT_THROW(std::rethrow_exception(run.failure), dynamics::Interrupted);
  ASSERT_GE(run.history.times.size(), 5U);
  EXPECT_LT(run.history.times.back(), 1.0);
}

TEST_F(ThrownBall, WarnsOnceOfCheckpointsThatCannotBeWritten) {
  std::vector<std::string> told;
  RunOptions options;
  options.checkpoints = {folder_.path() / "missing" / "run.bin", 0.0};
  options.warn = [&](const std::string& text) { told.push_back(text); };
  scene_.scenario.settings.step = 1e-3;  // more than 256 steps
  const runs::Run run = simulate_scene(scene_, options);
  EXPECT_FALSE(run.failure);
  EXPECT_THAT(told, ElementsAre(HasSubstr("no checkpoint at t = ")));
  EXPECT_EQ(run.given_warnings, told);
}

TEST_F(ThrownBall, StartsOnceBeforeItsFirstOutput) {
  int starts = 0;
  RunOptions options;
  options.starts = [&] { ++starts; };
  (void)simulate_scene(scene_, options);
  EXPECT_EQ(starts, 1);
}

}  // namespace
}  // namespace limber::runs::run_test

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/reduction/reduce.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/build/scene.hpp"
#include "places.hpp"

/// The capture arm of examples/struck_finger.toml at a step of 1 ms, its joints
/// from soft to stiffer than any material.
namespace limber::arm_stiffness_slow {
namespace {

/// The example with every joint's stiffness replaced [N/m], [N m/rad].
scene::Scene load_arm(double stiffness) {
  scene::Scene scene = scene::load_scene(std::string(LIMBER_SOURCE_DIR) +
                                         "/examples/struck_finger.toml");
  for (scene::Joint& joint : scene.robot.joints) {
    joint.coupler.translational_stiffness = stiffness;
    joint.coupler.rotational_stiffness = stiffness;
  }
  scene.scenario.settings.step = 1e-3;
  scene.scenario.settings.step_changes.clear();
  return scene;
}

class CaptureArm : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(cache_); }

  void expect_good_run(double stiffness) const {
    const scene::BuiltScene built = scene::build_system(
        load_arm(stiffness), flexbody::make_reducer(), cache_);
    dynamics::SystemState state = built.initial;
    dynamics::EnergyBalance last;
    const auto statistics = dynamics::simulate(
        built.model, state, built.settings,
        [&](const dynamics::SystemState&, const dynamics::EnergyBalance& now) {
          last = now;
        });
    EXPECT_EQ(state.t, built.settings.end_time);
    EXPECT_LE(static_cast<double>(statistics.newton_iterations),
              4.0 * static_cast<double>(statistics.steps));
    // Its motion is that of the strike only: 100 N and 10 N for 10 ms.
    EXPECT_NEAR(last.linear_momentum.norm(), std::hypot(1.0, 0.1), 0.05);
    EXPECT_LE(last.total(), last.work);
  }

  std::filesystem::path cache_ = std::filesystem::temp_directory_path() /
                                 ("limber-arm-" + std::to_string(::getpid()));
};

TEST_F(CaptureArm, RunsAtOneMillisecondInFourNewtonIterationsAtAnyStiffness) {
  for (const double stiffness :
       {1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13}) {
    SCOPED_TRACE(stiffness);
    expect_good_run(stiffness);
  }
}

}  // namespace
}  // namespace limber::arm_stiffness_slow

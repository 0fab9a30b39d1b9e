// SPDX-License-Identifier: BSD-3-Clause
// Static and linear analyses of a scene as a library, without a terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/runs/analyses/linear_run.hpp"
#include "limber/runs/analyses/static_run.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::runs::scene_analyses_test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kMass = 2.0;         // [kg]
constexpr double kStiffness = 800.0;  // [N/m]
constexpr double kGravity = 9.81;     // [m/s^2]

/// A mass that hangs on a spring along a slide.
class HangingMass : public ::testing::Test {
 protected:
  scene::Scene load(double gravity) {
    return folder_.load(
        scene::test::kWorld + scene::test::rigid_link("mass", kMass, 1e-2) +
            "<joint name='slide' type='prismatic'><parent link='world'/>"
            "<child link='mass'/><axis xyz='0 0 1'/>"
            "<limit lower='-1' upper='1' effort='1e4' velocity='100'/>"
            "</joint>\n<coupler joint='slide'>"
            "<spring stiffness='800'/></coupler>\n",
        scene::test::time_table(1.0, 0.01) +
            fmt::format("[gravity]\nacceleration = [0, 0, {}]\n"
                        "[[probe]]\nname = 'sag'\njoint = 'slide'\n",
                        -gravity));
  }

  scene::test::SceneFolder folder_;
};

TEST_F(HangingMass, SinksByItsWeightOverTheStiffness) {
  const StaticRun run =
      find_static(load(kGravity), dynamics::EquilibriumMethod::newton, {}, {});
  ASSERT_THAT(run.history.probe_rows, SizeIs(1));
  EXPECT_NEAR(run.history.probe_rows[0][0], -kMass * kGravity / kStiffness,
              1e-9);
  EXPECT_NEAR(*run.report.lowest_frequency,
              std::sqrt(kStiffness / kMass) / (2.0 * M_PI), 1e-6);
  EXPECT_THAT(run.warnings, IsEmpty());
}

TEST_F(HangingMass, IsRefusedWhereNothingActs) {
  EXPECT_THROW(
      (void)find_static(load(0.0), dynamics::EquilibriumMethod::newton, {}, {}),
      InputError);
}

TEST_F(HangingMass, IsALinearModelWithTheFrequencyOfTheSpring) {
  const LinearRun run =
      linearise_scene(load(kGravity), {.at = Reference::equilibrium}, {}, {});
  // det(A^2 + k / m I) = 0.
  const MatrixX& A = run.record.model.A;
  const MatrixX shifted =
      A * A + kStiffness / kMass * MatrixX::Identity(A.rows(), A.cols());
  EXPECT_NEAR(shifted.determinant() /
                  (A * A + kStiffness * MatrixX::Identity(A.rows(), A.cols()))
                      .determinant(),
              0.0, 1e-9);
}

}  // namespace
}  // namespace limber::runs::scene_analyses_test

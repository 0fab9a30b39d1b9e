// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/default_stiffness.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace limber::dynamics::default_stiffness_test {
namespace {

CouplerSide make_flexible(double translation, double rotation) {
  CouplerSide side;
  side.mass = 2.0;
  side.inertia = 1.0;
  side.flexibility = Matrix6::Zero();
  side.flexibility->diagonal() << translation, translation / 2, 0, rotation, 0,
      0;
  return side;
}

TEST(DefaultStiffness, IsAHundredTimesThatOfTheStifferSide) {
  const joints::JointParameters p = find_joint_parameters(
      {}, make_flexible(1e-6, 1e-4), make_flexible(1e-5, 1e-5));
  EXPECT_DOUBLE_EQ(p.translational_stiffness, 1e8);
  EXPECT_DOUBLE_EQ(p.rotational_stiffness, 1e7);
}

TEST(DefaultStiffness, OfRigidSidesGivesTheStatedFrequency) {
  CouplerSide side;
  side.mass = 2.0;
  side.inertia = 4.0;
  const joints::JointParameters p = find_joint_parameters({}, side, {});
  const double omega = 2.0 * std::numbers::pi * kRigidFrequency;
  EXPECT_DOUBLE_EQ(p.translational_stiffness, 2.0 * omega * omega);
  EXPECT_DOUBLE_EQ(p.rotational_stiffness, 4.0 * omega * omega);
}

TEST(DefaultStiffness, OfAStopLetsAFreeBodyTouchForTenMilliseconds) {
  CouplerSide F;
  F.mass = 2.0;
  F.inertia = 4.0;
  CouplerSide M = make_flexible(1e-6, 1e-4);
  M.mass = 6.0;
  M.inertia = 12.0;
  const StopStiffness stop = find_stop_stiffness(F, M);
  const double translational = std::sqrt(1.5 / stop.translational);
  const double rotational = std::sqrt(3.0 / stop.rotational);
  EXPECT_NEAR(std::numbers::pi * translational, 0.01, 1e-15);
  EXPECT_NEAR(std::numbers::pi * rotational, 0.01, 1e-15);
}

TEST(DefaultStiffness, LeavesWhatIsGivenAlone) {
  CouplerOptions options;
  options.translational_stiffness = 5.0;
  options.free_damping = 0.1;
  const joints::JointParameters p = find_joint_parameters(
      options, make_flexible(1e-6, 1e-4), make_flexible(1e-6, 1e-4));
  EXPECT_EQ(p.translational_stiffness, 5.0);
  EXPECT_EQ(p.free_damping, 0.1);
}

}  // namespace
}  // namespace limber::dynamics::default_stiffness_test

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/default_stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/common/rotation.hpp"

namespace limber::dynamics::default_stiffness_test {
namespace {

CouplerSide make_flexible(double translation, double rotation) {
  CouplerSide side;
  side.mass = 2.0;
  side.inertia = 1.0;
  side.flexibility = Matrix6::Zero();
  side.flexibility->diagonal() << translation, translation / 2, 0, rotation, 0,
      rotation / 4;
  return side;
}

/// The same side in axes turned by `rotation`.
CouplerSide rotate(CouplerSide side, const Vector3& turn) {
  Matrix6 R = Matrix6::Zero();
  R.topLeftCorner<3, 3>() = exp_rotation(turn);
  R.bottomRightCorner<3, 3>() = exp_rotation(turn);
  side.flexibility = R * *side.flexibility * R.transpose();
  return side;
}

// The least flexibilities that the interfaces have: 5e-7 m/N of the first,
// 2.5e-6 rad/(N m) of the second; directions without any are not defined.
TEST(DefaultStiffness, IsTwoHundredTimesThatOfTheStifferSideWhereItIsStiffest) {
  const CouplerSide first = make_flexible(1e-6, 1e-4);
  const CouplerSide second = make_flexible(1e-5, 1e-5);
  for (const Vector3& turn :
       {Vector3(0, 0, 0), Vector3(0.3, -0.5, 1.2), Vector3(0, 0, 1.5)}) {
    for (const bool is_swapped : {false, true}) {
      const CouplerSide F = rotate(is_swapped ? second : first, turn);
      const CouplerSide M = rotate(is_swapped ? first : second, turn);
      const joints::JointParameters p = find_joint_parameters({}, F, M);
      EXPECT_NEAR(p.translational_stiffness, 4e8, 1e-4);
      EXPECT_NEAR(p.rotational_stiffness, 8e7, 1e-5);
    }
  }
}

TEST(DefaultStiffness, DoesNotDependOnASoftDirection) {
  const CouplerSide stiff = make_flexible(1e-6, 1e-4);
  CouplerSide soft = stiff;
  (*soft.flexibility)(0, 0) *= 1e5;
  (*soft.flexibility)(3, 3) *= 1e5;
  EXPECT_EQ(find_joint_parameters({}, stiff, {}).translational_stiffness,
            find_joint_parameters({}, soft, {}).translational_stiffness);
  EXPECT_EQ(find_joint_parameters({}, stiff, {}).rotational_stiffness,
            find_joint_parameters({}, soft, {}).rotational_stiffness);
}

// Rounding of positions, 2^-52 of the distance, shakes a joint by
// (2 pi f)^2 times that.
TEST(DefaultStiffness, OfRigidSidesFarFromTheOriginAnswersLittleToRounding) {
  EXPECT_EQ(find_rigid_frequency(0.0), kRigidFrequency);
  EXPECT_EQ(find_rigid_frequency(100.0), kRigidFrequency);
  for (const double distance : {1e3, 3e4}) {
    const double omega =
        2.0 * std::numbers::pi * find_rigid_frequency(distance);
    EXPECT_NEAR(omega * omega * distance * std::ldexp(1.0, -52), 1e-3, 1e-15);
  }
  EXPECT_EQ(find_rigid_frequency(1e7), kLeastRigidFrequency);
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

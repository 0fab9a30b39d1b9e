// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/stress_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/rotation.hpp"

namespace limber::flexbody::stress_modes_test {
namespace {

Vector6 components(double xx, double yy, double zz, double xy, double yz,
                   double xz) {
  Vector6 s;
  s << xx, yy, zz, xy, yz, xz;
  return s;
}

TEST(VonMises, IsTheTensionOfABarAndRootThreeTimesItsShear) {
  EXPECT_DOUBLE_EQ(calc_von_mises(components(-5, 0, 0, 0, 0, 0)), 5.0);
  EXPECT_NEAR(calc_von_mises(components(0, 0, 0, 0, 2, 0)),
              2.0 * std::sqrt(3.0), 1e-15);
  EXPECT_EQ(calc_von_mises(components(7, 7, 7, 0, 0, 0)), 0.0);
}

// The roots of a plane stress: mean +- sqrt(half difference^2 + shear^2).
TEST(MaxPrincipal, IsThatOfMohrsCircle) {
  EXPECT_NEAR(calc_max_principal(components(3, -1, 0, 1.5, 0, 0)),
              1.0 + std::hypot(2.0, 1.5), 1e-14);
  EXPECT_NEAR(calc_max_principal(components(-4, 0, 0, 0, 0, 0)), 0.0, 1e-14);
  EXPECT_NEAR(calc_max_principal(components(-4, -4, -4, 0, 0, 0)), -4.0, 1e-14);
}

TEST(TurnedStress, OfAQuarterTurnAboutZSwapsXAndY) {
  Matrix3 R_BL;  // the frame's x is the body's y
  R_BL << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Vector6 turned = rotate_stress(components(1, 2, 3, 4, 5, 6), R_BL);
  EXPECT_LT((turned - components(2, 1, 3, -4, -6, 5)).norm(), 1e-15);
}

TEST(TurnedStress, KeepsItsInvariants) {
  const Vector6 stress = components(1.2, -0.7, 3.1, 0.4, -2.2, 0.9);
  const Vector6 turned =
      rotate_stress(stress, exp_rotation(Vector3(0.3, -1.1, 0.7)));
  EXPECT_NEAR(calc_von_mises(turned), calc_von_mises(stress), 1e-14);
  EXPECT_NEAR(calc_max_principal(turned), calc_max_principal(stress), 1e-14);
  EXPECT_GT((turned - stress).norm(), 0.1);
}

TEST(AveragingError, IsTheRootOfAShareOfTheStrainEnergy) {
  StressModes modes;
  modes.averaging = Eigen::Vector2d(0.04, 9.0).asDiagonal();
  const VectorX lambda = Eigen::Vector2d(4.0, 100.0);
  EXPECT_DOUBLE_EQ(
      find_averaging_error(modes, lambda, Eigen::Vector2d(-3.0, 0.0)), 0.1);
  EXPECT_DOUBLE_EQ(
      find_averaging_error(modes, lambda, Eigen::Vector2d(0.0, 0.1)), 0.3);
  EXPECT_EQ(find_averaging_error(modes, lambda, VectorX::Zero(2)), 0.0);
}

}  // namespace
}  // namespace limber::flexbody::stress_modes_test

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coordinates/required_rotations.hpp"

#include <gtest/gtest.h>

namespace limber::joints::required_rotations_test {
namespace {

using Kind = AxisCoordinate::Kind;

TEST(RequiredRotations, OfOneAngleAreThoseAboutItsAxis) {
  const Vector3 axis(0.6, 0.0, 0.8);
  const std::vector<AxisCoordinate> coordinates = {
      {.kind = Kind::distance, .axis = Vector3::UnitX()},
      {.kind = Kind::angle, .axis = axis}};
  const RequiredSides sides = find_required_rotations(coordinates, 1);
  for (const Matrix3& side : {sides.F, sides.M}) {
    EXPECT_LT((side * axis - axis).norm(), 1e-15);
    EXPECT_LT((side * Vector3::UnitY()).norm(), 1e-15);
    EXPECT_LT((side * axis.cross(Vector3::UnitY())).norm(), 1e-15);
  }
}

// Each turns the axes of the others.
TEST(RequiredRotations, OfSeveralAnglesAreAll) {
  const std::vector<AxisCoordinate> coordinates = {
      {.kind = Kind::angle, .axis = Vector3::UnitX()},
      {.kind = Kind::angle, .axis = Vector3::UnitY()}};
  const RequiredSides sides = find_required_rotations(coordinates, 0);
  EXPECT_EQ(sides.F, Matrix3(Matrix3::Identity()));
  EXPECT_EQ(sides.M, Matrix3(Matrix3::Identity()));
}

TEST(RequiredRotations, OfADistanceAreNone) {
  const std::vector<AxisCoordinate> coordinates = {
      {.kind = Kind::distance, .axis = Vector3::UnitX()},
      {.kind = Kind::angle, .axis = Vector3::UnitX()}};
  const RequiredSides sides = find_required_rotations(coordinates, 0);
  EXPECT_TRUE(sides.F.isZero(0.0));
  EXPECT_TRUE(sides.M.isZero(0.0));
}

}  // namespace
}  // namespace limber::joints::required_rotations_test

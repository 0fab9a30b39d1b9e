// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/motion_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/point_mass_body.hpp"

namespace limber::results::motion_error_test {
namespace {

using dynamics::Fidelity;
using dynamics::SystemState;

constexpr double kRoundoff = 1e-14;  // of numbers near one
constexpr double kAngle = 0.8;       // rad
constexpr int kFirst = 0;
constexpr int kSecond = 1;
constexpr int kBall = 2;

/// Two flexible bodies of 12 and 30 nodes, and a ball without nodes.
class MotionErrorTest : public ::testing::Test {
 protected:
  MotionErrorTest() {
    dynamics::SystemBuilder builder;
    builder.add_flexible_body("first", testing::share(first_),
                              Fidelity::coupled, {});
    builder.add_flexible_body("second", testing::share(second_),
                              Fidelity::coupled, {});
    builder.add_rigid_body("ball", {2.0, Vector3(0.5, 0.6, 0.7).asDiagonal()});
    model_ = builder.build();
    states_.assign(2, make_state(model_));
    states_[1].t = 1.0;
  }

  [[nodiscard]] SystemMotionError compare(
      const std::vector<SystemState>& states) const {
    return calc_motion_error({model_, states}, {model_, states_});
  }
  static void turn(SystemState& state, int body, double angle) {
    state.bodies[static_cast<std::size_t>(body)].quat_WB =
        Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitZ()));
  }
  static void shift(SystemState& state, int body, const Vector3& by) {
    state.bodies[static_cast<std::size_t>(body)].p_WB += by;
  }
  /// Root mean square of the nodes' distances from the axis z.
  static double radius(const testing::PointMassBody& body) {
    const Matrix3X& x = body.reduced.rows.x_B;
    return std::sqrt(x.topRows(2).squaredNorm() /
                     static_cast<double>(x.cols()));
  }

  const testing::PointMassBody first_ =
      testing::make_point_mass_body(12, 3, 5.0, 1.0, 200.0, 9);
  const testing::PointMassBody second_ =
      testing::make_point_mass_body(30, 2, 4.0, 2.0, 100.0, 4);
  dynamics::SystemModel model_;
  std::vector<SystemState> states_;  ///< the reference's, at 0 and 1 s
};

TEST_F(MotionErrorTest, OfAnEqualMotionIsZero) {
  shift(states_[1], kFirst, Vector3::Ones());
  turn(states_[1], kSecond, kAngle);
  states_[1].eta.setConstant(0.1);
  const MotionError error = compare(states_).error;
  EXPECT_EQ(error.displacement.relative(), 0.0);
  EXPECT_EQ(error.rigid.relative(), 0.0);
  EXPECT_EQ(error.deformation.relative(), 0.0);
}

TEST_F(MotionErrorTest, OfAMissedTurnIsItsChord) {
  const std::vector<SystemState> still = states_;
  for (const int body : {kFirst, kSecond, kBall}) {
    turn(states_[1], body, kAngle);
  }
  const SystemMotionError error = compare(still);
  // Half of the time nothing is wrong: the mean square is half the last one.
  const double chord = 2.0 * std::sin(kAngle / 2.0);
  const MotionError& first = error.bodies[kFirst].error;
  EXPECT_NEAR(first.displacement.max, chord * radius(first_), kRoundoff);
  EXPECT_NEAR(first.displacement.rms, chord * radius(first_) / std::sqrt(2.0),
              kRoundoff);
  EXPECT_NEAR(first.rigid.max, first.displacement.max, kRoundoff);
  EXPECT_NEAR(*first.displacement.relative(), 1.0, kRoundoff);
  EXPECT_NEAR(*first.rigid.relative_max(), std::sqrt(2.0), kRoundoff);
  EXPECT_EQ(first.deformation.relative(), std::nullopt);
  // Without nodes: the radius of gyration about z.
  const MotionError& ball = error.bodies[kBall].error;
  EXPECT_NEAR(ball.rigid.max, chord * std::sqrt(0.7 / 2.0), kRoundoff);
  EXPECT_EQ(ball.displacement.relative(), std::nullopt);
}

TEST_F(MotionErrorTest, OfAShiftIsItsLengthInEveryField) {
  std::vector<SystemState> shifted = states_;
  for (SystemState& state : shifted) shift(state, kFirst, {0.3, 0.0, 0.4});
  shift(states_[1], kFirst, {0.0, 8.0, 0.0});
  shift(shifted[1], kFirst, {0.0, 8.0, 0.0});
  const MotionError error = compare(shifted).bodies[kFirst].error;
  EXPECT_NEAR(error.displacement.rms, 0.5, kRoundoff);
  EXPECT_NEAR(error.rigid.rms, 0.5, kRoundoff);
  EXPECT_NEAR(*error.rigid.relative(), 0.5 / (8.0 / std::sqrt(2.0)), kRoundoff);
  EXPECT_EQ(error.deformation.rms, 0.0);
}

TEST_F(MotionErrorTest, OfDeformationIsNotHiddenByAGoodRigidMotion) {
  shift(states_[1], kFirst, {1e3, 0.0, 0.0});
  turn(states_[1], kFirst, kAngle);
  std::vector<SystemState> half = states_;
  states_[1].eta[0] = 0.02;
  half[1].eta[0] = 0.01;
  const MotionError error = compare(half).bodies[kFirst].error;
  EXPECT_NEAR(*error.deformation.relative(), 0.5, kRoundoff);
  EXPECT_EQ(error.rigid.relative(), 0.0);
  EXPECT_LT(*error.displacement.relative(), 1e-4);
  // The mode's own root mean square over the nodes, half of it in the end.
  const VectorX shape = first_.reduced.rows.Phi_B.col(0);
  EXPECT_NEAR(error.deformation.max, 0.01 * shape.norm() / std::sqrt(12.0),
              kRoundoff);
}

TEST_F(MotionErrorTest, OfAllBodiesCountsNodesInDisplacementAndBodiesInRigid) {
  std::vector<SystemState> shifted = states_;
  for (SystemState& state : shifted) shift(state, kFirst, {0.0, 0.0, 3.0});
  for (SystemState& state : states_) {
    for (const int body : {kFirst, kSecond, kBall}) {
      shift(state, body, {1.0, 0.0, 0.0});
    }
  }
  for (SystemState& state : shifted) {
    for (const int body : {kFirst, kSecond, kBall}) {
      shift(state, body, {1.0, 0.0, 0.0});
    }
  }
  const MotionError error = compare(shifted).error;
  EXPECT_NEAR(error.displacement.rms, 3.0 * std::sqrt(12.0 / 42.0), 1e-13);
  EXPECT_NEAR(error.rigid.rms, 3.0 * std::sqrt(1.0 / 3.0), 1e-13);
}

TEST_F(MotionErrorTest, OfManyStatesIsThatOfFew) {
  turn(states_[1], kFirst, kAngle);
  std::vector<SystemState> other = states_;
  other[1].eta[1] = 0.1;
  const MotionError few = compare(other).error;
  for (int i = 0; i < 99; ++i) {
    for (const std::size_t j : {0U, 1U}) {
      states_.push_back(states_[j]);
      other.push_back(other[j]);
    }
  }
  const MotionError many = compare(other).error;
  EXPECT_NEAR(many.displacement.rms, few.displacement.rms, kRoundoff);
  EXPECT_NEAR(many.displacement.reference, few.displacement.reference,
              kRoundoff);
  EXPECT_NEAR(many.deformation.rms, few.deformation.rms, kRoundoff);
}

TEST_F(MotionErrorTest, IsNoneWhereTheReferenceHasRoundOffAlone) {
  std::vector<SystemState> moved = states_;
  shift(moved[1], kFirst, {1.0, 0.0, 0.0});
  moved[1].eta.setOnes();
  states_[1].eta.setConstant(1e-15);
  for (const BodyMotionError& body : compare(moved).bodies) {
    EXPECT_EQ(body.error.displacement.relative(), std::nullopt) << body.name;
    EXPECT_EQ(body.error.rigid.relative(), std::nullopt) << body.name;
    EXPECT_EQ(body.error.deformation.relative_max(), std::nullopt);
  }
}

TEST_F(MotionErrorTest, RefusesOtherTimesAndOtherBodies) {
  std::vector<SystemState> late = states_;
  late[1].t = 2.0;
  EXPECT_THROW((void)compare(late), ContractError);
  late.pop_back();
  EXPECT_THROW((void)compare(late), ContractError);
  dynamics::SystemModel other = model_;
  other.bodies[kSecond].name = "third";
  EXPECT_THROW((void)calc_motion_error({other, states_}, {model_, states_}),
               ContractError);
}

}  // namespace
}  // namespace limber::results::motion_error_test

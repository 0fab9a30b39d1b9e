// SPDX-License-Identifier: BSD-3-Clause
// Guesses and corrections of unreduced bodies that rotate.
#include "limber/dynamics/bodies/nodal_rotation.hpp"

#include <gtest/gtest.h>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "support/full_lattice.hpp"

namespace limber::dynamics::nodal_rotation_test {
namespace {

const Vector3 kSpin(30.0, -10.0, 20.0);  // rad/s

// A lattice that is bent far and spins as a rigid body.
class NodalRotation : public ::testing::Test {
 protected:
  NodalRotation() {
    calc_mean_frame(model_, full(), state_, frame_);
    auto udot = nodes_of(full(), state_.udot_H);
    for (Eigen::Index i = 0; i < udot.cols(); ++i) {
      udot.col(i) = Vector3(0.5, 0.2, -0.7) + kSpin.cross(find_arm(i));
    }
    calc_mean_frame(model_, full(), state_, frame_);
  }

  [[nodiscard]] const FullModel& full() const { return model_.full_bodies[0]; }
  // From the frame's origin.
  [[nodiscard]] Vector3 find_arm(Eigen::Index i) const {
    return full().mesh->x_B.col(i) + nodes_of(full(), state_.u_H).col(i) -
           frame_.p_HB;
  }

  testing::Lattice lattice_;
  SystemModel model_ = lattice_.builder.build();
  SystemState state_ = testing::stir(model_);
  MeanFrame frame_;
};

TEST_F(NodalRotation, GuessesTheStepOfABentBodyThatSpinsAndFalls) {
  const NewmarkStep step{.h = 1e-2, .lag = 0.2, .beta = 0.3};
  const Vector3 fall(1.0, -9.0, 4.0);
  VectorX uddot = make_unknowns(model_);
  auto acceleration = nodal_rows(model_, full(), uddot);
  for (Eigen::Index i = 0; i < acceleration.cols(); ++i) {
    acceleration.col(i) = fall + kSpin.cross(kSpin.cross(find_arm(i)));
  }
  VectorX a = make_unknowns(model_);
  nodal_rows(model_, a) = testing::make_field(state_.u_H.size(), 5.0, 7);
  VectorX a_next = make_unknowns(model_);
  ASSERT_TRUE(predict_rotations(model_, state_, uddot, a, step, a_next));
  const VectorX next = state_.u_H + step.h * state_.udot_H +
                       step.h * step.h *
                           (step.lag * nodal_rows(model_, a) +
                            step.beta * nodal_rows(model_, a_next));
  const double s = step.lag + step.beta;
  const Matrix3 change = exp_rotation(step.h * kSpin) - Matrix3::Identity();
  for (Eigen::Index i = 0; i < acceleration.cols(); ++i) {
    const Vector3 expected = nodes_of(full(), state_.u_H).col(i) +
                             step.h * frame_.v_H + s * step.h * step.h * fall +
                             change * find_arm(i);
    EXPECT_LT((nodes_of(full(), next).col(i) - expected).norm(), 1e-12) << i;
  }
}

TEST_F(NodalRotation, DoesNotGuessForABodyThatHardlyRotates) {
  state_.udot_H *= 1e-4;
  const VectorX zero = make_unknowns(model_);
  VectorX a_next = zero;
  EXPECT_FALSE(
      predict_rotations(model_, state_, zero, zero, {1e-2, 0.2, 0.3}, a_next));
}

TEST_F(NodalRotation, TurnsACorrectionWithoutStrain) {
  // A linear rotation about the frame's origin, and a translation.
  const Vector3 theta(0.2, 0.1, -0.3);
  const Vector3 shift(0.01, 0.02, 0.03);
  VectorX d = make_unknowns(model_);
  auto correction = nodal_rows(model_, full(), d);
  for (Eigen::Index i = 0; i < correction.cols(); ++i) {
    correction.col(i) = shift + theta.cross(find_arm(i));
  }
  rotate_corrections(model_, state_, d);
  const Matrix3 change = exp_rotation(theta) - Matrix3::Identity();
  for (Eigen::Index i = 0; i < correction.cols(); ++i) {
    EXPECT_LT((correction.col(i) - shift - change * find_arm(i)).norm(), 1e-12)
        << i;
  }
}

}  // namespace
}  // namespace limber::dynamics::nodal_rotation_test

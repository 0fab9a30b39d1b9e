// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/bushing.hpp"

#include <gtest/gtest.h>

#include <random>

#include "limber/common/rotation.hpp"
#include "limber/joints/coupler_law.hpp"
#include "unit/joints/coupler_cases.hpp"

namespace limber::joints::bushing_test {
namespace {

Bushing full_bushing() {
  for (const auto& item : testing::coupler_cases()) {
    if (item.name == "full bushing") return std::get<Bushing>(item.law());
  }
  throw std::logic_error("no full bushing");
}

Matrix6 whole(const Matrix3& t, const Matrix3& c, const Matrix3& r) {
  Matrix6 m;
  m << t, c, c.transpose(), r;
  return m;
}

TEST(Bushing, SmallMotionsFeelTheWholeStiffnessAndDamping) {
  const Bushing bushing = full_bushing();
  const Bushing::Parameters& p = bushing.parameters();
  const Matrix6 K = whole(p.translational_stiffness, p.coupling_stiffness,
                          p.rotational_stiffness);
  const Matrix6 C =
      whole(p.translational_damping, p.coupling_damping, p.rotational_damping);
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3 step = 1e-6 * testing::random_vector(random);
    const Vector3 turn = 1e-6 * testing::random_vector(random);
    RelativeMotion motion;
    motion.p_FM_F = step;
    motion.R_FM = exp_rotation(turn);
    motion.v_FM_F = 1e-6 * testing::random_vector(random);
    motion.w_FM_F = 1e-6 * testing::random_vector(random);
    Vector6 x;
    x << step, turn;
    const Vector6 expected = -K * x - C * testing::velocity_of(motion);
    const CouplerResponse at = bushing.evaluate(motion);
    // Terms of second order.
    EXPECT_LT((at.wrench - expected).norm(), 1e-5 * expected.norm());
    EXPECT_NEAR(at.energy, 0.5 * x.dot(K * x), 1e-5 * at.energy);
  }
}

// With s = sin(theta) e: never less than the form, so never negative.
TEST(Bushing, EnergyIsAtLeastTheFormOfTranslationAndSine) {
  const Bushing bushing = full_bushing();
  const Bushing::Parameters& p = bushing.parameters();
  const Matrix6 K = whole(p.translational_stiffness, p.coupling_stiffness,
                          p.rotational_stiffness);
  std::mt19937 random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const RelativeMotion motion =
        testing::random_motion(JointKind::floating, random);
    const Vector3 theta = log_rotation(motion.R_FM);
    Vector6 x;
    x << motion.p_FM_F, std::sin(theta.norm()) * theta.normalized();
    const double form = 0.5 * x.dot(K * x);
    EXPECT_GT(form, 0.0);
    EXPECT_GE(bushing.evaluate(motion).energy, form * (1.0 - 1e-12));
  }
}

// A screw along the axis held with coupling: no force follows a turn about it.
TEST(Bushing, AnAxisWithoutStiffnessStaysFreeBesideACoupling) {
  Matrix3 Kr = Matrix3::Zero();
  Kr.diagonal() = Vector3(30.0, 40.0, 0.0);
  Matrix3 Kc = Matrix3::Zero();
  Kc(0, 1) = 20.0;
  const Bushing bushing({.translational_stiffness = 50.0 * Matrix3::Identity(),
                         .rotational_stiffness = Kr,
                         .coupling_stiffness = Kc});
  for (double angle = -20.0; angle < 20.0; angle += 0.9) {
    RelativeMotion motion;
    motion.R_FM = exp_rotation(angle * Vector3::UnitZ());
    EXPECT_LT(bushing.evaluate(motion).wrench.norm(), 1e-13);
    EXPECT_LT(std::abs(bushing.evaluate(motion).energy), 1e-13);
  }
}

constexpr double kStiffness = 1e14;

// With a free axis, and dampers a thousandth of its springs.
Bushing make_stiff(JointKind kind, const Vector3& axis) {
  return make_joint_bushing(kind, axis,
                            {.translational_stiffness = kStiffness,
                             .rotational_stiffness = kStiffness,
                             .translational_damping = 1e-3 * kStiffness,
                             .rotational_damping = 1e-3 * kStiffness});
}

// Springs and dampers of a skew hinge pull against each other, each at 1e9.
TEST(Bushing, AFreeAxisFeelsRoundoffOfTheWrenchNotOfTheStiffness) {
  const Vector3 axis = Vector3(1, 2, 2) / 3.0;
  const Vector3 tilt = Vector3(2, 1, -2) / 3.0;
  constexpr double kFreeDamping = 5.0;
  const Bushing hinge = make_stiff(JointKind::revolute, axis);
  const Bushing slider =
      make_joint_bushing(JointKind::prismatic, axis,
                         {.translational_stiffness = kStiffness,
                          .rotational_stiffness = kStiffness,
                          .translational_damping = 1e9,
                          .rotational_damping = 1e9,
                          .free_damping = kFreeDamping});
  for (double turn = -20.0; turn < 20.0; turn += 0.7) {
    RelativeMotion motion;
    motion.R_FM = exp_rotation(1e-5 * tilt) * exp_rotation(turn * axis);
    motion.w_FM_F = -1e-2 * tilt + 8.0 * axis;
    EXPECT_LT(std::abs(hinge.evaluate(motion).wrench.tail<3>().dot(axis)),
              1e-5);
    motion = {};
    motion.p_FM_F = turn * axis;
    motion.v_FM_F = 3.0 * axis;
    EXPECT_NEAR(slider.evaluate(motion).wrench.head<3>().dot(axis),
                -3.0 * kFreeDamping, 1e-6 * kFreeDamping);
    EXPECT_LT(slider.evaluate(motion).energy, 1e-12);
  }
}

// The slider's spring and damper pull against each other, each with 1e9 N.
TEST(Bushing, AFreeTranslationFeelsRoundoffOfTheWrenchNotOfTheStiffness) {
  for (const Vector3& along : {Vector3(1, 2, 2), Vector3(-3, 1, 7)}) {
    const Vector3 axis = along.normalized();
    const Vector3 tilt = axis.unitOrthogonal();
    const Bushing slider = make_stiff(JointKind::prismatic, axis);
    for (double angle = 0.0; angle < 6.0; angle += 0.1) {
      RelativeMotion motion;
      const Vector3 side = exp_rotation(angle * axis) * tilt;
      motion.p_FM_F = 1e-5 * side;
      motion.v_FM_F = -1e-2 * side;
      const Vector3 force = slider.evaluate(motion).wrench.head<3>();
      EXPECT_LT(std::abs(force.dot(axis)), 1e-12);
    }
  }
}

}  // namespace
}  // namespace limber::joints::bushing_test

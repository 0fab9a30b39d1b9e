// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/joint_kind.hpp"

#include <gtest/gtest.h>

#include "limber/common/rotation.hpp"

namespace limber::joints::joint_kind_test {
namespace {

TEST(JointBushing, RevoluteIsFreeThroughManyTurns) {
  const Vector3 axis = Vector3(0.0, 0.6, 0.8);
  const Bushing hinge = make_joint_bushing(
      JointKind::revolute, axis,
      {.translational_stiffness = 1e9, .rotational_stiffness = 1e7});
  for (double angle = -700.0; angle < 700.0; angle += 7.3) {
    RelativeMotion motion;
    motion.R_FM = exp_rotation(angle * axis);
    const CouplerResponse r = hinge.evaluate(motion);
    // Round-off of a rotation matrix times the stiffness.
    EXPECT_LT(r.wrench.norm(), 1e7 * 1e-14);
    EXPECT_LT(std::abs(r.energy), 1e7 * 1e-14);
  }
}

TEST(JointBushing, TiltOfARevoluteIsHeldWithItsStiffness) {
  const Bushing hinge = make_joint_bushing(
      JointKind::revolute, Vector3::UnitZ(), {.rotational_stiffness = 500.0});
  RelativeMotion motion;
  motion.R_FM = exp_rotation(1e-5 * Vector3::UnitX()) *
                exp_rotation(2.0 * Vector3::UnitZ());
  const CouplerResponse r = hinge.evaluate(motion);
  EXPECT_NEAR(r.wrench[3], -500.0 * 1e-5, 1e-10);
  EXPECT_NEAR(r.energy, 0.5 * 500.0 * 1e-10, 1e-14);
}

TEST(JointBushing, PrismaticHoldsAllButItsAxis) {
  const Bushing slider = make_joint_bushing(
      JointKind::prismatic, Vector3::UnitX(),
      {.translational_stiffness = 10.0, .rotational_stiffness = 10.0});
  RelativeMotion motion;
  motion.p_FM_F = Vector3(5.0, 1.0, 2.0);
  EXPECT_EQ(Vector3(slider.evaluate(motion).wrench.head<3>()),
            Vector3(0.0, -10.0, -20.0));
}

TEST(JointBushing, PlanarHoldsNormalTranslationAndTilt) {
  const Bushing plane = make_joint_bushing(
      JointKind::planar, Vector3::UnitZ(),
      {.translational_stiffness = 10.0, .rotational_stiffness = 10.0});
  RelativeMotion motion;
  motion.p_FM_F = Vector3(5.0, 1.0, 2.0);
  motion.R_FM = exp_rotation(1.0 * Vector3::UnitZ());
  const Vector6 wrench = plane.evaluate(motion).wrench;
  EXPECT_EQ(Vector3(wrench.head<3>()), Vector3(0.0, 0.0, -20.0));
  EXPECT_LT(wrench.tail<3>().norm(), 1e-14);
}

TEST(JointBushing, FloatingHoldsNothing) {
  const Bushing free = make_joint_bushing(JointKind::floating, Vector3::Zero(),
                                          {.translational_stiffness = 10.0});
  RelativeMotion motion;
  motion.p_FM_F = Vector3(5.0, 1.0, 2.0);
  EXPECT_EQ(free.evaluate(motion).wrench.norm(), 0.0);
}

TEST(JointKind, EachHasItsCoordinates) {
  using enum JointKind;
  using Kind = AxisCoordinate::Kind;
  const Vector3 a = Vector3::UnitZ();
  const Vector3 b = Vector3::UnitX();
  const auto kinds = [&](JointKind kind) {
    std::vector<Kind> list;
    for (const AxisCoordinate& c : find_coordinates(kind, 3.0 * a, 2.0 * b)) {
      EXPECT_NEAR(c.axis.norm(), 1.0, 1e-15);
      list.push_back(c.kind);
    }
    return list;
  };
  EXPECT_TRUE(kinds(fixed).empty());
  EXPECT_TRUE(kinds(floating).empty());
  EXPECT_EQ(kinds(revolute), std::vector{Kind::angle});
  EXPECT_EQ(kinds(continuous), std::vector{Kind::angle});
  EXPECT_EQ(kinds(prismatic), std::vector{Kind::distance});
  EXPECT_EQ(kinds(planar),
            (std::vector{Kind::distance, Kind::distance, Kind::angle}));
  EXPECT_EQ(kinds(universal), (std::vector{Kind::angle, Kind::angle}));
  EXPECT_EQ(kinds(ball), (std::vector{Kind::angle, Kind::angle, Kind::angle}));
}

TEST(JointKind, APlanesAxesAreARightHandedTriadWithItsNormal) {
  for (const Vector3& axis :
       {Vector3(0.0, 0.0, 1.0), Vector3(0.0, 0.0, -1.0), Vector3(0.6, 0.0, 0.8),
        Vector3(-1.0, 0.0, 0.0)}) {
    const auto [x, y] = find_plane_axes(axis);
    EXPECT_NEAR(x.norm(), 1.0, 1e-15);
    EXPECT_LT((x.cross(y) - axis).norm(), 1e-15);
  }
  EXPECT_EQ(find_plane_axes(Vector3::UnitZ()).x, Vector3(Vector3::UnitX()));
}

TEST(JointKind, FreeDampingActsInTheFreeDirectionsAlone) {
  RelativeMotion motion;
  motion.v_FM_F = Vector3(1.0, 2.0, 3.0);
  motion.w_FM_F = Vector3(4.0, 5.0, 6.0);
  const auto wrench = [&](JointKind kind) {
    const Joint joint = make_joint(kind, Vector3::UnitZ(), Vector3::UnitX(),
                                   {.free_damping = 2.0});
    return Vector6(-0.5 * joint.evaluate(motion, {}, {}).wrench);
  };
  using enum JointKind;
  const auto expect = [&](JointKind kind, const Vector3& v, const Vector3& w) {
    Vector6 expected;
    expected << v, w;
    EXPECT_LT((wrench(kind) - expected).norm(), 1e-14) << to_string(kind);
  };
  const Vector3 none = Vector3::Zero();
  expect(fixed, none, none);
  expect(revolute, none, Vector3(0.0, 0.0, 6.0));
  expect(prismatic, Vector3(0.0, 0.0, 3.0), none);
  expect(planar, Vector3(1.0, 2.0, 0.0), Vector3(0.0, 0.0, 6.0));
  expect(universal, none, Vector3(4.0, 0.0, 6.0));
  expect(ball, none, motion.w_FM_F);
  expect(floating, motion.v_FM_F, motion.w_FM_F);
}

TEST(JointKind, AUniversalJointIsFreeInItsTwoAngles) {
  const Vector3 a = Vector3(2.0, -1.0, 2.0) / 3.0;
  const Vector3 b = Vector3(2.0, 2.0, -1.0) / 3.0;
  const Joint joint =
      make_joint(JointKind::universal, a, b,
                 {.translational_stiffness = 1e9, .rotational_stiffness = 1e7});
  for (double s = -9.0; s < 9.0; s += 0.7) {
    for (double t = -9.0; t < 9.0; t += 0.7) {
      RelativeMotion motion;
      motion.R_FM = exp_rotation(s * a) * exp_rotation(t * b);
      // Round-off of a rotation matrix times the stiffness.
      EXPECT_LT(joint.evaluate(motion, {}, {}).wrench.norm(), 1e7 * 1e-14);
    }
  }
}

TEST(JointKind, TiltOfAUniversalJointIsHeldWithItsStiffness) {
  const Joint joint =
      make_joint(JointKind::universal, Vector3::UnitX(), Vector3::UnitY(),
                 {.rotational_stiffness = 500.0});
  RelativeMotion motion;
  motion.R_FM = exp_rotation(1.1 * Vector3::UnitX()) *
                exp_rotation(1e-5 * Vector3::UnitZ()) *
                exp_rotation(0.7 * Vector3::UnitY());
  const CouplerResponse at = joint.evaluate(motion, {}, {});
  EXPECT_NEAR(at.energy, 0.5 * 500.0 * 1e-10, 1e-14);
  EXPECT_NEAR(at.wrench.tail<3>().norm(), 500.0 * 1e-5, 1e-10);
}

TEST(JointKind, AnElementActsAlongItsCoordinate) {
  const Joint joint =
      make_joint(JointKind::planar, Vector3::UnitZ(), Vector3::Zero(), {},
                 {{1, ScalarSpring({.curve = SpringCurve({.stiffness = 8.0})})},
                  {2, Friction({.viscous = 3.0})},
                  {1, ScalarSpring({.curve = SpringCurve({.stiffness = 2.0}),
                                    .rest = 1.0})}});
  RelativeMotion motion;
  motion.p_FM_F = Vector3(7.0, 0.5, 7.0);
  motion.w_FM_F = Vector3(7.0, 7.0, 2.0);
  Vector6 expected;
  expected << 0.0, -4.0 + 1.0, 0.0, 0.0, 0.0, -6.0;
  EXPECT_LT((joint.evaluate(motion, {}, {}).wrench - expected).norm(), 1e-14);
}

TEST(JointKind, ASpringWindsUpThroughWholeTurns) {
  const Joint joint = make_joint(
      JointKind::revolute, Vector3::UnitZ(), Vector3::Zero(), {},
      {{0, ScalarSpring({.curve = SpringCurve({.stiffness = 0.5})})}});
  CouplerMemory memory;
  for (double angle = 0.0; angle < 200.0; angle += 0.5) {
    RelativeMotion motion;
    motion.R_FM = exp_rotation(angle * Vector3::UnitZ());
    const CouplerResponse at = joint.evaluate(motion, memory, {});
    EXPECT_NEAR(at.wrench[5], -0.5 * angle, 1e-11);
    EXPECT_NEAR(at.energy, 0.25 * angle * angle, 1e-9);
    memory.near[0] = angle;
  }
}

// Beside its axis the gradient of an angle is not of length one.
TEST(JointKind, AtItsTargetVelocityATiltedHingeTurnsAsItsDriveCommands) {
  const Vector3 axis(0.0, 0.6, 0.8);
  const Joint joint = make_joint(JointKind::revolute, axis, Vector3::Zero(), {},
                                 {{0, Drive({.mode = DriveMode::velocity,
                                             .signal = {ConstantSignal{2.5}},
                                             .damping = 3.0})}});
  for (const double tilt : {0.0, 0.4, 1.2}) {
    RelativeMotion motion;
    motion.R_FM =
        exp_rotation(tilt * Vector3::UnitX()) * exp_rotation(0.7 * axis);
    motion.w_FM_F = joint.find_target_velocity(motion, {}, {}).tail<3>();
    const double rate = evaluate(joint.coordinates()[0], motion, 0.0).rate;
    EXPECT_NEAR(rate, 2.5, 1e-14);
    EXPECT_LT(joint.evaluate(motion, {}, {}).wrench.norm(), 1e-13);
  }
}

}  // namespace
}  // namespace limber::joints::joint_kind_test

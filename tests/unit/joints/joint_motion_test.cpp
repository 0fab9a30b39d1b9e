// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/joint_motion.hpp"

#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::joints::joint_motion_test {
namespace {

constexpr double kRoundOff = 1e-13;

const Vector3 kAxis = Vector3(1.0, 2.0, 2.0) / 3.0;
const Vector3 kSecond = Vector3(2.0, 1.0, -2.0) / 3.0;

const std::vector<JointKind> kKinds = {
    JointKind::fixed,     JointKind::revolute, JointKind::continuous,
    JointKind::prismatic, JointKind::planar,   JointKind::floating,
    JointKind::universal, JointKind::ball};

Joint make(JointKind kind) {
  return make_joint(
      kind, 5.0 * kAxis, 0.1 * kSecond,
      {.translational_stiffness = 1e5, .rotational_stiffness = 1e3});
}

/// Different numbers, rates `u`, a time `dt` later.
JointCoordinates make_coordinates(JointKind kind, double dt) {
  JointCoordinates q;
  for (std::size_t i = 0; i < coordinate_count(kind); ++i) {
    const double rate = 0.3 - 0.2 * static_cast<double>(i);
    q.position.push_back(0.4 + 0.1 * static_cast<double>(i) + dt * rate);
    q.velocity.push_back(rate);
  }
  return q;
}

TEST(JointMotion, OfEachKindLeavesItsHoldUnstressed) {
  for (const JointKind kind : kKinds) {
    SCOPED_TRACE(to_string(kind));
    const Joint joint = make(kind);
    const RelativeMotion motion =
        find_joint_motion(find_shape(joint), make_coordinates(kind, 0.0));
    const CouplerResponse response = joint.evaluate(motion, {}, {});
    EXPECT_LT(response.energy, 1e-20);
    EXPECT_LT(response.wrench.norm(), 1e-9);
    EXPECT_LT((response.stiffness.topLeftCorner<3, 3>() * motion.v_FM_F).norm(),
              1e5 * kRoundOff);
  }
}

TEST(JointMotion, ReadsBackAsTheCoordinates) {
  for (const JointKind kind :
       {JointKind::revolute, JointKind::continuous, JointKind::prismatic,
        JointKind::planar, JointKind::universal}) {
    SCOPED_TRACE(to_string(kind));
    const Joint joint = make(kind);
    const JointCoordinates q = make_coordinates(kind, 0.0);
    const RelativeMotion motion = find_joint_motion(find_shape(joint), q);
    ASSERT_EQ(joint.coordinates().size(), q.position.size());
    if (kind == JointKind::universal) continue;  // read by swing and twist
    for (std::size_t i = 0; i < q.position.size(); ++i) {
      const CoordinateReading reading =
          joint.read(static_cast<int>(i), motion, {}, {});
      EXPECT_NEAR(reading.motion.z, q.position[i], kRoundOff);
      EXPECT_NEAR(reading.motion.rate, q.velocity[i], kRoundOff);
    }
  }
}

TEST(JointMotion, HasTheRatesOfItsPoses) {
  constexpr double h = 1e-5;
  // Central differences: truncation h^2, round-off 1e-16 / h.
  constexpr double kTolerance = 1e-9;
  for (const JointKind kind : kKinds) {
    // Rates of roll, pitch, yaw are no angular velocity.
    if (kind == JointKind::ball || kind == JointKind::floating) continue;
    SCOPED_TRACE(to_string(kind));
    const JointShape shape = find_shape(make(kind));
    const auto at = [&](double dt) {
      return find_joint_motion(shape, make_coordinates(kind, dt));
    };
    const RelativeMotion now = at(0.0);
    const Matrix3 turn = at(h).R_FM * at(-h).R_FM.transpose();
    EXPECT_LT((log_rotation(turn) / (2.0 * h) - now.w_FM_F).norm(), kTolerance);
    EXPECT_LT(((at(h).p_FM_F - at(-h).p_FM_F) / (2.0 * h) - now.v_FM_F).norm(),
              kTolerance);
  }
}

TEST(JointMotion, OfAFreeJointIsGivenInItsParentsAxes) {
  JointCoordinates q;
  q.position = {1.0, 2.0, 3.0, 0.0, 0.0, 0.5};
  q.velocity = {4.0, 5.0, 6.0, 7.0, 8.0, 9.0};
  const RelativeMotion motion =
      find_joint_motion({.kind = JointKind::floating}, q);
  EXPECT_EQ(motion.p_FM_F, Vector3(1, 2, 3));
  EXPECT_EQ(motion.v_FM_F, Vector3(4, 5, 6));
  EXPECT_EQ(motion.w_FM_F, Vector3(7, 8, 9));
  EXPECT_LT((motion.R_FM - exp_rotation(0.5 * Vector3::UnitZ())).norm(),
            kRoundOff);
}

TEST(JointMotion, KindsAreKnownByWhatTheyLeaveFree) {
  for (const JointKind kind : kKinds) {
    const JointShape shape = find_shape(make(kind));
    EXPECT_EQ(shape.kind,
              kind == JointKind::continuous ? JointKind::revolute : kind);
    if (!needs_axis(kind)) continue;
    EXPECT_LT((shape.axis_F - kAxis).norm(), kRoundOff);
  }
  EXPECT_LT((find_shape(make(JointKind::universal)).second_F - kSecond).norm(),
            kRoundOff);
  const AxisCoordinate slide{AxisCoordinate::Kind::distance, kAxis};
  EXPECT_THROW((void)find_shape(Joint(Bushing({}), {slide, slide}, {})),
               InputError);
}

TEST(JointMotion, RefusesAnotherNumberOfCoordinates) {
  for (const JointKind kind : kKinds) {
    JointCoordinates q = make_coordinates(kind, 0.0);
    q.position.push_back(0.0);
    EXPECT_THROW((void)find_joint_motion({.kind = kind}, q), ContractError);
    q.position.clear();
    EXPECT_NO_THROW((void)find_joint_motion({.kind = kind}, q));
  }
}

}  // namespace
}  // namespace limber::joints::joint_motion_test

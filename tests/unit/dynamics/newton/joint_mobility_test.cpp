// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/joint_mobility.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/paired_bodies.hpp"

/// Against the accelerations of rigid bodies under ideal constraints.
namespace limber::dynamics::joint_mobility_test {
namespace {

constexpr double kFrequency = 1e3;  // [rad/s]
constexpr double kStiff = 1e14;     // of joints [N/m, N m/rad]

RigidInertia make_inertia(int b) {
  const double m = 1.0 + 0.7 * b;
  return {m, m * Vector3(0.02 + 0.01 * b, 0.05, 0.04).asDiagonal()};
}

const Vector3 kNear(-0.3, 0.02, 0.0);  // of a link's joints, in its frame [m]
const Vector3 kFar(0.25, 0.0, 0.05);

// Of links whose joints fit.
Pose place_link(int b) {
  const Matrix3 R =
      exp_rotation(Vector3(0.3 * b + 0.2, 0.5 - 0.4 * b, 0.1 * b));
  if (b == 0) return {R, Vector3(0.1, 0.2, 0.3)};
  const Pose last = place_link(b - 1);
  return {R, last.p + last.R * kFar - R * kNear};
}

struct Arm {
  SystemModel model;
  SystemState state;
};

/// Links on ball joints, which let go of rotations alone; any of them may be
/// held by the world, and two of them are a pair.
Arm make_arm(int links, bool is_held, double stiffness, int a, int b) {
  SystemBuilder builder;
  std::vector<AttachmentIndex> near;
  std::vector<AttachmentIndex> far;
  for (int i = 0; i < links; ++i) {
    const auto link =
        builder.add_rigid_body("link" + std::to_string(i), make_inertia(i));
    near.push_back(
        builder.attach_frame("near", link, {Matrix3::Identity(), kNear}));
    far.push_back(
        builder.attach_frame("far", link, {Matrix3::Identity(), kFar}));
  }
  const auto law = joints::make_joint(joints::JointKind::ball, {}, {},
                                      {.translational_stiffness = stiffness});
  if (is_held) {
    const Pose X = place_link(0);
    builder.add_coupler(
        "root", law,
        builder.attach_world("w", {Matrix3::Identity(), X.p + X.R * kNear}),
        near[0]);
  }
  for (std::size_t i = 0; i + 1 < near.size(); ++i) {
    builder.add_coupler("joint" + std::to_string(i), law, far[i], near[i + 1]);
  }
  builder.add_pair("pair", a < 0 ? kWorld : BodyIndex(a), BodyIndex(b),
                   std::make_shared<testing::SphereContact>(1.0, 0.1, 0.1));
  Arm arm{builder.build(), {}};
  arm.state = make_state(arm.model);
  for (int i = 0; i < links; ++i) {
    BodyState& body = arm.state.bodies[static_cast<std::size_t>(i)];
    body.quat_WB = Quaternion(place_link(i).R);
    body.p_WB = place_link(i).p;
  }
  return arm;
}

// Rows of the velocity of a point at arm_B of link i in all bodies' own axes.
MatrixX find_rows(int links, int i, const Vector3& arm_B) {
  MatrixX rows = MatrixX::Zero(3, 6 * links);
  const Matrix3 R = place_link(i).R;
  rows.middleCols<3>(6 * i) = R;
  rows.middleCols<3>(6 * i + 3) = -R * skew(arm_B);
  return rows;
}

// M^-1 - M^-1 G' (G M^-1 G')^-1 G M^-1, G the rows of the ball joints.
MatrixX find_constrained(int links, bool is_held) {
  MatrixX inverse = MatrixX::Zero(6 * links, 6 * links);
  for (int i = 0; i < links; ++i) {
    const RigidInertia inertia = make_inertia(i);
    inverse.block<3, 3>(6 * i, 6 * i) = Matrix3::Identity() / inertia.mass;
    inverse.block<3, 3>(6 * i + 3, 6 * i + 3) = inertia.inertia.inverse();
  }
  MatrixX G = MatrixX::Zero(3 * (links - 1 + (is_held ? 1 : 0)), 6 * links);
  for (int i = 0; i + 1 < links; ++i) {
    G.middleRows<3>(3 * i) =
        find_rows(links, i, kFar) - find_rows(links, i + 1, kNear);
  }
  if (is_held) G.bottomRows<3>() = find_rows(links, 0, kNear);
  if (G.rows() == 0) return inverse;
  const MatrixX C = G * inverse * G.transpose();
  return inverse - inverse * G.transpose() * C.ldlt().solve(G * inverse);
}

joints::PairMobility pick(const MatrixX& all, int a, int b) {
  joints::PairMobility Y = joints::PairMobility::Zero();
  const int bodies[] = {a, b};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (bodies[i] < 0 || bodies[j] < 0) continue;
      Y.block<6, 6>(6 * i, 6 * j) =
          all.block<6, 6>(6 * bodies[i], 6 * bodies[j]);
    }
  }
  return Y;
}

joints::PairMobility find(Arm& arm) {
  JointMobility mobility(arm.model);
  EXPECT_TRUE(mobility.is_joined(0));
  return mobility.find(arm.model, arm.state, 0, kFrequency);
}

void expect_near(const joints::PairMobility& found,
                 const joints::PairMobility& right, double fraction) {
  EXPECT_LT((found - right).norm(), fraction * right.norm()) << found << "\n\n"
                                                             << right;
}

TEST(JointMobility, OfLinksOnStiffJointsIsThatOfIdealConstraints) {
  for (const bool is_held : {true, false}) {
    for (const int links : {2, 5}) {
      for (const auto& [a, b] :
           {std::pair{-1, links - 1}, {0, links - 1}, {links - 1, 0}}) {
        Arm arm = make_arm(links, is_held, kStiff, a, b);
        expect_near(find(arm), pick(find_constrained(links, is_held), a, b),
                    1e-6);
      }
    }
  }
}

TEST(JointMobility, OfLinksOnSoftJointsIsThatOfFreeBodies) {
  Arm arm = make_arm(3, true, 1e-3, 0, 2);
  MatrixX free = MatrixX::Zero(18, 18);
  for (int i = 0; i < 3; ++i) {
    const RigidInertia inertia = make_inertia(i);
    free.block<3, 3>(6 * i, 6 * i) = Matrix3::Identity() / inertia.mass;
    free.block<3, 3>(6 * i + 3, 6 * i + 3) = inertia.inertia.inverse();
  }
  expect_near(find(arm), pick(free, 0, 2), 1e-6);
}

// A spring as stiff as the inertia at the frequency of the impact halves what a
// body yields: w^2 / (w^2 + k / m).
TEST(JointMobility, ComparesJointsWithTheInertiaAtTheImpactsFrequency) {
  SystemBuilder builder;
  const double mass = 2.0;
  const auto body = builder.add_rigid_body("body", {mass, Matrix3::Identity()});
  builder.add_coupler(
      "weld",
      joints::make_joint(
          joints::JointKind::fixed, {}, {},
          {.translational_stiffness = mass * kFrequency * kFrequency,
           .rotational_stiffness = kStiff}),
      builder.attach_world("w", {Matrix3::Identity(), Vector3::UnitZ()}),
      builder.attach_frame("c", body, {}));
  builder.add_pair("pair", kWorld, body,
                   std::make_shared<testing::SphereContact>(1.0, 0.1, 0.1));
  Arm arm{builder.build(), {}};
  arm.state = make_state(arm.model);
  arm.state.bodies[0].p_WB = Vector3::UnitZ();
  const joints::PairMobility Y = find(arm);
  EXPECT_NEAR(Y(6, 6), 0.5 / mass, 1e-9);
  EXPECT_LT(Y(9, 9), 1e-6);
  EXPECT_EQ(Y.topRows<6>().norm(), 0.0);
}

TEST(JointMobility, IsNotAskedForWithoutJoints) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", make_inertia(0));
  const auto b = builder.add_rigid_body("b", make_inertia(1));
  builder.add_pair("pair", a, b,
                   std::make_shared<testing::SphereContact>(1.0, 0.1, 0.1));
  EXPECT_FALSE(JointMobility(builder.build()).is_joined(0));
}

}  // namespace
}  // namespace limber::dynamics::joint_mobility_test

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/body_plan.hpp"

#include <gmock/gmock.h>

#include "unit/scene/temporary_file.hpp"

namespace limber::scene::body_plan_test {
namespace {

constexpr double kRoundOff = 1e-13;

Joint make_joint(int parent, int child, joints::JointKind kind) {
  Joint joint;
  joint.name = "j" + std::to_string(child);
  joint.kind = kind;
  joint.parent = parent;
  joint.child = child;
  joint.X_PJ.p = Vector3::UnitX();
  return joint;
}

Link make_link(const std::string& name, double mass) {
  Link link;
  link.name = name;
  if (mass > 0.0) {
    link.inertia = LinkInertia{mass, Vector3::Zero(), Matrix3::Identity()};
  }
  return link;
}

TEST(BodyPlan, MergesFixedRigidLinksByTheParallelAxisTheorem) {
  Robot robot;
  robot.links = {make_link("a", 1), make_link("mount", 0), make_link("b", 3)};
  robot.joints = {make_joint(0, 1, joints::JointKind::fixed),
                  make_joint(1, 2, joints::JointKind::fixed)};
  const BodyPlans plans = plan_bodies(robot, std::vector<ReducedPieces>(3));
  ASSERT_EQ(plans.bodies.size(), 1U);
  EXPECT_EQ(plans.bodies[0].mass, 4.0);
  // Two masses 2 m apart: mu d^2 = (3/4) 4 about the axes across.
  const Matrix3 expected = Vector3(2.0, 5.0, 5.0).asDiagonal();
  EXPECT_LT((plans.bodies[0].inertia - expected).norm(), kRoundOff);
  EXPECT_LT((plans.X_BL[0].p - Vector3(-1.5, 0, 0)).norm(), kRoundOff);
  EXPECT_TRUE(plans.coupled_joints.empty());
}

// Also where that of the merged body is possible.
TEST(BodyPlan, RefusesTheInertiaOfAMergedLinkThatNoMassHas) {
  Robot robot;
  robot.links = {make_link("a", 1), make_link("point", 0.1),
                 make_link("b", 0.2)};
  robot.links[1].inertia->inertia.setZero();
  robot.links[2].inertia->inertia =
      Vector3(0.001, 0.001, 0.009).asDiagonal().toDenseMatrix();
  robot.joints = {make_joint(0, 1, joints::JointKind::fixed),
                  make_joint(1, 2, joints::JointKind::fixed)};
  const std::string text = test::input_error(
      [&] { (void)plan_bodies(robot, std::vector<ReducedPieces>(3)); });
  EXPECT_THAT(text, ::testing::HasSubstr("link 'b'"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("link 'a'")));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("link 'point'")));
}

TEST(BodyPlan, TakesTheLinkCalledWorldAsTheWorld) {
  Robot robot;
  robot.links = {make_link("world", 0), make_link("a", 0), make_link("b", 2)};
  robot.joints = {make_joint(0, 1, joints::JointKind::fixed),
                  make_joint(1, 2, joints::JointKind::revolute)};
  const BodyPlans plans = plan_bodies(robot, std::vector<ReducedPieces>(3));
  ASSERT_EQ(plans.bodies.size(), 2U);
  EXPECT_TRUE(plans.bodies[0].is_world);
  EXPECT_EQ(plans.body_of_link[1], 0);
  EXPECT_EQ(plans.coupled_joints, std::vector<int>{1});
}

TEST(BodyPlan, RefusesAMovingBodyWithoutMass) {
  Robot robot;
  robot.links = {make_link("a", 1), make_link("b", 0)};
  robot.joints = {make_joint(0, 1, joints::JointKind::revolute)};
  const std::string text = test::input_error(
      [&] { (void)plan_bodies(robot, std::vector<ReducedPieces>(2)); });
  EXPECT_THAT(text, ::testing::HasSubstr("link 'b' moves but has no mass"));
}

TEST(BodyPlan, NamesTheJointsOnBothSidesOfABodyWithoutMass) {
  Robot robot;
  robot.links = {make_link("a", 1), make_link("flange", 0),
                 make_link("tool0", 0), make_link("hand", 1)};
  robot.joints = {make_joint(0, 1, joints::JointKind::revolute),
                  make_joint(1, 2, joints::JointKind::fixed),
                  make_joint(2, 3, joints::JointKind::revolute)};
  const std::string text = test::input_error(
      [&] { (void)plan_bodies(robot, std::vector<ReducedPieces>(4)); });
  EXPECT_THAT(text, ::testing::AllOf(
                        ::testing::HasSubstr("link 'flange' moves but"),
                        ::testing::HasSubstr("between joints 'j1' and 'j3'"),
                        ::testing::HasSubstr("universal"),
                        ::testing::HasSubstr("<inertial>")));
}

// Frames such as `flange` and `tool0`, before and behind a joint that moves.
TEST(BodyPlan, MergesLinksWithoutMassThroughFixedJoints) {
  Robot robot;
  robot.links = {make_link("foot", 0), make_link("a", 1), make_link("tool", 0),
                 make_link("flange", 0), make_link("b", 3)};
  robot.joints = {make_joint(0, 1, joints::JointKind::fixed),
                  make_joint(1, 2, joints::JointKind::fixed),
                  make_joint(2, 3, joints::JointKind::revolute),
                  make_joint(3, 4, joints::JointKind::fixed)};
  const BodyPlans plans = plan_bodies(robot, std::vector<ReducedPieces>(5));
  ASSERT_EQ(plans.bodies.size(), 2U);
  EXPECT_EQ(plans.bodies[0].mass, 1.0);
  EXPECT_EQ(plans.bodies[1].mass, 3.0);
  // The joint's frame on both bodies, from their centres of mass.
  EXPECT_LT((plans.X_BL[2].p - Vector3::UnitX()).norm(), kRoundOff);
  EXPECT_LT((plans.X_BL[3].p + Vector3::UnitX()).norm(), kRoundOff);
  EXPECT_EQ(plans.coupled_joints, std::vector<int>{2});
}

std::shared_ptr<const flexbody::ReducedBody> make_piece(double mass, double x) {
  flexbody::ReducedBody body;
  body.mass = mass;
  body.p_MoBcm_M = {x, 0.0, 0.0};
  return std::make_shared<const flexbody::ReducedBody>(body);
}

Robot make_arm() {
  Robot robot;
  robot.links = {make_link("base", 1.0), make_link("arm", 0.0),
                 make_link("tool", 2.0)};
  robot.joints = {make_joint(0, 1, joints::JointKind::fixed),
                  make_joint(1, 2, joints::JointKind::fixed)};
  robot.links[1].flexible.emplace();
  robot.links[1].flexible->X_LM.p = {0.0, 0.0, 0.5};
  return robot;
}

TEST(BodyPlan, GivesEachPieceOfALinkABodyAtItsCentreOfMass) {
  const Robot robot = make_arm();
  const BodyPlans plans = plan_bodies(
      robot, {{}, {make_piece(3.0, 0.2), make_piece(4.0, 0.7)}, {}});
  ASSERT_EQ(plans.bodies.size(), 4U);
  const auto pieces = find_bodies(plans, 1);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].name, "arm.1");
  EXPECT_EQ(pieces[1].name, "arm.2");
  EXPECT_EQ(pieces[1].mass, 4.0);
  EXPECT_LT((find_X_BL(plans, 1, 0).inverse().p - Vector3(0.2, 0, 0.5)).norm(),
            kRoundOff);
  EXPECT_LT((find_X_BL(plans, 1, 1).inverse().p - Vector3(0.7, 0, 0.5)).norm(),
            kRoundOff);
  EXPECT_EQ(find_bodies(plans, 2).front().name, "tool");
}

TEST(BodyPlan, RefusesALinkCalledLikeAPiece) {
  Robot robot = make_arm();
  robot.links[2].name = "arm.2";
  const std::string text = test::input_error([&] {
    (void)plan_bodies(robot,
                      {{}, {make_piece(3.0, 0.2), make_piece(4.0, 0.7)}, {}});
  });
  EXPECT_THAT(text,
              ::testing::HasSubstr("'arm.2' has the same name as piece 2"));
}

}  // namespace
}  // namespace limber::scene::body_plan_test

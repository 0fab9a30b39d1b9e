// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/stiffening.hpp"

#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/reference/verification.hpp"
#include "unit/reference/scene_folder.hpp"

namespace limber::reference::stiffening_test {
namespace {

using joints::Bushing;
using joints::JointKind;
using joints::UniversalConstraint;
using test::RigidScene;

constexpr joints::JointParameters kParameters{.translational_stiffness = 3e5,
                                              .rotational_stiffness = 2e4,
                                              .translational_damping = 70.0,
                                              .rotational_damping = 5.0,
                                              .free_damping = 0.4};

joints::Joint make(JointKind kind, const joints::JointParameters& parameters) {
  return joints::make_joint(kind, {1.0, 2.0, 2.0}, {2.0, 1.0, -2.0},
                            parameters);
}

joints::Joint stiffen(const joints::Joint& joint, double factor) {
  dynamics::SystemModel model;
  model.couplers.push_back({"joint", joint, {}, {}});
  return std::get<joints::Joint>(stiffen_joints(model, factor).couplers[0].law);
}

TEST(StiffenJoints, ScalesWhatIsHeldAndKeepsDampingRatiosAndWhatIsFree) {
  joints::JointParameters scaled = kParameters;
  scaled.translational_stiffness *= 100.0;
  scaled.rotational_stiffness *= 100.0;
  scaled.translational_damping *= 10.0;
  scaled.rotational_damping *= 10.0;
  for (const JointKind kind :
       {JointKind::fixed, JointKind::revolute, JointKind::prismatic,
        JointKind::planar, JointKind::ball, JointKind::floating}) {
    const joints::Joint joint = stiffen(make(kind, kParameters), 100.0);
    const joints::Joint expected = make(kind, scaled);
    const auto& p = std::get<Bushing>(joint.constraint()).parameters();
    const auto& e = std::get<Bushing>(expected.constraint()).parameters();
    const auto near = [&](const Matrix3& a, const Matrix3& b) {
      EXPECT_LE((a - b).norm(), 1e-14 * b.norm()) << to_string(kind);
    };
    near(p.translational_stiffness, e.translational_stiffness);
    near(p.rotational_stiffness, e.rotational_stiffness);
    near(p.translational_damping, e.translational_damping);
    near(p.rotational_damping, e.rotational_damping);
  }
}

TEST(StiffenJoints, ScalesTheHoldOfAUniversalJointNotItsElements) {
  const joints::Joint joint =
      stiffen(make(JointKind::universal, kParameters), 100.0);
  const auto& p =
      std::get<UniversalConstraint>(joint.constraint()).parameters();
  EXPECT_DOUBLE_EQ(p.translational_stiffness, 3e7);
  EXPECT_DOUBLE_EQ(p.rotational_stiffness, 2e6);
  EXPECT_DOUBLE_EQ(p.translational_damping, 700.0);
  EXPECT_DOUBLE_EQ(p.rotational_damping, 50.0);
  ASSERT_EQ(joint.elements().size(), 2U);
  EXPECT_EQ(
      std::get<joints::Friction>(joint.elements()[1].law).parameters().viscous,
      0.4);
}

TEST(StiffnessTrend, FindsTheRowOfFirstOrderAndTheFloorAfterIt) {
  const StiffnessTrend trend = find_trend({1.0, 10.0, 100.0, 1e3, 1e4, 1e5},
                                          {5.0, 4.0, 0.4, 0.04, 0.02, 0.002});
  ASSERT_EQ(trend.orders.size(), 5U);
  EXPECT_NEAR(trend.orders[0], 0.0969, 1e-4);
  EXPECT_NEAR(trend.orders[1], 1.0, 1e-12);
  ASSERT_TRUE(trend.first_order);
  EXPECT_EQ(trend.first_order->first, 1U);
  EXPECT_EQ(trend.first_order->last, 3U);
  EXPECT_EQ(trend.floor, 3U);  // though the last falls again
}

TEST(StiffnessTrend, HasNoFloorWhileDifferencesFall) {
  const StiffnessTrend trend = find_trend({1.0, 2.0, 8.0}, {4.0, 2.0, 0.5});
  EXPECT_FALSE(trend.floor);
  ASSERT_TRUE(trend.first_order);
  EXPECT_EQ(trend.first_order->last, 2U);
  EXPECT_FALSE(find_trend({1.0, 10.0}, {4.0, 0.04}).first_order);
}

TEST(VerifyStiffened, RefusesFactorsThatDoNotIncreaseAndOtherJoints) {
  const RigidScene scene(
      "<robot name=\"r\">" + test::make_link("a", 1.0) + "</robot>",
      "[time]\nduration = 0.01\nstep = 0.01\n");
  const auto run = [&](const std::vector<double>& factors, JointModel joints) {
    (void)verify_stiffened(scene.scene, scene.built, factors,
                           {{joints, 1e-6}, 0});
  };
  for (const std::vector<double>& factors :
       {std::vector<double>{}, {1.0}, {1.0, 1.0}, {10.0, 1.0}, {0.0, 1.0}}) {
    EXPECT_THROW(run(factors, JointModel::ideal), InputError);
  }
  EXPECT_THROW(run({1.0, 2.0}, JointModel::bushings), InputError);
}

}  // namespace
}  // namespace limber::reference::stiffening_test

// SPDX-License-Identifier: BSD-3-Clause
// SystemBuilder::add_joint.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::builder_joint_test {
namespace {

using joints::JointKind;
using ::testing::HasSubstr;

constexpr double kOdd = std::numeric_limits<double>::quiet_NaN();

/// A rigid body, a flexible one with interfaces "root" (whole) and "line"
/// (nodes on x), and one of the same that is rigid.
class BuilderJoint : public ::testing::Test {
 protected:
  BuilderJoint() {
    points_.reduced.interfaces = {testing::make_interface(points_, 0, 5),
                                  testing::make_interface(points_, 6, 11)};
    flexbody::InterfaceTable& root = points_.reduced.interfaces[0];
    flexbody::InterfaceTable& line = points_.reduced.interfaces[1];
    root.name = "root";
    root.rotation_axes = Matrix3::Identity();
    root.flexibility = 1e-6 * Matrix6::Identity();
    line.name = "line";
    line.rotation_axes = Matrix3::Identity().rightCols<2>();
    line.node_count = 3;
    line.flexibility = 1e-6 * Matrix6::Identity();
    beam_ = builder_.add_flexible_body("beam", testing::share(points_),
                                       Fidelity::coupled, {});
    stiff_ = builder_.add_flexible_body("stiff", testing::share(points_),
                                        Fidelity::rigid, {});
  }

  std::string refusal(const JointSide& parent, const JointSide& child,
                      JointKind kind = JointKind::revolute,
                      const Vector3& axis = Vector3::UnitZ(),
                      const JointOptions& options = {}) {
    try {
      builder_.add_joint("j", kind, parent, child, axis, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  const joints::Joint& law(const SystemModel& model, const char* name) {
    const auto c = static_cast<std::size_t>(model.find_coupler(name));
    return std::get<joints::Joint>(model.couplers[c].law);
  }

  testing::PointMassBody points_ =
      testing::make_point_mass_body(12, 4, 2.0, 0.5, 100.0, 3);
  SystemBuilder builder_;
  BodyIndex block_ =
      builder_.add_rigid_body("block", {3.0, Matrix3::Identity()});
  BodyIndex beam_;
  BodyIndex stiff_;
};

TEST_F(BuilderJoint, IsACouplerBetweenTwoFramesOfItsName) {
  const Pose at{Matrix3::Identity(), {0.1, 0.2, 0.3}};
  const CouplerIndex c = builder_.add_joint("elbow", JointKind::revolute,
                                            {block_, at}, {beam_, {}, "root"});
  const SystemModel model = builder_.build();
  EXPECT_EQ(c, model.find_coupler("elbow"));
  const Coupler& coupler = model.couplers[0];
  EXPECT_EQ(coupler.frame_F, model.find_attachment("elbow.F"));
  EXPECT_EQ(coupler.frame_M, model.find_attachment("elbow.M"));
  EXPECT_EQ(model.attachments[0].body, block_);
  EXPECT_EQ(model.attachments[0].p_BF, at.p);
  const flexbody::InterfaceTable& root = points_.reduced.interfaces[0];
  EXPECT_EQ(model.attachments[1].body, beam_);
  EXPECT_EQ(model.attachments[1].p_BF, root.p_B);
  EXPECT_EQ(model.attachments[1].Phi_B, root.Phi_B);
  ASSERT_EQ(law(model, "elbow").coordinates().size(), 1U);
  EXPECT_EQ(law(model, "elbow").coordinates()[0].axis, Vector3::UnitZ());
}

TEST_F(BuilderJoint, IsTheSameByATableAndAtEveryLevel) {
  builder_.add_joint("name", JointKind::fixed, {}, {beam_, {}, "root"});
  builder_.add_joint("table", JointKind::fixed, {},
                     {beam_, {}, points_.reduced.interfaces[0]});
  builder_.add_joint("rigid", JointKind::fixed, {}, {stiff_, {}, "root"});
  const SystemModel model = builder_.build();
  for (const char* name : {"table", "rigid"}) {
    const auto held = law(model, name).find_constraint_stiffness();
    const auto expected = law(model, "name").find_constraint_stiffness();
    EXPECT_EQ(held->translational, expected->translational);
    EXPECT_EQ(held->rotational, expected->rotational);
  }
  // Two hundred times as stiff as the interface.
  EXPECT_DOUBLE_EQ(
      law(model, "name").find_constraint_stiffness()->translational, 2e8);
}

TEST_F(BuilderJoint, TakesAnAxisOfAnyLengthAndWhatActsAlongIt) {
  builder_.add_joint(
      "j", JointKind::prismatic, {}, {block_}, {0, 30, 40},
      {.held = {.translational_stiffness = 7e4, .free_damping = 3.0},
       .elements = {{0, joints::Friction({.viscous = 2.0})}}});
  const SystemModel model = builder_.build();
  EXPECT_LT(
      (law(model, "j").coordinates()[0].axis - Vector3(0, 0.6, 0.8)).norm(),
      1e-15);
  EXPECT_DOUBLE_EQ(law(model, "j").find_constraint_stiffness()->translational,
                   7e4);
  EXPECT_EQ(law(model, "j").elements().size(), 1U);
}

TEST_F(BuilderJoint, RefusesSidesThatCannotCarryIt) {
  const JointSide root{beam_, {}, "root"};
  EXPECT_THAT(refusal({}, {beam_}), HasSubstr("body 'beam' is flexible; give"));
  EXPECT_THAT(refusal({}, {stiff_}), HasSubstr("body 'stiff' is flexible"));
  EXPECT_THAT(refusal({}, {block_, {}, "root"}),
              HasSubstr("body 'block' is rigid and has no interface"));
  EXPECT_THAT(refusal({kWorld, {}, "root"}, root),
              HasSubstr("the world has no interface"));
  EXPECT_THAT(refusal({}, {beam_, {}, "rot"}), HasSubstr("'root'"));
  EXPECT_THAT(refusal({}, {beam_, {}, ""}),
              HasSubstr("joint 'j', body 'beam'"));
  EXPECT_THAT(refusal({}, {beam_, {}, "\x1b[31m"}), HasSubstr("\\x1b"));
  EXPECT_THAT(refusal({}, {}), HasSubstr("same body"));
  EXPECT_THAT(refusal({block_}, {block_}), HasSubstr("same body"));
  EXPECT_THAT(refusal({}, {beam_, {}, "line"}, JointKind::fixed),
              HasSubstr("on one line along (1, 0, 0)"));
  // About the line nothing is asked.
  EXPECT_EQ(
      refusal({}, {beam_, {}, "line"}, JointKind::revolute, Vector3::UnitX()),
      "");
}

TEST_F(BuilderJoint, RefusesPosesAxesAndValuesThatAreNone) {
  Pose nowhere;
  nowhere.p[1] = kOdd;
  Pose stretched;
  stretched.R *= 1.01;
  EXPECT_THAT(refusal({}, {block_, nowhere}), HasSubstr("not finite"));
  EXPECT_THAT(refusal({kWorld, stretched}, {block_}), HasSubstr("a rotation"));
  for (const Vector3& axis : {Vector3(0, 0, 0), Vector3(0, kOdd, 1)}) {
    EXPECT_THAT(refusal({}, {block_}, JointKind::revolute, axis),
                HasSubstr("joint 'j'"));
  }
  EXPECT_THAT(refusal({}, {block_}, JointKind::universal, Vector3::UnitZ(),
                      {.second_F = Vector3::UnitZ()}),
              HasSubstr("joint 'j'"));
  EXPECT_THAT(refusal({}, {block_}, JointKind::fixed, Vector3::UnitZ(),
                      {.held = {.rotational_stiffness = -1.0}}),
              HasSubstr("expected >= 0"));
}

TEST_F(BuilderJoint, LeavesNothingBehindWhenItIsRefused) {
  EXPECT_NE(refusal({}, {beam_}), "");
  EXPECT_THROW(builder_.add_joint("j", JointKind::revolute, {}, {BodyIndex(9)}),
               ContractError);
  EXPECT_THROW(
      builder_.add_joint("j", static_cast<JointKind>(99), {}, {block_}),
      ContractError);
  EXPECT_THROW(builder_.add_joint(
                   "j", JointKind::revolute, {}, {block_}, Vector3::UnitZ(),
                   {.elements = {{1, joints::Friction({.viscous = 2.0})}}}),
               ContractError);
  // A table of another body's size is found when it is attached.
  flexbody::InterfaceTable odd = points_.reduced.interfaces[0];
  odd.Phi_B.conservativeResize(3, 3);
  EXPECT_THROW(
      builder_.add_joint("j", JointKind::revolute, {}, {beam_, {}, odd}),
      ContractError);
  EXPECT_TRUE(builder_.build().attachments.empty());
  EXPECT_EQ(refusal({}, {block_}), "");
  EXPECT_THAT(refusal({}, {block_}),
              HasSubstr("another coupler has this name"));
  EXPECT_THROW(builder_.add_joint("", JointKind::fixed, {}, {block_}),
               InputError);
  EXPECT_THROW(builder_.add_joint("a\nb", JointKind::fixed, {}, {block_}),
               InputError);
  EXPECT_THROW(
      builder_.add_joint(std::string(300, 'x'), JointKind::fixed, {}, {block_}),
      InputError);
}

}  // namespace
}  // namespace limber::dynamics::builder_joint_test

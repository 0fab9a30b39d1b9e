// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/rotation_check.hpp"

#include <gmock/gmock.h>

#include "limber/common/rotation.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/joints/latch.hpp"
#include "limber/joints/scalar/friction.hpp"
#include "support/point_mass_body.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::rotation_check_test {
namespace {

using joints::JointKind;
using test::input_error;
using test::rigid_link;
using test::SceneFolder;
using test::time_table;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const Vector3 kX = Vector3::UnitX();
const Vector3 kZ = Vector3::UnitZ();

/// Three nodes on a line along z.
flexbody::InterfaceTable make_line() {
  flexbody::InterfaceTable table;
  table.name = "edge";
  table.rotation_axes = Matrix3::Identity().leftCols<2>();
  table.node_count = 3;
  return table;
}

flexbody::InterfaceTable make_point() {
  flexbody::InterfaceTable table;
  table.name = "corner";
  table.node_count = 1;
  return table;
}

Matrix3 required_by(JointKind kind, const Vector3& axis,
                    double free_damping = 0.0) {
  return find_required_rotations(
             joints::make_joint_bushing(kind, axis,
                                        {.translational_stiffness = 1e9,
                                         .rotational_stiffness = 1e7,
                                         .translational_damping = 1e3,
                                         .rotational_damping = 1e2,
                                         .free_damping = free_damping}))
      .F;
}

std::string error_of(const flexbody::InterfaceTable& table,
                     const Matrix3& required) {
  return input_error([&] { check_rotation(table, required); });
}

TEST(RotationCheck, HingeAlongALineOfNodesIsHeld) {
  EXPECT_EQ(error_of(make_line(), required_by(JointKind::revolute, kZ)), "");
  EXPECT_EQ(error_of(make_line(), required_by(JointKind::planar, -kZ)), "");
  // pi / 2 rounded as URDF files do.
  const Vector3 rounded = exp_rotation(1.5708 * kX) * -Vector3::UnitY();
  ASSERT_GT((rounded + kZ).norm(), 1e-6);
  EXPECT_EQ(error_of(make_line(), required_by(JointKind::revolute, rounded)),
            "");
}

TEST(RotationCheck, GivesTheNodesTheDirectionAndTheRemedy) {
  for (const Matrix3& required :
       {required_by(JointKind::revolute, kX), required_by(JointKind::fixed, kX),
        required_by(JointKind::prismatic, kZ), Matrix3(kZ * kZ.transpose())}) {
    EXPECT_EQ(error_of(make_line(), required),
              "interface 'edge': its 3 nodes are on one line along (0, 0, 1), "
              "so it has no rotation about (0, 0, 1) (mesh axes), which is "
              "required. Choose nodes that span a surface, or require no "
              "rotation about that direction");
  }
}

TEST(RotationCheck, SoftAndDampedDirectionsAreRequiredToo) {
  EXPECT_NE(error_of(make_line(), required_by(JointKind::revolute, kZ, 1e-6)),
            "");
  joints::Bushing::Parameters soft;
  soft.rotational_stiffness = Vector3(1e9, 1e9, 1e-2).asDiagonal();
  EXPECT_NE(
      error_of(make_line(), find_required_rotations(joints::Bushing(soft)).F),
      "");
}

TEST(RotationCheck, CouplersWithoutRotationGoAnywhere) {
  joints::Bushing::Parameters bushing;
  bushing.translational_stiffness = 1e6 * Matrix3::Identity();
  bushing.translational_damping = 1e3 * Matrix3::Identity();
  const joints::PointSpring spring({.stiffness = 5.0});
  for (const auto& table : {make_line(), make_point()}) {
    EXPECT_EQ(
        error_of(table, find_required_rotations(joints::Bushing(bushing)).M),
        "");
    EXPECT_EQ(error_of(table, find_required_rotations(spring).F), "");
  }
}

const joints::JointParameters kHeld = {.translational_stiffness = 1e9,
                                       .rotational_stiffness = 1e7,
                                       .translational_damping = 1e3,
                                       .rotational_damping = 1e2};

RequiredSides required_by_joint(
    JointKind kind, std::vector<joints::JointElement> elements = {}) {
  return find_required_rotations(
      joints::make_joint(kind, kZ, kX, kHeld, std::move(elements)));
}

joints::JointElement make_friction(int coordinate) {
  return {coordinate,
          joints::Friction({.coulomb = 1.0, .viscous = 0.0, .speed = 1e-3})};
}

TEST(RotationCheck, LawAlongAnAngleRequiresIt) {
  EXPECT_EQ(error_of(make_line(), required_by_joint(JointKind::revolute).M),
            "");
  EXPECT_NE(
      error_of(make_line(),
               required_by_joint(JointKind::revolute, {make_friction(0)}).M),
      "");
  // Along a distance of a planar joint, then about its angle.
  EXPECT_EQ(
      error_of(make_line(),
               required_by_joint(JointKind::planar, {make_friction(1)}).F),
      "");
  EXPECT_NE(
      error_of(make_line(),
               required_by_joint(JointKind::planar, {make_friction(2)}).F),
      "");
}

TEST(RotationCheck, UniversalJointHoldsNoRotationAboutEachSidesOwnAxis) {
  // The first axis, z, belongs to F and the second, x, to M.
  const RequiredSides required = required_by_joint(JointKind::universal);
  EXPECT_EQ(error_of(make_line(), required.F), "");
  EXPECT_NE(error_of(make_line(), required.M), "");
  flexbody::InterfaceTable along_x = make_line();
  along_x.rotation_axes = Matrix3::Identity().rightCols<2>();
  EXPECT_NE(error_of(along_x, required.F), "");
  EXPECT_EQ(error_of(along_x, required.M), "");
}

TEST(RotationCheck, BallJointGoesAnywhereUntilALawActsInIt) {
  EXPECT_EQ(error_of(make_point(), required_by_joint(JointKind::ball).F), "");
  EXPECT_NE(error_of(make_line(),
                     required_by_joint(JointKind::ball, {make_friction(0)}).F),
            "");
}

TEST(RotationCheck, LatchRequiresAllRotationsUnlessItHoldsNone) {
  joints::Latch::Parameters latch;
  latch.reach = 0.01;
  latch.bushing.translational_stiffness = 1e6 * Matrix3::Identity();
  EXPECT_EQ(
      error_of(make_point(), find_required_rotations(joints::Latch(latch)).F),
      "");
  latch.bushing.rotational_stiffness = 1e6 * Matrix3::Identity();
  EXPECT_NE(
      error_of(make_line(), find_required_rotations(joints::Latch(latch)).M),
      "");
}

TEST(RotationCheck, PointHasNoRotationAtAll) {
  EXPECT_THAT(error_of(make_point(), kX * kX.transpose()),
              HasSubstr("'corner': it is one node, so it has no rotation about "
                        "(1, 0, 0)"));
  EXPECT_THAT(error_of(make_point(), required_by(JointKind::revolute, kX)),
              HasSubstr("about directions normal to (1, 0, 0)"));
  EXPECT_THAT(error_of(make_point(), required_by(JointKind::fixed, kX)),
              HasSubstr("about any direction"));
}

TEST(RotationCheck, SurfaceHasThemAll) {
  flexbody::InterfaceTable table = make_line();
  table.rotation_axes = Matrix3::Identity();
  EXPECT_EQ(error_of(table, Matrix3::Identity()), "");
}

/// A saved body with an interface on a line along z and one on a point,
/// hanging on the world.
class BodyWithALine : public ::testing::Test {
 protected:
  BodyWithALine() {
    auto body = testing::make_point_mass_body(12, 3, 5.0, 1.0, 300.0, 3);
    flexbody::ReducedBody& reduced = body.reduced;
    reduced.interfaces = {testing::make_interface(body, 0, 5),
                          testing::make_interface(body, 5, 12)};
    reduced.interfaces[0].name = "edge";
    reduced.interfaces[0].rotation_axes = make_line().rotation_axes;
    reduced.interfaces[0].Psi_B.row(2).setZero();
    reduced.interfaces[0].node_count = 3;
    reduced.interfaces[1].name = "corner";
    reduced.interfaces[1].rotation_axes.resize(3, 0);
    reduced.interfaces[1].Psi_B.setZero();
    reduced.interfaces[1].node_count = 1;
    flexbody::write_body(reduced, folder_.path() / "body.h5");
  }

  /// @param more of the robot, @param turn of the mesh in the link
  std::string error_in(const std::string& more, const std::string& scenario,
                       const std::string& turn = "0 0 0") const {
    return input_error([&] {
      (void)folder_.build(rigid_link("base", 1.0, 1.0) +
                              "<link name='body'/>\n"
                              "<flexible link='body'><reduced file='body.h5'/>"
                              "<origin rpy='" +
                              turn +
                              "'/><attach joint='j' interface='edge'/>"
                              "</flexible>\n" +
                              more,
                          time_table(0.1, 1e-3) + scenario);
    });
  }
  std::string joint_error(const std::string& type, const std::string& axis,
                          const std::string& turn = "0 0 0",
                          const std::string& more = "") const {
    return error_in("<joint name='j' type='" + type +
                        "'><parent link='base'/><child link='body'/>"
                        "<axis xyz='" +
                        axis + "'/></joint>\n" + more,
                    "", turn);
  }
  std::string place_error(const std::string& text) const {
    return error_in(
        "<joint name='j' type='floating'><parent link='base'/>"
        "<child link='body'/></joint>\n",
        text);
  }

  SceneFolder folder_;
};

TEST_F(BodyWithALine, TakesAHingeAlongItAlone) {
  EXPECT_EQ(joint_error("continuous", "0 0 1"), "");
  EXPECT_THAT(joint_error("continuous", "1 0 0"),
              AllOf(StartsWith("joint 'j': link 'body': interface 'edge': "),
                    HasSubstr("its 3 nodes are on one line"),
                    HasSubstr("no rotation about (0, 0, 1)")));
  EXPECT_NE(joint_error("fixed", "0 0 1"), "");
  EXPECT_NE(joint_error("continuous", "0 0 1", "0 0 0",
                        "<coupler joint='j' free_damping='1'/>"),
            "");
}

TEST_F(BodyWithALine, TakesNoGearAboutItsLine) {
  const std::string wheel =
      rigid_link("wheel", 1.0, 1.0) +
      "<joint name='k' type='continuous'><parent link='base'/>"
      "<child link='wheel'/><axis xyz='0 0 1'/></joint>\n";
  EXPECT_EQ(joint_error("continuous", "0 0 1", "0 0 0", wheel), "");
  EXPECT_THAT(
      joint_error("continuous", "0 0 1", "0 0 0",
                  wheel + "<gear name='g' joint='j' with='k' ratio='2'/>"),
      StartsWith("gear 'g': link 'body': interface 'edge': its 3 nodes"));
}

TEST_F(BodyWithALine, CountsInTheAxesOfItsMesh) {
  // The mesh's z is the link's x.
  const std::string turn = "0 1.5708 0";
  EXPECT_EQ(joint_error("continuous", "1 0 0", turn), "");
  EXPECT_THAT(joint_error("continuous", "0 0 1", turn),
              HasSubstr("(0, 0, 1) (mesh axes)"));
}

TEST_F(BodyWithALine, TakesMomentsAboutItsDefinedDirectionsAlone) {
  const auto load = [](const std::string& more) {
    return "[[load]]\nname = 'm'\nlink = 'body'\n" + more + "\n";
  };
  EXPECT_EQ(place_error(load("interface = 'edge'\nmoment = [1.0, 2.0, 0.0]")),
            "");
  EXPECT_EQ(place_error(load("interface = 'corner'\nforce = [1.0, 2.0, 3.0]")),
            "");
  EXPECT_THAT(
      place_error(load("interface = 'edge'\nmoment = [1.0, 0.0, 0.1]")),
      AllOf(StartsWith("load 'm': link 'body': interface 'edge': its 3 nodes"),
            HasSubstr("(0, 0, 1)")));
  EXPECT_THAT(place_error(load("interface = 'edge'\nmoment = [1.0, 0.0, 0.0]\n"
                               "frame = 'world'")),
              HasSubstr("its moment is fixed in the world, so it acts about "
                        "every direction"));
  EXPECT_THAT(
      place_error(load("interface = 'corner'\nmoment = [0.0, 1.0, 0.0]")),
      HasSubstr("'corner': it is one node, so it has no rotation about (0, 1, "
                "0)"));
}

TEST_F(BodyWithALine, IsRefusedToProbesOfRotation) {
  const auto probe = [](const std::string& where, const std::string& quantity) {
    return "[[probe]]\nname = 'p'\nlink = 'body'\n" + where + "\nquantity = '" +
           quantity + "'\n";
  };
  for (const char* quantity : {"displacement", "velocity", "deformation"}) {
    EXPECT_EQ(place_error(probe("interface = 'edge'", quantity)), "");
  }
  for (const char* quantity : {"rotation", "angular_velocity"}) {
    EXPECT_THAT(place_error(probe("interface = 'edge'", quantity)),
                AllOf(StartsWith("probe 'p' on link 'body': interface 'edge': "
                                 "its 3 nodes are on one line"),
                      HasSubstr("(0, 0, 1)")));
    EXPECT_THAT(place_error(probe("node = 5", quantity)),
                HasSubstr("one node of a solid has no rotation"));
  }
}

TEST_F(BodyWithALine, TakesSpringsAndSoftBushingsWithoutRotation) {
  const auto error = [&](const std::string& connector) {
    return error_in(
        "<joint name='j' type='floating'><parent link='base'/>"
        "<child link='body'/></joint>\n" +
            connector,
        "");
  };
  EXPECT_EQ(error("<spring name='s' from='base' to='body/corner' "
                  "stiffness='10'/>"),
            "");
  EXPECT_EQ(error("<bushing name='b' from='base' to='body/corner' "
                  "translational_stiffness='10'/>"),
            "");
  EXPECT_EQ(error("<bushing name='b' from='base' to='body/edge' "
                  "translational_stiffness='10' "
                  "rotational_stiffness='5 5 0'/>"),
            "");
  EXPECT_THAT(
      error("<bushing name='b' from='base' to='body/edge' "
            "translational_stiffness='10' rotational_damping='0 0 1'/>"),
      StartsWith("connector 'b': link 'body': interface 'edge': its 3 "
                 "nodes are on one line"));
}

}  // namespace
}  // namespace limber::scene::rotation_check_test

// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "limber/scene/robot/held_mimics.hpp"
#include "limber/scene/robot/link_inertias.hpp"
#include "limber/scene/robot/massless_links.hpp"
#include "limber/scene/robot/package_paths.hpp"
#include "support/temporary_folder.hpp"
#include "unit/scene/robot/robot_text.hpp"

/// What robots of vendors have beyond URDF, or against it.
namespace limber::scene::vendor_habits_test {
namespace {

using test::error_of;
using test::read;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kMass =
    "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
    "ixz='0' iyz='0'/></inertial>";

std::string link(const std::string& name, const std::string& content = kMass) {
  return "<link name='" + name + "'>" + content + "</link>";
}

std::string joint(const std::string& name, const std::string& parent,
                  const std::string& child, const std::string& type,
                  const std::string& more = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" +
         parent + "'/><child link='" + child + "'/><axis xyz='0 0 1'/>" + more +
         "</joint>";
}

std::string with_limit(const std::string& attributes) {
  return link("a") + link("b") +
         joint("j", "a", "b", "revolute", "<limit " + attributes + "/>");
}

TEST(VendorHabits, NamesThatResembleOursAreWarnings) {
  const std::string all = "lower='-1' upper='1' effort='2' velocity='3' ";
  for (const char* more : {"gear_velocity='4'", "velocitys='4'", "current='1'",
                           "k_velocity='1'", "uper='2'"}) {
    const Robot robot = read(with_limit(all + more));
    EXPECT_THAT(robot.warnings, ElementsAre(HasSubstr("is not read"))) << more;
    EXPECT_EQ(robot.joints[0].max_speed, 3.0);
  }
  const std::string elements =
      "<collision_checking><capsule radius='1'/></collision_checking>"
      "<self_collision_checking/><verbose value='Full'/>";
  EXPECT_THAT(read(link("a", kMass + elements)).warnings.size(), 3U);
  std::string inertia = kMass;
  inertia.insert(inertia.find(" iyz"), " iyx='0' izx='0' izy='0'");
  EXPECT_THAT(read(link("a", inertia)).warnings.size(), 3U);
}

TEST(VendorHabits, AMisspeltNameIsAnErrorWhereTheRightOneIsMissing) {
  EXPECT_THAT(error_of(with_limit("lower='-1' uper='1' effort='1' "
                                  "velocity='1'")),
              HasSubstr("did you mean 'upper'"));
  std::string inertia = kMass;
  inertia.replace(inertia.find("ixy"), 3, "iyx");
  EXPECT_THAT(error_of(link("a", inertia)),
              HasSubstr("unknown attribute 'iyx'"));
}

TEST(VendorHabits, CallsOfMacrosAreLeftOutAndMacrosRefused) {
  EXPECT_THAT(read(link("a") + "<xacro:pr2_gazebo name='x'/>").warnings,
              ElementsAre(HasSubstr("call of a macro 'xacro:pr2_gazebo'")));
  EXPECT_THAT(error_of(link("a") + "<xacro:property name='x' value='1'/>"),
              HasSubstr("expand the file first"));
}

TEST(VendorHabits, WhatNobodyReadsIsNoError) {
  const Robot robot =
      read(link("a", kMass + "<visual><material name='none'/><geometry><cone/>"
                             "</geometry></visual>") +
           link("b") + "<material name='m'/><material name='m'/>" +
           joint("j", "a", "b", "revolute",
                 "<limit effort='1' velocity='1'/><safety_controller/>"
                 "<calibration rising='x'/>"));
  EXPECT_EQ(robot.joints[0].kind, joints::JointKind::revolute);
}

TEST(VendorHabits, NothingOfAFixedJointMatters) {
  const Robot robot = read(link("a") + link("b") +
                           joint("j", "a", "b", "fixed",
                                 "<limit lower='2' upper='1'/><dynamics "
                                 "friction='1'/><mimic joint='none'/>"));
  EXPECT_EQ(robot.joints[0].kind, joints::JointKind::fixed);
  EXPECT_THAT(robot.gears, IsEmpty());
}

TEST(VendorHabits, ALimitWithoutEffortDoesNotLimitDrives) {
  const Robot robot = read(with_limit("lower='-1' upper='1'"));
  EXPECT_EQ(robot.joints[0].max_effort, joints::Drive::kUnlimited);
  EXPECT_THAT(robot.warnings,
              ElementsAre(HasSubstr("robot.urdf:2: 1 <limit> without")));
}

TEST(VendorHabits, AJointWithoutALimitHasNone) {
  for (const char* type : {"revolute", "prismatic"}) {
    const Robot robot =
        read(link("a") + link("b") + joint("j", "a", "b", type));
    EXPECT_EQ(robot.joints[0].max_effort, joints::Drive::kUnlimited) << type;
    EXPECT_EQ(robot.joints[0].max_speed, joints::Drive::kUnlimited) << type;
    EXPECT_THAT(robot.warnings, IsEmpty()) << type;
  }
}

TEST(VendorHabits, AParentCalledWorldNeedsNoLink) {
  const Robot robot = read(link("a") + joint("j", "world", "a", "fixed"));
  EXPECT_TRUE(robot.has_world_root());
  EXPECT_EQ(robot.links.size(), 2U);
}

// q = 2 (3 q_j + 0.5) - 0.25 with q_j = 0, so 0.75 about z, then along z.
TEST(VendorHabits, WhatMimicsAFixedJointStandsWhereItAsks) {
  const std::string limit = "<limit effort='1' velocity='1'/>";
  const Robot robot =
      read(link("a") + link("b") + link("c") + link("d") +
           joint("j", "a", "b", "fixed") +
           joint("m", "a", "d", "prismatic",
                 limit + "<mimic joint='k' multiplier='2' offset='-0.25'/>") +
           joint("k", "a", "c", "revolute",
                 limit + "<origin xyz='1 0 0'/><mimic joint='j' multiplier='3' "
                         "offset='0.5'/>"));
  EXPECT_THAT(robot.gears, IsEmpty());
  for (const Joint& one : robot.joints) {
    EXPECT_EQ(one.kind, joints::JointKind::fixed) << one.name;
    if (one.name == "m") {
      EXPECT_TRUE(one.X_PJ.p.isApprox(Vector3(0, 0, 0.75), 1e-15));
    }
    if (one.name != "k") continue;
    EXPECT_TRUE((one.X_PJ * Vector3::UnitX())
                    .isApprox(Vector3(1 + std::cos(0.5), std::sin(0.5), 0)));
  }
  EXPECT_THAT(robot.warnings,
              ElementsAre(HasSubstr("joint 'k' is fixed at 0.5"),
                          HasSubstr("joint 'm' is fixed at 0.75")));
}

TEST(VendorHabits, AMimicTimesZeroStandsAtItsOffset) {
  const std::string limit = "<limit effort='1' velocity='1'/>";
  const Robot robot =
      read(link("a") + link("b") + link("c") +
           joint("j", "a", "b", "revolute", limit) +
           joint("k", "a", "c", "prismatic",
                 limit + "<mimic joint='j' multiplier='0' offset='0.5'/>"));
  EXPECT_EQ(robot.joints[1].kind, joints::JointKind::fixed);
  EXPECT_EQ(robot.joints[1].X_PJ.p, Vector3(0, 0, 0.5));
  EXPECT_EQ(robot.joints[0].kind, joints::JointKind::revolute);
}

TEST(NearestInertia, IsTheFootOfTheNormalOnTheFacesOfAllMasses) {
  // One face: (1, 1, 3) misses I1 + I2 >= I3 by 1, a third of it for each.
  const Matrix3 flat = Vector3(1, 1, 3).asDiagonal();
  const Matrix3 expected = Vector3(4, 4, 8).asDiagonal();
  EXPECT_TRUE(find_nearest_inertia(flat)->isApprox(expected / 3, 1e-12));
  // Turned by any rotation it turns along.
  const Matrix3 R =
      Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_TRUE(find_nearest_inertia(R * flat * R.transpose())
                  ->isApprox(R * expected * R.transpose() / 3, 1e-12));
  // An edge: (-1, 1, 1) is nearest to a rod (0, 1, 1), which must have a width.
  const Matrix3 rod = *find_nearest_inertia(Vector3(-1, 1, 1).asDiagonal());
  EXPECT_TRUE(rod.isApprox(Matrix3(Vector3(1e-6, 1, 1).asDiagonal()), 1e-12));
}

// No admissible inertia on a grid around is nearer.
TEST(NearestInertia, HasNoNearerNeighbourThatAMassHas) {
  for (const Vector3& given :
       {Vector3(1, 1, 3), Vector3(0.1, 0.5, 2), Vector3(-0.3, 1, 2),
        Vector3(0.2, -0.1, 1), Vector3(5, 15, 25)}) {
    const Matrix3 nearest = *find_nearest_inertia(given.asDiagonal());
    const double distance = (nearest - Matrix3(given.asDiagonal())).norm();
    const double h = 0.02 * given.norm();
    for (int i = 0; i < 41 * 41 * 41; ++i) {
      const Vector3 I =
          nearest.diagonal() +
          h * Vector3(i % 41 - 20, i / 41 % 41 - 20, i / 1681 - 20);
      const bool is_admissible = I.sum() >= 2 * I.maxCoeff();
      if (is_admissible) {
        EXPECT_GE((I - given).norm(), distance * (1 - 1e-9));
      }
    }
  }
}

TEST(NearestInertia, LeavesMassesPointsAndPrintedDigitsAlone) {
  EXPECT_FALSE(find_nearest_inertia(Matrix3::Zero()));
  EXPECT_FALSE(find_nearest_inertia(Vector3(1, 2, 3).asDiagonal()));
  EXPECT_FALSE(find_nearest_inertia(Vector3(1, 2, 3.001).asDiagonal()));
}

Robot with_massless(const std::string& more = "") {
  return read(link("base") + link("arm") + link("frame", "") +
              link("camera", "") + joint("j", "base", "arm", "continuous") +
              joint("k", "arm", "frame", "continuous") +
              joint("f", "frame", "camera", "fixed") + more);
}

TEST(MasslessLinks, AtTheEndOfAChainDoNotMove) {
  Robot robot = with_massless();
  fix_massless_ends({}, robot);
  EXPECT_EQ(robot.joints[0].kind, joints::JointKind::continuous);
  EXPECT_EQ(robot.joints[1].kind, joints::JointKind::fixed);
  EXPECT_THAT(robot.warnings,
              ElementsAre(HasSubstr("1 joint of links without mass is fixed at "
                                    "zero, the first 'k'")));
}

TEST(MasslessLinks, MoveWhereSomethingNeedsThem) {
  const auto kind_of_k = [](const std::set<std::string>& used,
                            const std::string& more) {
    Robot robot = with_massless(more);
    fix_massless_ends(used, robot);
    return robot.joints[1].kind;
  };
  EXPECT_EQ(kind_of_k({"k"}, ""), joints::JointKind::continuous);
  EXPECT_EQ(kind_of_k({},
                      "<spring name='s' stiffness='1' from='camera' "
                      "to='world'/>"),
            joints::JointKind::continuous);
  EXPECT_EQ(
      kind_of_k({}, link("hand") + joint("h", "camera", "hand", "continuous")),
      joints::JointKind::continuous);
  EXPECT_EQ(kind_of_k({}, link("tip", "") +
                              joint("h", "camera", "tip", "continuous")),
            joints::JointKind::fixed);
}

TEST(MasslessLinks, AreARootOnlyWhereMassHangsOnThem) {
  EXPECT_FALSE(has_massless_root(with_massless()));
  EXPECT_TRUE(has_massless_root(read(link("a", "") + link("b", "") + link("c") +
                                     joint("f", "a", "b", "fixed") +
                                     joint("j", "b", "c", "continuous"))));
  EXPECT_FALSE(has_massless_root(read(link("a", ""))));
  EXPECT_FALSE(has_massless_root(
      read(link("a", "") + link("b") + joint("f", "a", "b", "fixed"))));
}

class Packages : public ::testing::Test {
 protected:
  Packages() {
    make("above/robot/meshes");
    make("above/near/meshes");
    make("path/far/meshes");
    make("path/group/deep/meshes");
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("LIMBER_PACKAGE_PATH");
  }

  void make(const std::string& folder) const {
    std::filesystem::create_directories(root() / folder);
    std::ofstream(root() / folder / "a.stl") << "x";
  }

  [[nodiscard]] const std::filesystem::path& root() const {
    return folder_.path();
  }

  [[nodiscard]] std::filesystem::path find(
      const std::string& name, const RobotOptions& options = {}) const {
    return find_in_package(name + "/meshes/a.stl", root() / "above" / "robot",
                           options);
  }

  limber::test::TemporaryFolder folder_;
};

TEST_F(Packages, AreAroundTheFileInThePathsOrNamed) {
  EXPECT_EQ(find("near"), root() / "above/near/meshes/a.stl");
  EXPECT_EQ(find("robot"), root() / "above/robot/meshes/a.stl");
  EXPECT_EQ(find("far"), "");
  EXPECT_EQ(find("other", {{{"other", root() / "path/far"}}}),
            root() / "path/far/meshes/a.stl");
  EXPECT_EQ(find("near", {{{"near", root() / "path"}}}), "");
}

TEST_F(Packages, AreInFoldersOfTheEnvironmentAndOneLevelDeeper) {
  const std::string path = "/no/such:" + (root() / "path").string();
  for (const char* variable : {"ROS_PACKAGE_PATH", "LIMBER_PACKAGE_PATH"}) {
    setenv(variable, path.c_str(), 1);
    EXPECT_EQ(find("far"), root() / "path/far/meshes/a.stl") << variable;
    EXPECT_EQ(find("deep"), root() / "path/group/deep/meshes/a.stl");
    EXPECT_EQ(find("none"), "");
    setenv(variable, (root() / "path/far").c_str(), 1);
    EXPECT_EQ(find("far"), root() / "path/far/meshes/a.stl");
    unsetenv(variable);
  }
}

}  // namespace
}  // namespace limber::scene::vendor_habits_test

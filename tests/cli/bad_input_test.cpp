// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::bad_input_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kMaterial =
    " --youngs-modulus 200e9 --poisson-ratio 0.3 --density 8000 ";
const std::string kBeam = LIMBER_SOURCE_DIR "/meshes/beam579.msh";

/// A beam on its own, or with what a test puts in.
struct SceneText {
  std::string mesh = kBeam;
  std::string poisson = "0";
  std::string density = "8000";
  std::string eigenmodes = "2";
  std::string robot_more;
  std::string flexible_more;
  std::string duration = "0.001";
  std::string scenario_more;
};

void write_scene(const Workspace& place, const SceneText& text) {
  place.write(
      "robot.urdf",
      fmt::format("<robot name='r'><link name='beam'/>{}<flexible link='beam'>"
                  "<mesh file='{}'/><material youngs_modulus='200e9' "
                  "poisson_ratio='{}' density='{}'/><basis eigenmodes='{}'/>{}"
                  "</flexible></robot>\n",
                  text.robot_more, text.mesh, text.poisson, text.density,
                  text.eigenmodes, text.flexible_more));
  place.write("scenario.toml",
              fmt::format("robot = \"robot.urdf\"\n[time]\nduration = {}\n"
                          "step = 0.0005\n{}\n",
                          text.duration, text.scenario_more));
}

/// Exit status 2, nothing on standard output, one line that names `culprit`.
void expect_refused(const CommandResult& result, const std::string& culprit) {
  EXPECT_EQ(result.status, 2) << result.errors;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1)
      << result.errors;
  EXPECT_THAT(result.errors, StartsWith("limber: error: "));
  EXPECT_THAT(result.errors, HasSubstr(culprit));
}

void expect_scene_refused(const SceneText& text, const std::string& culprit,
                          const std::string& arguments = "") {
  const Workspace place;
  write_scene(place, text);
  expect_refused(place.limber("run scenario.toml " + arguments), culprit);
}

void expect_mesh_refused(const std::string& text, const std::string& culprit) {
  const Workspace place;
  place.write("part.msh", text);
  expect_refused(place.limber("modes part.msh --count 2" + kMaterial), culprit);
}

/// Two linear tetrahedra (2.2 ASCII) on the corners of a unit cube.
std::string two_tetrahedra(const std::string& first,
                           const std::string& second) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n"
         "3 0 1 0\n4 0 0 1\n5 5 0 0\n6 6 0 0\n7 5 1 0\n8 5 0 1\n$EndNodes\n"
         "$Elements\n2\n1 4 2 1 1 " +
         first + "\n2 4 2 1 1 " + second + "\n$EndElements\n";
}

TEST(BadInput, MissingScenario) {
  const Workspace place;
  expect_refused(place.limber("run nowhere.toml"), "nowhere.toml");
}

TEST(BadInput, MissingRobot) {
  const Workspace place;
  place.write("s.toml", "robot='gone.urdf'\n[time]\nduration=1.0\nstep=0.1\n");
  expect_refused(place.limber("run s.toml"), "gone.urdf");
}

TEST(BadInput, MissingMesh) {
  SceneText text;
  text.mesh = "gone.msh";
  expect_scene_refused(text, "gone.msh");
  const Workspace place;
  expect_refused(place.limber("modes gone.msh --count 2" + kMaterial),
                 "gone.msh");
}

TEST(BadInput, GroupThatNoElementHas) {
  SceneText text;
  text.flexible_more = "<interface name='i' group='tipp'/>";
  expect_scene_refused(text, "tipp");
  const Workspace place;
  expect_refused(
      place.limber("modes '" + kBeam + "' --clamp rot --count 2" + kMaterial),
      "rot");
}

TEST(BadInput, InterfaceWithoutNodes) {
  SceneText text;
  text.flexible_more =
      "<interface name='bolt' cylinder_from='0.5 0.5 6' "
      "cylinder_to='0.5 0.5 7' cylinder_radius='0.1'/>";
  expect_scene_refused(text, "link 'beam': interface 'bolt': ");
  expect_scene_refused(
      text,
      "no surface node belongs to the cylinder from (0.5, 0.5, 6) to (0.5, "
      "0.5, 7) m of radius 0.1 m; the nearest is 1 m away");
}

TEST(BadInput, ProbeOnAPlaneWithoutNodes) {
  SceneText text;
  text.scenario_more =
      "[[probe]]\nname='p'\nlink='beam'\n"
      "plane={point=[0,0,5.5],normal=[0,0,1]}\n";
  expect_scene_refused(text,
                       "no surface node belongs to the plane through (0, 0, "
                       "5.5) m normal to (0, 0, 1); the nearest is 0.5 m away");
}

TEST(BadInput, RotationOfALineOfNodes) {
  SceneText text;
  text.scenario_more =
      "[[probe]]\nname='turn'\nlink='beam'\nquantity='rotation'\n"
      "plane={point=[1,1,0],normal=[1,1,0]}\n";
  expect_scene_refused(text, "probe 'turn' on link 'beam': ");
  expect_scene_refused(text,
                       "nodes are on one line along (0, 0, 1), so it has "
                       "no rotation about (0, 0, 1)");
}

TEST(BadInput, MomentOnANode) {
  SceneText text;
  text.scenario_more =
      "[[load]]\nname='twist'\nlink='beam'\nmoment=[0,0,2]\n"
      "nearest=[0,0,5]\n";
  expect_scene_refused(text,
                       "load 'twist': link 'beam': interface 'nearest:0,0,5': "
                       "it is one node, so it has no rotation about (0, 0, 1)");
}

TEST(BadInput, DegenerateElement) {
  expect_mesh_refused(two_tetrahedra("1 2 3 4", "1 2 3 3"), "element 2");
}

TEST(BadInput, InvertedElement) {
  expect_mesh_refused(two_tetrahedra("1 2 3 4", "1 3 2 4"), "inverted");
}

TEST(BadInput, MeshOfSurfacesOnly) {
  expect_mesh_refused(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n"
      "3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n",
      "part.msh");
}

TEST(BadInput, TwoDisconnectedParts) {
  expect_mesh_refused(two_tetrahedra("1 2 3 4", "5 6 7 8"), "part.msh");
}

TEST(BadInput, NegativeDensity) {
  SceneText text;
  text.density = "-8000";
  expect_scene_refused(text, "density");
  const Workspace place;
  expect_refused(place.limber("modes '" + kBeam +
                              "' --youngs-modulus 1 --poisson-ratio 0 "
                              "--density -5 --count 2"),
                 "density");
}

TEST(BadInput, IncompressibleMaterial) {
  SceneText text;
  text.poisson = "0.5";
  expect_scene_refused(text, "poisson_ratio");
  const Workspace place;
  expect_refused(place.limber("modes '" + kBeam +
                              "' --youngs-modulus 1 --poisson-ratio 0.5 "
                              "--density 5 --count 2"),
                 "poisson-ratio");
}

TEST(BadInput, UnknownKey) {
  SceneText text;
  text.scenario_more = "rho_info = 0.9";
  expect_scene_refused(text, "did you mean 'rho_inf'");
}

TEST(BadInput, WrongUnitType) {
  SceneText text;
  text.duration = "\"1 s\"";
  expect_scene_refused(text, "time.duration: expected a number > 0");
}

TEST(BadInput, ZeroDuration) {
  SceneText text;
  text.duration = "0";
  expect_scene_refused(text, "time.duration: is 0");
}

TEST(BadInput, JointWhoseLinkDoesNotExist) {
  SceneText text;
  text.robot_more =
      "<joint name='j' type='fixed'><parent link='beam'/><child "
      "link='bean'/></joint>";
  expect_scene_refused(text, "did you mean 'beam'");
}

TEST(BadInput, LoopThatUrdfCannotHave) {
  SceneText text;
  text.robot_more =
      "<link name='b'/>"
      "<joint name='j' type='fixed'><parent link='beam'/><child link='b'/>"
      "</joint>"
      "<joint name='k' type='fixed'><parent link='b'/><child link='beam'/>"
      "</joint>";
  expect_scene_refused(text, "joint 'k' closes a loop");
}

/// Two rigid links on the world, and what a test adds.
void expect_robot_refused(const std::string& more, const std::string& culprit,
                          const std::string& scenario_more = "") {
  const std::string mass =
      "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
      "ixz='0' iyz='0'/></inertial></link>";
  const Workspace place;
  place.write("robot.urdf",
              "<robot name='r'><link name='world'/><link name='a'>" + mass +
                  "<link name='b'>" + mass + more + "</robot>\n");
  place.write("scenario.toml",
              "robot = \"robot.urdf\"\n[time]\nduration = 0.1\nstep = "
              "0.01\n" +
                  scenario_more);
  expect_refused(place.limber("run scenario.toml"), culprit);
}

/// Joints j, k of these types, one after the other.
std::string two_joints(const std::string& type, const std::string& more_j = "",
                       const std::string& more_k = "") {
  const auto joint = [&](const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& more) {
    return "<joint name='" + name + "' type='" + type + "'><parent link='" +
           parent + "'/><child link='" + child + "'/>" + more + "</joint>";
  };
  return joint("j", "world", "a", more_j) + joint("k", "a", "b", more_k);
}

TEST(BadInput, UnknownJointKind) {
  std::string robot = two_joints("continuous");
  robot.replace(robot.find("continuous"), 10, "screw");
  expect_robot_refused(robot, "joint 'j': unknown type 'screw'");
  expect_robot_refused(
      two_joints("floating") + "<coupler joint='j' kind='bal'/>",
      "unknown kind 'bal'; did you mean 'ball'");
}

TEST(BadInput, StopWhoseLowerBoundIsAboveItsUpper) {
  expect_robot_refused(
      two_joints("revolute",
                 "<limit lower='2' upper='1' effort='0' velocity='0'/>",
                 "<limit effort='0' velocity='0'/>"),
      "robot.urdf:1: joint 'j': its lower limit 2 is above its upper limit 1");
}

TEST(BadInput, DriveOnAFixedJoint) {
  expect_robot_refused(two_joints("fixed"),
                       "scenario.toml: drive 'j': joint 'j' is fixed",
                       "[[drive]]\njoint = 'j'\nmode = 'effort'\n"
                       "signal = { kind = 'constant', value = 1.0 }\n");
}

TEST(BadInput, TendonOverOnePoint) {
  expect_robot_refused(two_joints("continuous") +
                           "<tendon name='t' tension='1'><via link='a'/>"
                           "</tendon>",
                       "robot.urdf:1: <tendon> needs two or more <via>");
}

TEST(BadInput, MimicInACircle) {
  expect_robot_refused(two_joints("continuous", "<mimic joint='j'/>"),
                       "robot.urdf:1: joint 'j': <mimic> is circular (j -> j)");
}

TEST(BadInput, HingeWhoseAxisHasNoLength) {
  expect_robot_refused(two_joints("continuous", "<axis xyz='0 0 0'/>"),
                       "robot.urdf:1: joint 'j': its axis has no length");
}

TEST(BadInput, LoopWhoseEndsAreApart) {
  expect_robot_refused(two_joints("continuous") +
                           "<loop name='o' kind='ball' from='b' to='world' "
                           "to_xyz='1 0 0'/>",
                       "loop 'o': its ends are 1 m apart");
}

TEST(BadInput, MoreModesThanDegreesOfFreedom) {
  SceneText text;
  text.eigenmodes = "5000";
  expect_scene_refused(text, "5000");
  const Workspace place;
  expect_refused(place.limber("modes '" + kBeam + "' --count 5000" + kMaterial),
                 "5000");
}

TEST(BadInput, ProbeOnAnUnknownNode) {
  SceneText text;
  text.scenario_more = "[[probe]]\nname='p'\nlink='beam'\nnode=99999\n";
  expect_scene_refused(text, "99999");
}

TEST(BadInput, ResultsFolderThatCannotBeWritten) {
  const Workspace place;
  write_scene(place, {});
  place.write("file", "not a folder");
  expect_refused(place.limber("run scenario.toml --out file/results"),
                 "file/results");
}

TEST(BadInput, CorruptReducedBody) {
  const Workspace place;
  place.write("body.h5", "this is no HDF5 file");
  expect_refused(place.limber("info body.h5"), "body.h5");
}

TEST(BadInput, TruncatedReducedBody) {
  const Workspace place;
  ASSERT_EQ(place
                .limber("reduce '" + kBeam + "' --eigenmodes 2 -o body.h5" +
                        kMaterial)
                .status,
            0);
  const std::string whole = read_text(place.folder() / "body.h5");
  ASSERT_GT(whole.size(), 1000U);
  for (const double fraction : {0.3, 0.7, 0.99}) {
    place.write("cut.h5",
                whole.substr(0, std::size_t(fraction * double(whole.size()))));
    expect_refused(place.limber("info cut.h5"), "cut.h5");
  }
}

TEST(BadInput, UnknownLevelOfFidelity) {
  expect_scene_refused({}, "did you mean 'rigid'", "--fidelity rigd");
}

TEST(BadInput, CheckpointIntervalBelowZero) {
  expect_scene_refused({}, "is -1; expected a number >= 0",
                       "--checkpoint-interval -1");
}

TEST(BadInput, UnknownSubcommand) {
  const Workspace place;
  expect_refused(place.limber("rnu x.toml"), "limber --help");
}

TEST(BadInput, OfAJointWithoutItsInterfaceNamesThoseThatExist) {
  const Workspace place;
  place.write(
      "arm.urdf",
      "<robot name='r'><link name='base'/><link name='arm'/>"
      "<joint name='rooot' type='fixed'><parent link='base'/>"
      "<child link='arm'/></joint><flexible link='arm'><mesh "
      "file='" LIMBER_SOURCE_DIR
      "/meshes/beam579.msh'/><material youngs_modulus='200e9' "
      "poisson_ratio='0' density='8000'/><basis eigenmodes='1'/>"
      "<interface name='root' plane_point='0 0 0' plane_normal='0 0 1'/>"
      "</flexible></robot>\n");
  place.write("s.toml",
              "robot = 'arm.urdf'\n[time]\nduration = 0.1\nstep = 0.01\n");
  const CommandResult result = place.limber("run s.toml");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(
      result.errors,
      AllOf(HasSubstr("joint 'rooot' is attached to it at an interface of the "
                      "joint's own name"),
            HasSubstr("did you mean 'root'?"), HasSubstr("(known: root, "),
            HasSubstr("<attach joint=\"rooot\"")));
}

}  // namespace
}  // namespace limber::test::bad_input_test

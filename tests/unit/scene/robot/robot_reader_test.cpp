// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/robot_reader.hpp"

#include <gmock/gmock.h>

#include "places.hpp"
#include "unit/scene/robot/robot_text.hpp"

namespace limber::scene::robot_reader_test {
namespace {

using test::error_of;
using test::input_error;
using test::read;
using ::testing::HasSubstr;

std::string joint(const std::string& name, const std::string& parent,
                  const std::string& child,
                  const std::string& type = "revolute",
                  const std::string& more = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" +
         parent + "'/><child link='" + child +
         "'/><axis xyz='0 0 2'/><limit lower='-1' upper='1' effort='1' "
         "velocity='1'/>" +
         more + "</joint>\n";
}

std::string links(const std::string& names) {
  std::string text;
  for (const char c : names) text += std::string("<link name='") + c + "'/>\n";
  return text;
}

const char* const kMesh =
    "<mesh file='m.msh' unit='mm'/><material youngs_modulus='1e9' "
    "poisson_ratio='0.3' density='1000'/>";

TEST(RobotReader, OrdersLinksParentsFirstAndNormalisesAxes) {
  const Robot robot = read(links("cab") + joint("j", "a", "b") +
                           joint("k", "b", "c", "prismatic"));
  ASSERT_EQ(robot.links.size(), 3U);
  EXPECT_EQ(robot.links[0].name, "a");
  ASSERT_EQ(robot.joints.size(), 2U);
  EXPECT_EQ(robot.joints[1].child, 2);
  EXPECT_EQ(robot.joints[0].axis_J, Vector3::UnitZ());
  EXPECT_EQ(robot.joints[1].kind, joints::JointKind::prismatic);
  EXPECT_TRUE(robot.warnings.empty());
}

TEST(RobotReader, NormalisesAxesWhoseSquareIsNoNumber) {
  for (const char* length : {"1e-200", "1e200"}) {
    const Robot robot = read(
        links("ab") +
        "<joint name='j' type='continuous'><parent link='a'/><child link='b'/>"
        "<axis xyz='0 0 " +
        length + "'/></joint>");
    EXPECT_EQ(robot.joints.at(0).axis_J, Vector3::UnitZ()) << length;
  }
}

TEST(RobotReader, RefusesElementsNestedTooDeepForItsStack) {
  std::string deep;
  for (int i = 0; i < 300000; ++i) deep += "<a x='>' y=\"/>\">";
  EXPECT_THAT(error_of("\n<!--></a>-->" + deep),
              HasSubstr("robot.urdf:3: elements are nested more than 200"));
  std::string wide = links("a");
  for (int i = 0; i < 1000; ++i) wide += "<a x='/>'/><b><![CDATA[<c>]]></b>";
  EXPECT_EQ(read(wide).links.size(), 1U);
}

// A chain, root first, as links of equally long names.
std::string chain(int count) {
  const auto name = [](int i) { return "l" + std::to_string(100000 + i); };
  std::string text;
  for (int i = 0; i < count; ++i) text += "<link name='" + name(i) + "'/>\n";
  for (int i = 1; i < count; ++i) {
    text += joint("j" + std::to_string(i), name(i - 1), name(i));
  }
  return text;
}

TEST(RobotReader, ReadsLongChainsAndRefusesThoseForWhichThereIsNoStack) {
  const Robot robot = read(chain(3000));
  ASSERT_EQ(robot.links.size(), 3000U);
  EXPECT_EQ(robot.links.back().name, "l102999");
  EXPECT_EQ(robot.joints.back().parent, 2998);
  EXPECT_THAT(error_of(chain(10001)),
              HasSubstr("10001 links; at most 10000 are read"));
}

TEST(RobotReader, RefusesAZeroByteInPlaceOfPassingOverWhatFollows) {
  EXPECT_THAT(error_of(links("a") + std::string("\0<nonsense", 10)),
              HasSubstr("a byte 0"));
}

TEST(RobotReader, TurnsInertiaIntoLinkAxes) {
  const Robot robot = read(
      "<link name='a'><inertial><origin xyz='1 2 3' rpy='0 0 "
      "1.5707963267948966'/><mass value='2'/><inertia ixx='1' iyy='2' izz='3' "
      "ixy='0' ixz='0' iyz='0'/></inertial></link>");
  const Matrix3 expected = Vector3(2, 1, 3).asDiagonal();
  EXPECT_TRUE(robot.links[0].inertia->inertia.isApprox(expected, 1e-12));
  EXPECT_EQ(robot.links[0].inertia->p_LBcm, Vector3(1, 2, 3));
}

TEST(RobotReader, ReadsTheExtension) {
  const Robot robot = read(
      links("ab") + joint("j", "a", "b") + "<flexible link='b'>" + kMesh +
      "<origin xyz='0 0 1'/><damping ratio='0.02'/>"
      "<basis eigenmodes='4' interface_modes='false' rows='root tip'/>"
      "<interface name='i' box_lower='0 0 0' box_upper='1 1 1' "
      "weighting='equal'/><attach joint='j' interface='i'/></flexible>"
      "<coupler joint='j' rotational_stiffness='5'/>"
      "<spring name='s' from='b/i' to='world' to_xyz='0 0 9' stiffness='3'/>");
  const FlexibleLink& link = *robot.links[1].flexible;
  EXPECT_EQ(link.mesh.unit, 1e-3);
  EXPECT_EQ(link.mesh.file.filename(), "m.msh");
  EXPECT_EQ(link.X_LM.p, Vector3::UnitZ());
  EXPECT_EQ(link.loss_factor, 0.04);
  EXPECT_EQ(link.basis.eigenmodes, 4);
  EXPECT_FALSE(link.basis.interface_modes);
  EXPECT_EQ(link.rows, flexbody::parse_rows({"root", "tip"}));
  EXPECT_EQ(link.interfaces.at(0).weighting, flexbody::Weighting::equal);
  EXPECT_EQ(link.interface_of_joint.at("j"), "i");
  EXPECT_EQ(robot.joints[0].coupler.rotational_stiffness, 5.0);
  EXPECT_EQ(robot.connectors.at(0).from.where.interface, "i");
  EXPECT_EQ(robot.connectors.at(0).to.where.point, Vector3(0, 0, 9));
}

std::string interface(const std::string& attributes) {
  return links("a") + "<flexible link='a'>" + kMesh + "<interface name='i' " +
         attributes + "/></flexible>";
}

TEST(RobotReader, ReadsRegionsOfNodes) {
  const auto nodes = [](const std::string& attributes) {
    const Robot robot = read(interface(attributes));
    return robot.links[0].flexible->interfaces.at(0).nodes;
  };
  EXPECT_EQ(nodes("plane_point='0 0 5' plane_normal='0 0 -2'"),
            flexbody::NodeSelection(
                flexbody::PlaneNodes{{0, 0, 5}, {0, 0, -1}, 0.0}));
  EXPECT_EQ(nodes("cylinder_from='0 0 0' cylinder_to='0 0 1' "
                  "cylinder_radius='0.5' cylinder_inner_radius='0.5'"),
            flexbody::NodeSelection(
                flexbody::CylinderNodes{{0, 0, 0}, {0, 0, 1}, 0.5, 0.5}));
}

TEST(RobotReader, RefusesSelectionsWithoutShape) {
  EXPECT_THAT(error_of(interface("")), HasSubstr("needs exactly one of"));
  EXPECT_THAT(error_of(interface("group='g' plane_point='0 0 0' "
                                 "plane_normal='0 0 1'")),
              HasSubstr("needs exactly one of"));
  EXPECT_THAT(error_of(interface("plane_tolerance='1'")),
              HasSubstr("'plane_point' and 'plane_normal'"));
  EXPECT_THAT(error_of(interface("box_lower='0 0 0'")),
              HasSubstr("'box_upper'"));
  EXPECT_THAT(error_of(interface("cylinder_from='0 0 0' cylinder_to='0 0 1' "
                                 "cylinder_radius='1' "
                                 "cylinder_inner_radius='2'")),
              HasSubstr("inner radius 2 m"));
  EXPECT_THAT(error_of(interface("plane_point='0 0 0' plane_norml='0 0 1'")),
              HasSubstr("did you mean 'plane_normal'"));
}

TEST(RobotReader, ReadsTermsOfStaticDeformationModes) {
  const auto basis = [](const std::string& attributes) {
    return links("a") + "<flexible link='a'>" + kMesh + "<basis " + attributes +
           "/></flexible>";
  };
  const auto terms = [&](const std::string& attributes) {
    return read(basis(attributes)).links[0].flexible->basis.terms;
  };
  EXPECT_EQ(terms(""), 1);
  EXPECT_EQ(terms("terms='3' load_modes='false'"), 3);
  EXPECT_THAT(error_of(basis("terms='0'")), HasSubstr("terms"));
  EXPECT_THAT(
      error_of(basis("terms='2' interface_modes='false' load_modes='false'")),
      HasSubstr("leave interface_modes or load_modes on"));
}

TEST(RobotReader, ReadsAutomaticModes) {
  const auto basis = [](const std::string& attributes) {
    return links("a") + "<flexible link='a'>" + kMesh + "<basis " + attributes +
           "/></flexible>";
  };
  const Robot robot = read(basis(
      "eigenmodes='auto' threshold='0.8' measure='report' candidates='7'"));
  const auto& automatic = robot.links[0].flexible->basis.automatic;
  ASSERT_TRUE(automatic.has_value());
  EXPECT_EQ(automatic->threshold, 0.8);
  EXPECT_EQ(automatic->measure, flexbody::ModeMeasure::report);
  EXPECT_EQ(automatic->candidates, 7);
  EXPECT_THAT(error_of(basis("eigenmodes='4' threshold='0.8'")),
              HasSubstr("'threshold' goes with eigenmodes=\"auto\""));
  EXPECT_THAT(error_of(basis("eigenmodes='auto' measure='complience'")),
              HasSubstr("did you mean 'compliance'"));
  EXPECT_THAT(error_of(basis("eigenmodes='auto' threshold='1.1'")),
              HasSubstr("threshold"));
}

TEST(RobotReader, NamesTheNearestKnownWord) {
  EXPECT_THAT(error_of(links("a") + "<flexible link='a'>" + kMesh +
                       "<dampin ratio='1'/></flexible>"),
              HasSubstr("did you mean 'damping'"));
  EXPECT_THAT(error_of(links("a") + "<flexible link='a'>" + kMesh +
                       "<damping ratoi='1'/></flexible>"),
              HasSubstr("did you mean 'ratio'"));
}

TEST(RobotReader, RefusesValuesOutsideTheirRange) {
  const std::string text = error_of(
      links("a") +
      "<flexible link='a'><mesh file='m.msh' order='7'/><material "
      "youngs_modulus='1' poisson_ratio='0.5' density='-1'/></flexible>");
  EXPECT_THAT(text, HasSubstr("order"));
  EXPECT_THAT(text, HasSubstr("poisson_ratio"));
  EXPECT_THAT(text, HasSubstr("density"));
}

TEST(RobotReader, RefusesWhatIsNoTree) {
  EXPECT_THAT(error_of(links("ab") + joint("j", "a", "x")),
              HasSubstr("unknown link 'x'"));
  EXPECT_THAT(error_of(links("abc") + joint("j", "a", "b") +
                       joint("k", "c", "b") + joint("l", "a", "c")),
              HasSubstr("two parents"));
  EXPECT_THAT(
      error_of(links("ab") + joint("j", "a", "b") + joint("k", "b", "a")),
      HasSubstr("loop"));
  EXPECT_THAT(error_of(links("ab")), HasSubstr("have no parent"));
}

// A scene with these was once run as if they were not there.
TEST(RobotReader, RefusesElementsAndTextWhereNoneIsRead) {
  const auto flexible = [&](const std::string& parts) {
    return error_of(links("a") + "<flexible link='a'>" + parts + "</flexible>");
  };
  EXPECT_THAT(
      flexible("<mesh file='m.msh'><origin xyz='1 0 0'/></mesh><material "
               "youngs_modulus='1' poisson_ratio='0' density='1'/>"),
      HasSubstr("robot.urdf:3: <mesh> takes no elements; it has a <origin>"));
  EXPECT_THAT(flexible(kMesh + std::string("<origin>0 0 1</origin>")),
              HasSubstr("<origin> holds the text '0 0 1'"));
  EXPECT_THAT(flexible(kMesh + std::string("<damping><ratio/></damping>")),
              HasSubstr("<damping> takes no elements"));
  EXPECT_THAT(error_of(links("ab") + joint("j", "a", "b") +
                       "<spring name='s' stiffness='1'><from link='a'>"
                       "<origin xyz='1 0 0'/></from><to link='b'/></spring>"),
              HasSubstr("<from> takes no elements"));
}

TEST(RobotReader, RefusesWhatAFlexibleLinkHasTwiceOrASavedBodyCannotTake) {
  const auto flexible = [&](const std::string& parts) {
    return error_of(links("a") + "<flexible link='a'>" + parts + "</flexible>");
  };
  for (const std::string tag : {"origin", "damping", "basis"}) {
    EXPECT_THAT(flexible(kMesh + ("<" + tag + "/><") + tag + "/>"),
                HasSubstr("has more than one <" + tag + ">"));
  }
  EXPECT_THAT(flexible(kMesh + std::string("<mesh file='n.msh'/>")),
              HasSubstr("more than one <mesh>"));
  const std::string saved = "<reduced file='a.h5'/>";
  EXPECT_EQ(flexible(saved), "");
  for (const std::string part :
       {"<basis eigenmodes='3'/>", "<interface name='i' group='g'/>",
        "<material youngs_modulus='1' poisson_ratio='0' density='1'/>"}) {
    EXPECT_THAT(flexible(saved + part), HasSubstr("goes with <mesh>")) << part;
  }
}

TEST(RobotReader, RefusesMisspeltWordsOfUrdf) {
  const std::string ab = links("ab");
  const auto with = [&](const std::string& more) {
    return error_of(ab + joint("j", "a", "b", "revolute", more));
  };
  EXPECT_THAT(with("<dynamics dampin='1'/>"),
              HasSubstr("did you mean 'damping'"));
  EXPECT_THAT(with("<dynamic damping='1'/>"),
              HasSubstr("did you mean 'dynamics'"));
  EXPECT_THAT(with("<origin xyz='0 0 0' rpi='0 0 1'/>"),
              HasSubstr("did you mean 'rpy'"));
  EXPECT_THAT(with("<dynamics damping='1'/><dynamics friction='1'/>"),
              HasSubstr("<dynamics> is given twice"));
  EXPECT_THAT(error_of(ab + joint("j", "a", "b") + "<flexibel link='b'/>"),
              HasSubstr("did you mean 'flexible'"));
  EXPECT_THAT(error_of("<link name='a'><inertia mass='1'/></link>"),
              HasSubstr("did you mean 'inertial'"));
  EXPECT_THAT(error_of(links("a") + "<xacro:include filename='b.xacro'/>"),
              HasSubstr("expand the file first"));
}

TEST(RobotReader, WarnsOfWordsOfUrdfThatItDoesNotRead) {
  const Robot robot =
      read(links("ab") +
           joint("j", "a", "b", "revolute",
                 "<dynamics damping='1' spring_stiffness='4'/>") +
           "<environment gravity='1'/><environment/>");
  ASSERT_EQ(robot.warnings.size(), 2U);
  EXPECT_THAT(robot.warnings[0],
              ::testing::AllOf(HasSubstr("robot.urdf:4: <dynamics>"),
                               HasSubstr("'spring_stiffness' is not read")));
  EXPECT_THAT(robot.warnings[1], HasSubstr("'environment' is not read"));
}

TEST(RobotReader, PassesOverWhatOtherProgramsRead) {
  const Robot robot = read(
      "<material name='red'><color rgba='1 0 0 1'/></material>"
      "<link name='a'><visual><origin xyz='0 0 1'/><geometry><box "
      "size='1 1 1'/></geometry></visual><collision><geometry><sphere "
      "radius='1'/></geometry></collision><drake:proximity/></link>" +
      links("b") +
      joint("j", "a", "b", "revolute",
            "<safety_controller k_velocity='1'/><calibration rising='0'/>") +
      "<transmission name='t'><joint name='j'/></transmission>"
      "<gazebo reference='a'><mu1>0.2</mu1></gazebo><ros2_control name='c'/>");
  EXPECT_TRUE(robot.warnings.empty()) << robot.warnings.at(0);
}

TEST(RobotReader, RefusesUnknownJointTypes) {
  EXPECT_THAT(error_of(links("ab") + joint("j", "a", "b", "screw")),
              HasSubstr("unknown type 'screw'"));
}

TEST(RobotReader, NamesTheLineOfBrokenXml) {
  EXPECT_THAT(error_of("<link name='a'"), HasSubstr("robot.urdf:"));
  EXPECT_THAT(input_error([] { (void)read_robot("/no/such.urdf"); }),
              HasSubstr("/no/such.urdf"));
}

TEST(RobotReader, ReadsTheShippedModels) {
  const std::string folder = std::string(LIMBER_SOURCE_DIR) + "/models/";
  const Robot arm = read_robot(folder + "capture_arm.urdf");
  EXPECT_EQ(arm.links.size(), 13U);
  EXPECT_EQ(arm.connectors.size(), 6U);
  EXPECT_TRUE(arm.warnings.empty());
  EXPECT_TRUE(read_robot(folder + "beam.urdf").links[0].flexible);
}

}  // namespace
}  // namespace limber::scene::robot_reader_test

// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <numbers>
#include <vector>

#include "unit/scene/robot/robot_text.hpp"

/// Joints, loops, tendons, gears and latches as the robot's file gives them.
namespace limber::scene::coupler_reader_test {
namespace {

using joints::JointKind;
using test::error_of;
using test::read;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kRange =
    "<limit lower='-1' upper='2' effort='5' velocity='3'/>";
const std::string kFree = "<limit effort='0' velocity='0'/>";

std::string joint(const std::string& name, const std::string& child,
                  const std::string& type, const std::string& more = kRange) {
  return "<joint name='" + name + "' type='" + type +
         "'><parent link='a'/><child link='" + child + "'/>" + more +
         "</joint>";
}

/// Links a, b, c, d, and joint j of `type` from a to b.
std::string base(const std::string& type, const std::string& more = kRange) {
  return "<link name='a'/><link name='b'/><link name='c'/><link name='d'/>" +
         joint("k", "c", "prismatic") + joint("l", "d", "continuous") +
         joint("j", "b", type, more);
}

const Joint& joint_j(const Robot& robot) {
  for (const Joint& joint : robot.joints) {
    if (joint.name == "j") return joint;
  }
  throw std::logic_error("no joint j");
}

template <typename Law>
const Law& action(const Joint& joint, std::size_t i) {
  return std::get<Law>(joint.actions.at(i).law);
}

TEST(CouplerReader, LimitsAreEndStopsAndLimitsOfDrives) {
  for (const char* type : {"revolute", "prismatic"}) {
    const Robot robot = read(base(type));
    const Joint& j = joint_j(robot);
    ASSERT_EQ(j.actions.size(), 1U);
    const auto& stop = action<StopOptions>(j, 0);
    EXPECT_EQ(stop.lower, -1.0);
    EXPECT_EQ(stop.upper, 2.0);
    EXPECT_FALSE(stop.stiffness.has_value());
    EXPECT_EQ(j.max_effort, 5.0);
    EXPECT_EQ(j.max_speed, 3.0);
    EXPECT_TRUE(robot.warnings.empty());
  }
}

TEST(CouplerReader, LimitsOfZeroAreNone) {
  const Robot robot = read(base("revolute", kFree));
  const Joint& j = joint_j(robot);
  EXPECT_TRUE(j.actions.empty());
  EXPECT_EQ(j.max_effort, joints::Drive::kUnlimited);
  EXPECT_EQ(j.max_speed, joints::Drive::kUnlimited);
}

TEST(CouplerReader, ContinuousJointHasNoStops) {
  const Robot robot = read(base("continuous"));
  EXPECT_TRUE(joint_j(robot).actions.empty());
  EXPECT_EQ(joint_j(robot).max_effort, 5.0);
}

TEST(CouplerReader, DynamicsAreDampingAndFriction) {
  const Robot robot =
      read(base("continuous", "<dynamics damping='0.5' friction='0.25'/>"));
  const Joint& j = joint_j(robot);
  EXPECT_EQ(j.coupler.free_damping, 0.5);
  ASSERT_EQ(j.actions.size(), 1U);
  EXPECT_EQ(action<joints::Friction::Parameters>(j, 0).coulomb, 0.25);
}

TEST(CouplerReader, StopOfACouplerTunesTheOneOfTheLimit) {
  const Robot robot = read(base("revolute") +
                           "<coupler joint='j'><stop upper='1.5' "
                           "stiffness='7' damping='2'/></coupler>");
  const Joint& j = joint_j(robot);
  ASSERT_EQ(j.actions.size(), 1U);
  const auto& stop = action<StopOptions>(j, 0);
  EXPECT_EQ(stop.lower, -1.0);
  EXPECT_EQ(stop.upper, 1.5);
  EXPECT_EQ(stop.stiffness, 7.0);
  EXPECT_EQ(stop.damping, 2.0);
}

TEST(CouplerReader, FrictionOfACouplerTakesThePlaceOfDynamics) {
  const Robot robot =
      read(base("continuous", "<dynamics friction='1'/>") +
           "<coupler joint='j'><friction coulomb='2' viscous='3' "
           "speed='0.01'/></coupler>");
  const Joint& j = joint_j(robot);
  ASSERT_EQ(j.actions.size(), 1U);
  const auto& friction = action<joints::Friction::Parameters>(j, 0);
  EXPECT_EQ(friction.coulomb, 2.0);
  EXPECT_EQ(friction.viscous, 3.0);
  EXPECT_EQ(friction.speed, 0.01);
}

TEST(CouplerReader, ReadsSpringsAlongCoordinates) {
  const Robot robot =
      read(base("planar") +
           "<coupler joint='j'>"
           "<spring coordinate='3' stiffness='4' quadratic='5' damping='6' "
           "rest='0.5' tension_only='true'/>"
           "<spring coordinate='1' table='0 0  1 2  2 5'/></coupler>");
  const Joint& j = joint_j(robot);
  ASSERT_EQ(j.actions.size(), 2U);
  EXPECT_EQ(j.actions[0].coordinate, 2);
  const auto& first = action<joints::ScalarSpring::Parameters>(j, 0);
  EXPECT_EQ(first.curve.parameters().stiffness, 4.0);
  EXPECT_EQ(first.curve.parameters().quadratic, 5.0);
  EXPECT_EQ(first.damping, 6.0);
  EXPECT_EQ(first.rest, 0.5);
  EXPECT_TRUE(first.tension_only);
  EXPECT_EQ(j.actions[1].coordinate, 0);
  const auto& curve =
      action<joints::ScalarSpring::Parameters>(j, 1).curve.parameters();
  EXPECT_THAT(curve.extensions, ElementsAre(0.0, 1.0, 2.0));
  EXPECT_THAT(curve.forces, ElementsAre(0.0, 2.0, 5.0));
}

TEST(CouplerReader, FloatingJointBecomesUniversalOrBall) {
  const Robot universal = read(
      base("floating") +
      "<coupler joint='j' kind='universal' axis='0 0 2' second_axis='3 0 0'/>");
  EXPECT_EQ(joint_j(universal).kind, JointKind::universal);
  EXPECT_EQ(joint_j(universal).axis_J, Vector3::UnitZ());
  EXPECT_EQ(joint_j(universal).second_J, Vector3::UnitX());
  const Robot ball = read(base("floating") +
                          "<coupler joint='j' kind='ball' free_damping='2'>"
                          "<spring coordinate='2' stiffness='1'/></coupler>");
  EXPECT_EQ(joint_j(ball).kind, JointKind::ball);
  EXPECT_EQ(joint_j(ball).coupler.free_damping, 2.0);
  EXPECT_EQ(joint_j(ball).actions.at(0).coordinate, 1);
}

TEST(CouplerReader, ReadsLoops) {
  const Robot robot = read(
      base("revolute") +
      "<loop name='pin' kind='revolute' axis='0 2 0' "
      "translational_stiffness='9'><from link='b' point='1 0 0' "
      "rpy='0 0 1.5707963267948966'/><to link='world' point='1 2 3'/>"
      "<stop lower='0' restitution='1' speed='2'/></loop>"
      "<loop name='weld' kind='fixed' from='b' from_xyz='4 5 6' to='c/tip'/>");
  ASSERT_EQ(robot.loops.size(), 2U);
  const Loop& pin = robot.loops[0];
  EXPECT_EQ(pin.kind, JointKind::revolute);
  EXPECT_EQ(pin.axis_F, Vector3::UnitY());
  EXPECT_EQ(pin.coupler.translational_stiffness, 9.0);
  EXPECT_EQ(pin.from.where.link, "b");
  EXPECT_EQ(pin.from.where.point, Vector3::UnitX());
  EXPECT_TRUE(pin.from.R.col(0).isApprox(Vector3::UnitY(), 1e-15));
  EXPECT_EQ(pin.to.where.link, "world");
  EXPECT_EQ(pin.to.where.point, Vector3(1, 2, 3));
  const auto& stop = std::get<StopOptions>(pin.actions.at(0).law);
  EXPECT_EQ(stop.lower, 0.0);
  EXPECT_FALSE(stop.upper.has_value());
  EXPECT_EQ(stop.restitution, 1.0);
  EXPECT_EQ(stop.speed, 2.0);
  EXPECT_EQ(robot.loops[1].from.where.point, Vector3(4, 5, 6));
  EXPECT_EQ(robot.loops[1].to.where.interface, "tip");
}

TEST(CouplerReader, ReadsSpringsOfEveryKind) {
  const Robot robot =
      read(base("revolute") +
           "<spring name='s' from='b' to='world' quadratic='3' damping='1' "
           "free_length='2' tension_only='true'/>"
           "<spring name='t' table='-1 -2 1 4'><from link='b'/><to link='c'/>"
           "</spring>");
  const auto& first = std::get<SpringOptions>(robot.connectors.at(0).law);
  EXPECT_EQ(first.law.quadratic, 3.0);
  EXPECT_EQ(first.law.damping, 1.0);
  EXPECT_EQ(first.free_length, 2.0);
  EXPECT_TRUE(first.law.tension_only);
  const auto& second = std::get<SpringOptions>(robot.connectors.at(1).law);
  EXPECT_THAT(second.law.extensions, ElementsAre(-1.0, 1.0));
  EXPECT_THAT(second.law.forces, ElementsAre(-2.0, 4.0));
  EXPECT_EQ(robot.connectors[1].to.where.link, "c");
}

TEST(CouplerReader, ReadsTendonsLatchesAndGears) {
  const Robot robot = read(
      base("revolute") +
      "<gear name='g' joint='j' with='pin' ratio='-2' offset='0.5' "
      "stiffness='6' damping='7'/>"  // before the loop that it names
      "<loop name='pin' kind='prismatic' from='b' to='world'/>"
      "<tendon name='t' stiffness='8' damping='1' pretension='3' tension='4'>"
      "<via link='b' point='1 0 0'/><via link='c'/><via link='world'/>"
      "</tendon>"
      "<latch name='grip' from='b' to='c' reach='0.1' "
      "rotational_stiffness='5' release_force='9' release_time='2'/>");
  const Gear& gear = robot.gears.at(0);
  EXPECT_EQ(gear.joint, "j");
  EXPECT_EQ(gear.with, "pin");
  EXPECT_EQ(gear.ratio, -2.0);
  EXPECT_EQ(gear.offset, 0.5);
  EXPECT_EQ(gear.stiffness, 6.0);
  EXPECT_EQ(gear.damping, 7.0);
  const Tendon& tendon = robot.tendons.at(0);
  EXPECT_EQ(tendon.via.size(), 3U);
  EXPECT_EQ(tendon.via[0].where.point, Vector3::UnitX());
  EXPECT_EQ(tendon.stiffness, 8.0);
  EXPECT_EQ(tendon.pretension, 3.0);
  EXPECT_EQ(tendon.tension, 4.0);
  const Latch& latch = robot.latches.at(0);
  EXPECT_EQ(latch.reach, 0.1);
  EXPECT_EQ(latch.coupler.rotational_stiffness, 5.0);
  EXPECT_EQ(latch.release_force, 9.0);
  EXPECT_EQ(latch.release_time, 2.0);
}

// [Kt Kc; Kc' Kr] = (i + 1) on the diagonal, and 0.5 between x and ry.
TEST(CouplerReader, ReadsBushingsOfSixBySixNumbers) {
  std::string matrix;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const bool couples = (i == 0 && j == 4) || (i == 4 && j == 0);
      matrix += i == j ? std::to_string(i + 1) + " " : couples ? "0.5 " : "0 ";
    }
  }
  const auto bushing = [&](const std::string& attributes) {
    return base("revolute") + "<bushing name='n' from='b' to='world' " +
           attributes + "/>";
  };
  const Robot robot = read(bushing("stiffness='" + matrix + "'"));
  const auto& law =
      std::get<joints::Bushing::Parameters>(robot.connectors.at(0).law);
  EXPECT_EQ(law.translational_stiffness.diagonal(), Vector3(1, 2, 3));
  EXPECT_EQ(law.rotational_stiffness.diagonal(), Vector3(4, 5, 6));
  Matrix3 coupling = Matrix3::Zero();
  coupling(0, 1) = 0.5;
  EXPECT_EQ(law.coupling_stiffness, coupling);
  EXPECT_TRUE(law.coupling_damping.isZero());
  EXPECT_THAT(error_of(bushing("damping='1 2 3'")),
              HasSubstr("damping: expected 36 numbers, got 3"));
  std::string skew = matrix;
  skew.replace(skew.find("0.5"), 3, "0.4");
  EXPECT_THAT(error_of(bushing("stiffness='" + skew + "'")),
              HasSubstr("expected a symmetric matrix"));
  std::string indefinite = matrix;
  indefinite.replace(0, 1, "0");
  EXPECT_THAT(error_of(bushing("stiffness='" + indefinite + "'")),
              HasSubstr("robot.urdf:2: <bushing>"));
  EXPECT_THAT(
      error_of(bushing("stiffness='" + matrix + "' rotational_stiffness='1'")),
      HasSubstr("unknown attribute 'rotational_stiffness'"));
}

TEST(CouplerReader, EndsSelectNodes) {
  const Robot robot =
      read(base("revolute") +
           "<bushing name='n' rotational_stiffness='1 2 3'>"
           "<from link='b' group='tip' weighting='equal' point='1 2 3'/>"
           "<to link='c' box_lower='0 0 0' box_upper='1 1 1'/></bushing>"
           "<spring name='s' stiffness='1'><from link='b' nearest='4 5 6'/>"
           "<to link='world'/></spring>");
  const Place& from = robot.connectors.at(0).from.where;
  EXPECT_EQ(std::get<flexbody::GroupNodes>(*from.nodes).group, "tip");
  EXPECT_EQ(from.weighting, flexbody::Weighting::equal);
  EXPECT_EQ(from.point, Vector3(1, 2, 3));
  EXPECT_TRUE(std::holds_alternative<flexbody::BoxNodes>(
      *robot.connectors[0].to.where.nodes));
  EXPECT_EQ(
      std::get<flexbody::NearestNode>(*robot.connectors.at(1).from.where.nodes)
          .point,
      Vector3(4, 5, 6));
  EXPECT_THAT(error_of(base("revolute") +
                       "<spring name='s' stiffness='1'><from link='b' "
                       "nearest='4 5 6' group='tip'/><to link='c'/></spring>"),
              HasSubstr("more than one of"));
}

TEST(CouplerReader, AxesOfEndsThatHaveNoneAreRefused) {
  const std::string nothing = "<from> 'rpy' has no effect here";
  const std::string from = "<from link='b' rpy='0 0 1'/><to link='c'/>";
  EXPECT_THAT(error_of(base("revolute") + "<spring name='s' stiffness='1'>" +
                       from + "</spring>"),
              HasSubstr(nothing));
  EXPECT_THAT(error_of(base("revolute") +
                       "<bushing name='n' rotational_stiffness='1'>"
                       "<from link='b'/><to link='c' rpy='0 0 1'/></bushing>"),
              HasSubstr("<to> 'rpy' has no effect here"));
  (void)read(base("revolute") + "<bushing name='n' rotational_stiffness='1'>" +
             from + "</bushing>");
  (void)read(base("revolute") +
             "<latch name='grip' reach='1'><from link='b' rpy='0 0 1'/>"
             "<to link='c' rpy='0 1 0'/></latch>");
}

TEST(CouplerReader, MimickingJointIsGeared) {
  const Robot robot = read(base(
      "revolute", kRange + "<mimic joint='k' multiplier='-3' offset='0.5'/>"));
  const Gear& gear = robot.gears.at(0);
  EXPECT_EQ(gear.name, "j.mimic");
  EXPECT_EQ(gear.joint, "j");
  EXPECT_EQ(gear.with, "k");
  EXPECT_EQ(gear.ratio, -3.0);
  EXPECT_EQ(gear.offset, 0.5);
}

struct Refused {
  std::string text;
  std::vector<std::string> culprits;
};

void expect_refused(const std::vector<Refused>& all) {
  for (const auto& [text, culprits] : all) {
    const std::string error = error_of(text);
    EXPECT_THAT(error, HasSubstr("robot.urdf:2: ")) << text;
    for (const std::string& culprit : culprits) {
      EXPECT_THAT(error, HasSubstr(culprit));
    }
  }
}

TEST(CouplerReader, RefusesJointsThatMakeNoSense) {
  expect_refused(
      {{base("revolute",
             "<limit lower='2' upper='1' effort='1' "
             "velocity='1'/>"),
        {"joint 'j'", "lower limit 2 is above its upper limit 1"}},
       {base("revolute", "<axis xyz='0 0 0'/>" + kRange),
        {"joint 'j'", "axis has no length"}},
       {base("continuous", "<dynamics damping='-1'/>"), {"damping=\"-1\""}},
       {base("floating", "<dynamics friction='1'/>"),
        {"friction acts along one coordinate"}},
       {base("revolute", kRange + "<mimic joint='q'/>"), {"unknown joint 'q'"}},
       {base("floating", "<mimic joint='k'/>"),
        {"needs joints with one coordinate; joint 'j' is floating"}},
       {base("revolute", kRange + "<mimic joint='j'/>"),
        {"circular (j -> j)"}}});
}

TEST(CouplerReader, RefusesMimicsInACircle) {
  const std::string error = error_of(
      "<link name='a'/><link name='b'/><link name='c'/>\n" +
      joint("x", "b", "revolute", kRange + "<mimic joint='y'/>") + "\n" +
      joint("y", "c", "revolute", kRange + "<mimic joint='x'/>"));
  EXPECT_THAT(error, AllOf(HasSubstr("robot.urdf:3: joint 'x'"),
                           HasSubstr("circular (x -> y -> x)")));
  EXPECT_THAT(error, Not(HasSubstr("joint 'y'")));  // once
}

TEST(CouplerReader, RefusesCouplersThatMakeNoSense) {
  const auto coupler = [](const std::string& attributes,
                          const std::string& child = "",
                          const std::string& type = "revolute") {
    return base(type) + "<coupler joint='j' " + attributes + ">" + child +
           "</coupler>";
  };
  expect_refused(
      {{coupler("kind='hinge'", "", "floating"),
        {"unknown kind 'hinge'", "universal", "ball"}},
       {coupler("kind='ball'"), {"type floating; joint 'j' is revolute"}},
       {coupler("kind='universal' axis='0 0 0'", "", "floating"),
        {"axis: it has no length"}},
       {coupler("kind='universal' second_axis='1 1 0'", "", "floating"),
        {"not normal"}},
       {coupler("", "<stop lower='3'/>"), {"lower=3 is above upper=2"}},
       {coupler("", "<stop stiffness='3'/>", "continuous"),
        {"needs 'lower' or 'upper'"}},
       {coupler("", "<stop damping='1' restitution='0.5'/>"), {"keep one"}},
       {coupler("", "<stop restitution='1.5'/>"), {"restitution"}},
       {coupler("", "<stop/><stop/>"), {"given twice"}},
       {coupler("", "<friction speed='1'/>"), {"needs 'coulomb'"}},
       {coupler("", "<spring/>"), {"needs 'stiffness'"}},
       {coupler("", "<spring table='1 2 3'/>"), {"pairs", "got 3"}},
       {coupler("", "<spring table='1 2 0 3'/>"), {"table decreases"}},
       {coupler("", "<spring stiffness='1'/>", "planar"),
        {"needs 'coordinate', 1 to 3"}},
       {coupler("", "<spring stiffness='1' coordinate='2'/>"),
        {"coordinate=\"2\""}},
       {coupler("", "<spring stiffness='1'/>", "fixed"), {"has none"}},
       {coupler("", "<stopp/>"), {"did you mean 'stop'"}},
       {coupler("") + "<coupler joint='j'/>", {"given twice"}}});
}

TEST(CouplerReader, RefusesLoopsTendonsGearsAndLatchesThatMakeNoSense) {
  const std::string ends = "from='b' to='world'";
  expect_refused(
      {{base("fixed") + "<loop name='o' kind='hinge' " + ends + "/>",
        {"unknown kind 'hinge'", "planar"}},
       {base("fixed") + "<loop name='o' kind='revolute' axis='0 0 0' " + ends +
            "/>",
        {"no length"}},
       {base("fixed") + "<loop name='o' kind='revolute' to='b'/>",
        {"needs 'from'"}},
       {base("fixed") + "<loop name='o' kind='ball' " + ends +
            "><to link='b'/></loop>",
        {"more than one 'to'"}},
       {base("fixed") + "<loop name='o' kind='ball' from='x' to='b'/>",
        {"unknown link 'x'"}},
       {base("fixed") + "<loop name='j' kind='ball' " + ends + "/>",
        {"'j' is given twice"}},
       {base("fixed") + "<tendon name='t'><via link='b'/></tendon>",
        {"two or more <via>; it has 1"}},
       {base("fixed") +
            "<tendon name='t' pretension='1'><via link='b'/><via link='c'/>"
            "</tendon>",
        {"'pretension' needs 'stiffness'"}},
       {base("fixed") + "<gear name='g' joint='k' with='q' ratio='1'/>",
        {"unknown joint 'q'"}},
       {base("fixed") + "<gear name='g' joint='k' with='j' ratio='1'/>",
        {"joint 'j' is fixed and has 0"}},
       {base("fixed") + "<gear name='g' joint='k' with='k' ratio='1'/>",
        {"with itself"}},
       {base("fixed") + "<gear name='g' joint='k' with='l' ratio='0'/>",
        {"ratio=0"}},
       {base("fixed") + "<latch name='h' " + ends + "/>", {"needs 'reach'"}},
       {base("fixed") + "<latch name='h' reach='0' " + ends + "/>",
        {"reach=\"0\""}}});
}

}  // namespace
}  // namespace limber::scene::coupler_reader_test

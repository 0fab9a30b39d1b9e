// SPDX-License-Identifier: BSD-3-Clause
// Settings of scenario and robot: equal to an edited file, or refused.
#include <gmock/gmock.h>

#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::scene::settings_test {
namespace {

using test::SceneFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kScenario = R"(
[time]
duration = 1.0
step = 0.1
[initial.joints]
hinge = { position = 0.2 }
[[load]]
name = 'push'
link = 'arm'
force = [1.0, 2.0, 3.0]
[[load]]
name = 'a.b'
link = 'arm'
force = [4.0, 5.0, 6.0]
[[projectile]]
name = 'ball'
radius = 0.1
mass = 1.0
position = [0.0, 0.0, 9.0]
[[contact]]
between = ['ball', 'arm']
friction = 0.1
restitution = 0.5
)";

std::string make_robot() {
  return test::kWorld +
         "<link name='arm'><inertial><mass value='2'/><inertia ixx='1' "
         "iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
         "<collision><geometry><sphere radius='0.2'/></geometry></collision>"
         "</link>"
         "<joint name='hinge' type='revolute'><parent link='world'/>"
         "<child link='arm'/><origin xyz='1 2 3'/><axis xyz='0 1 0'/>"
         "<limit lower='-1' upper='1' effort='0' velocity='0'/></joint>"
         "<link name='hand'><inertial><mass value='2'/><inertia ixx='1' "
         "iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
         "<joint name='wrist' type='continuous'><parent link='arm'/>"
         "<child link='hand'/><axis xyz='0 1 0'/></joint>"
         "<coupler joint='wrist' rotational_stiffness='7'>"
         "<friction coulomb='1'/></coupler>";
}

class SettingsOfAScene : public ::testing::Test {
 protected:
  SettingsOfAScene() { (void)folder_.load(make_robot(), kScenario); }

  [[nodiscard]] Scene load(const std::vector<std::string>& texts) const {
    Overrides overrides;
    for (const std::string& text : texts) {
      overrides.settings.push_back(parse_setting(text));
    }
    return load_scene(folder_.path() / "scenario.toml", overrides);
  }

  [[nodiscard]] std::string refusal(
      const std::vector<std::string>& texts) const {
    try {
      (void)load(texts);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  SceneFolder folder_;
};

TEST_F(SettingsOfAScene, ReplaceValuesByName) {
  const Scene scene = load(
      {"load.push.force.2=-200", "load.\"a.b\".force.0 = 7", "time.step=1e-4",
       "contact.0.friction=0.3", "initial.joints.hinge.position=-0.25"});
  EXPECT_EQ(scene.scenario.loads.at(0).force, Vector3(1.0, 2.0, -200.0));
  EXPECT_EQ(scene.scenario.loads.at(1).force, Vector3(7.0, 5.0, 6.0));
  EXPECT_EQ(scene.scenario.settings.step, 1e-4);
  EXPECT_EQ(scene.scenario.contacts.at(0).options.friction, 0.3);
  EXPECT_EQ(scene.scenario.joints.at("hinge").position,
            std::vector<double>{-0.25});
}

TEST_F(SettingsOfAScene, AddKeysAndTablesThatTheReaderKnows) {
  const Scene scene =
      load({"time.tolerance=1e-6", "advice.displacement=1e-5",
            "initial.joints.wrist.velocity=3", "fidelity.default=rigid"});
  EXPECT_EQ(scene.scenario.settings.tolerance, 1e-6);
  EXPECT_EQ(scene.scenario.advice.displacement, 1e-5);
  EXPECT_EQ(scene.scenario.joints.at("wrist").velocity,
            std::vector<double>{3.0});
  EXPECT_EQ(scene.scenario.fidelity, dynamics::Fidelity::rigid);
}

TEST_F(SettingsOfAScene, ChangeTheRobot) {
  const Scene scene = load(
      {"robot.joint.hinge.translational_stiffness=1e8",
       "robot.joint.hinge.limit.upper=0.5", "robot.joint.hinge.origin.xyz.1=-4",
       "robot.joint.wrist.origin.xyz=[0, 0, 0.5]",
       "robot.coupler.wrist.rotational_stiffness=9",
       "robot.coupler.wrist.friction.coulomb=2",
       "robot.link.arm.inertial.mass.value=5",
       "robot.link.arm.collision.geometry.sphere.radius=0.3",
       "robot.contact.arm.youngs_modulus=1e9",
       "robot.contact.arm.poisson_ratio=0.3"});
  const Joint& hinge = scene.robot.joints.at(0);
  EXPECT_EQ(hinge.coupler.translational_stiffness, 1e8);
  EXPECT_EQ(std::get<StopOptions>(hinge.actions.at(0).law).upper, 0.5);
  EXPECT_EQ(hinge.X_PJ.p, Vector3(1.0, -4.0, 3.0));
  const Joint& wrist = scene.robot.joints.at(1);
  EXPECT_EQ(wrist.X_PJ.p, Vector3(0.0, 0.0, 0.5));
  EXPECT_EQ(wrist.coupler.rotational_stiffness, 9.0);
  EXPECT_EQ(scene.robot.links.at(1).inertia->mass, 5.0);
  EXPECT_TRUE(scene.robot.links.at(1).contact.material.has_value());
}

TEST_F(SettingsOfAScene, RemoveKeys) {
  Overrides overrides;
  overrides.settings = {{"time.step", std::nullopt},
                        {"time.tolerance", "1e-5"},
                        {"robot.coupler.wrist.rotational_stiffness", {}}};
  const Scene scene = load_scene(folder_.path() / "scenario.toml", overrides);
  EXPECT_EQ(scene.scenario.settings.tolerance, 1e-5);
  EXPECT_FALSE(scene.robot.joints.at(1).coupler.rotational_stiffness);
  overrides.settings = {{"time.stop", std::nullopt}};
  EXPECT_THROW((void)load_scene(folder_.path() / "scenario.toml", overrides),
               InputError);
}

TEST_F(SettingsOfAScene, NumbersKeepAllTheirDigits) {
  const Scene scene = load(
      {"time.step=0.1000000000000000055511151231257827",
       "load.push.force.0=4.9406564584124654e-324",
       "robot.link.arm.inertial.mass.value=" + fmt::format("{}", 1.0 / 3.0)});
  EXPECT_EQ(scene.scenario.settings.step, 0.1);
  EXPECT_EQ(scene.scenario.loads.at(0).force.x(), 4.9406564584124654e-324);
  EXPECT_EQ(scene.robot.links.at(1).inertia->mass, 1.0 / 3.0);
}

struct Refused {
  const char* name;
  std::vector<std::string> texts;
  const char* words;
};

class WrongSetting : public SettingsOfAScene,
                     public ::testing::WithParamInterface<Refused> {};

TEST_P(WrongSetting, IsRefusedByItsName) {
  const std::string words = refusal(GetParam().texts);
  EXPECT_THAT(words, HasSubstr(GetParam().words));
  EXPECT_THAT(words,
              HasSubstr("--set " + GetParam().texts.back().substr(0, 12)));
}

INSTANTIATE_TEST_SUITE_P(
    , WrongSetting,
    ::testing::Values(
        Refused{"UnknownTable", {"tiem.step=1e-3"}, "did you mean 'time'?"},
        Refused{"UnknownKey", {"time.stepp=1e-3"}, "did you mean 'step'?"},
        Refused{
            "UnknownItem", {"load.pusch.force.0=1"}, "did you mean 'push'?"},
        Refused{"EntryBeyondTheEnd", {"load.push.force.3=1"}, "it has 3"},
        Refused{"ItemBeyondTheEnd", {"contact.1.friction=1"}, "it has 1"},
        Refused{"PathThroughANumber", {"time.step.x=1"}, "has no 'x'"},
        Refused{"Table", {"time=3"}, "is a table"},
        Refused{"Tables", {"load=[]"}, "is an array of tables"},
        Refused{"Twice", {"time.step=1", "time.step=2"}, "sets, too"},
        Refused{"TwiceByNameAndNumber",
                {"load.push.force.0=1", "load.0.force.0=1"},
                "sets, too"},
        Refused{"WholeAndEntry",
                {"load.push.force=[1, 1, 1]", "load.push.force.0=1"},
                "sets, too"},
        Refused{"WrongType", {"time.step=fast"}, "expected"},
        Refused{"OutOfRange", {"time.step=-1"}, "-1"},
        Refused{"TableAsValue", {"time.step={a = 1}"}, "got table"},
        Refused{"NotFinite", {"load.push.force.0=nan"}, "nan"},
        Refused{"EmptyPart", {"time..step=1"}, "empty part"},
        Refused{"OpenQuote", {"load.\"push=1\".force=1"}, ""},
        Refused{"RobotAlone", {"robot.link=1"}, "does not name a value"},
        Refused{"JointModel", {"robot.joint=1"}, "expected a string"},
        Refused{"RobotKind",
                {"robot.jiont.hinge.type=fixed"},
                "did you mean 'joint'?"},
        Refused{"RobotName",
                {"robot.joint.hing.type=fixed"},
                "did you mean 'hinge'?"},
        Refused{"RobotChild",
                {"robot.joint.hinge.limit.uper=1"},
                "did you mean 'limit.upper'?"},
        Refused{"RobotCoupler",
                {"robot.joint.hinge.rotational_stifness=1"},
                "did you mean 'rotational_stiffness'?"},
        Refused{"RobotElement", {"robot.joint.hinge.limit=1"}, "unknown"},
        Refused{"EmptyFolder", {"output.folder="}, "is empty"},
        Refused{"RobotNotFinite",
                {"robot.link.arm.inertial.mass.value=nan"},
                "Link [arm]: Inertial: mass [nan] is not a float"},
        Refused{"RobotTwice",
                {"robot.joint.wrist.free_damping=1",
                 "robot.coupler.wrist.free_damping=2"},
                "sets, too"},
        Refused{"RobotEntry", {"robot.joint.hinge.origin.xyz.3=1"}, "it has 3"},
        Refused{"RobotRenamed", {"robot.joint.hinge.name=other"}, "by which"},
        Refused{"RobotText",
                {"robot.coupler.wrist.rotational_stiffness=soft"},
                "soft"},
        Refused{"RobotFlexible",
                {"robot.flexible.arm.basis.eigenmodes=3"},
                "unknown flexible 'arm'"}),
    [](const auto& one) { return one.param.name; });

TEST_F(SettingsOfAScene, TellsOfOthersThatMayHaveCausedAnError) {
  EXPECT_THAT(refusal({"load.push.link=leg"}),
              AllOf(HasSubstr("leg"), HasSubstr("(with --set load.push.link")));
}

TEST(SettingText, NeedsAKeyAndAnEqualsSign) {
  EXPECT_THROW((void)parse_setting("time.step"), InputError);
  EXPECT_THROW((void)parse_setting("=1"), InputError);
  EXPECT_EQ(parse_setting("a.\"b=c\" = d = e"),
            (Setting{"a.\"b=c\"", "d = e"}));
}

TEST_F(SettingsOfAScene, AreOfOneOfSeveralRobotsByItsName) {
  std::ofstream(folder_.path() / "scenario.toml") << R"(
[time]
duration = 1.0
step = 0.1
[[robot]]
name = 'left'
file = 'robot.urdf'
[[robot]]
name = 'right'
file = 'robot.urdf'
)";
  const Scene scene = load({"robot.left.joint.hinge.origin.xyz.0=9",
                            "robot.right.position=[0, 0, 5]"});
  EXPECT_EQ(scene.robot.joints.at(1).X_PJ.p.x(), 9.0);
  EXPECT_EQ(scene.robot.joints.at(4).X_PJ.p.x(), 1.0);
  EXPECT_EQ(scene.scenario.robots.at(1).start.position.z(), 5.0);
  EXPECT_THAT(refusal({"robot.lift.joint.hinge.origin.xyz.0=9"}),
              AllOf(HasSubstr("unknown robot 'lift'"), HasSubstr("'left'")));
  EXPECT_THAT(refusal({"robot.left.joint.hange.origin.xyz.0=9"}),
              HasSubstr("'hinge'"));
  EXPECT_THAT(refusal({"robot.joint.hinge.origin.xyz.0=9"}),
              HasSubstr("unknown robot 'joint'"));
}

}  // namespace
}  // namespace limber::scene::settings_test

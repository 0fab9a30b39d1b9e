// SPDX-License-Identifier: BSD-3-Clause
// Values set in a robot that its scene has no use for are told, with the
// reason.
#include <gmock/gmock.h>

#include "limber/scene/build/load_scene.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::scene::unused_settings_test {
namespace {

using test::SceneFolder;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string make_link(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><mass value='2'/><inertia ixx='1' iyy='1' izz='1' "
         "ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry>"
         "<sphere radius='0.2'/></geometry></collision></link>";
}

std::string make_joint(const std::string& name, const std::string& type,
                       const std::string& child, const std::string& more) {
  return "<joint name='" + name + "' type='" + type +
         "'><parent link='world'/><child link='" + child + "'/>" + more +
         "</joint>";
}

std::string make_robot() {
  const std::string limit =
      "<limit lower='-1' upper='1' effort='5' velocity='6'/>"
      "<dynamics damping='0.1' friction='0.2'/>";
  return test::kWorld + make_link("a") + make_link("b") + make_link("c") +
         make_link("d") + make_joint("plain", "revolute", "a", limit) +
         make_joint("extended", "revolute", "b", limit) +
         make_joint("endless", "continuous", "c", limit) +
         make_joint("free", "floating", "d", "") +
         "<coupler joint='extended' free_damping='0.3'>"
         "<stop lower='-2' stiffness='10'/><friction coulomb='1'/></coupler>";
}

const std::string kScenario =
    test::time_table(1.0, 0.1) +
    "[[drive]]\njoint = 'plain'\nmode = 'velocity'\ndamping = 1.0\n"
    "max_effort = 3.0\nsignal = { kind = 'constant', value = 0.0 }\n"
    "[[projectile]]\nname = 'ball'\nradius = 0.1\nmass = 1.0\n"
    "position = [0.0, 0.0, 9.0]\n"
    "[[contact]]\nbetween = ['ball', 'a']\nfriction = 0.1\n"
    "restitution = 0.5\n";

class SettingOfARobot : public ::testing::Test {
 protected:
  SettingOfARobot() { (void)folder_.load(make_robot(), kScenario); }

  [[nodiscard]] std::vector<std::string> warnings(
      const std::string& text) const {
    Overrides overrides;
    overrides.settings = {parse_setting(text)};
    return load_scene(folder_.path() / "scenario.toml", overrides)
        .scenario.warnings;
  }

  void expect_unused(const std::string& text, const std::string& why) const {
    EXPECT_THAT(warnings(text),
                ElementsAre("--set " + text + " changes nothing: " + why));
  }

  SceneFolder folder_;
};

TEST_F(SettingOfARobot, ThatActsIsNotTold) {
  for (const char* text :
       {"robot.joint.plain.limit.lower=-0.5", "robot.joint.plain.limit.upper=2",
        "robot.joint.plain.limit.lower='-0.5'",
        "robot.joint.plain.limit.velocity=1",
        "robot.joint.plain.dynamics.friction=0.3",
        "robot.joint.plain.dynamics.damping=1_000.0",
        "robot.joint.plain.axis.xyz=[0, 1, 0]",
        "robot.joint.extended.limit.upper=0.5",
        "robot.joint.extended.stop.lower=-0.5",
        "robot.joint.extended.free_damping=0.5",
        "robot.joint.free.dynamics.damping=0.5",
        "robot.link.a.collision.geometry.sphere.radius=0.3"}) {
    EXPECT_THAT(warnings(text), IsEmpty()) << text;
  }
}

TEST_F(SettingOfARobot, ThatACouplerReplacesIsTold) {
  expect_unused("robot.joint.extended.limit.lower=-0.5",
                "the <stop> of its <coupler> has its own");
  expect_unused("robot.joint.extended.dynamics.friction=0.5",
                "the <friction> of its <coupler> replaces it");
  expect_unused("robot.joint.extended.dynamics.damping=0.5",
                "its <coupler> has its own free_damping");
}

TEST_F(SettingOfARobot, ThatItsTypeOfJointDoesNotHaveIsTold) {
  expect_unused("robot.joint.endless.limit.upper=2",
                "its type is continuous, which has no range");
  expect_unused("robot.joint.free.axis.xyz=[0, 1, 0]",
                "its type is floating, which has no axis");
  expect_unused("robot.joint.free.translational_damping=7",
                "its type is floating, which constrains no translation");
  expect_unused("robot.joint.free.rotational_stiffness=7",
                "its type is floating, which constrains no rotation");
}

TEST_F(SettingOfARobot, ThatLimitsNoDriveIsTold) {
  expect_unused("robot.joint.plain.limit.effort=1",
                "each [[drive]] of it has its own max_effort");
  expect_unused("robot.joint.endless.limit.velocity=1",
                "it limits drives, and no [[drive]] acts on it");
}

TEST_F(SettingOfARobot, ThatOnlyContactsNeedIsToldWithoutThem) {
  expect_unused("robot.link.b.collision.geometry.sphere.radius=0.3",
                "no [[contact]] names the link");
}

TEST_F(SettingOfARobot, OfABasisThatTheScenarioChoosesIsTold) {
  const SceneFolder folder;
  const std::string robot =
      test::kWorld + "<link name='bar'/>" +
      make_joint("weld", "fixed", "bar", "") +
      "<flexible link='bar'><mesh file='bar.msh'/><material "
      "youngs_modulus='2e11' poisson_ratio='0.3' density='8000'/>"
      "<damping ratio='0.1'/><basis eigenmodes='2'/></flexible>";
  const auto find = [&](const std::string& more, const std::string& text) {
    (void)folder.load(robot, test::time_table(1.0, 0.1) + more);
    Overrides overrides;
    overrides.settings = {parse_setting(text)};
    return load_scene(folder.path() / "scenario.toml", overrides)
        .scenario.warnings;
  };
  const std::string basis = "robot.flexible.bar.basis.eigenmodes=3";
  const std::string damping = "robot.flexible.bar.damping.ratio=0.2";
  const std::string level = "[fidelity]\ndefault = 'rigid'\n";
  EXPECT_THAT(find("[basis]\neigenmodes = 4\n", basis),
              ElementsAre("--set " + basis +
                          " changes nothing: the "
                          "scenario's [basis] has its own"));
  EXPECT_THAT(find("[basis.links.bar]\neigenmodes = 4\n", basis),
              ElementsAre("--set " + basis +
                          " changes nothing: the "
                          "scenario's [basis] has its own"));
  EXPECT_THAT(find("[basis]\nstatic_deformation = { loads = false }\n", basis),
              IsEmpty());
  EXPECT_THAT(find("", damping), IsEmpty());
  EXPECT_THAT(find(level, damping),
              ElementsAre("--set " + damping +
                          " changes nothing: the link "
                          "is at level rigid, which has no modes"));
}

}  // namespace
}  // namespace limber::scene::unused_settings_test

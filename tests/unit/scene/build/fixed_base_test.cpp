// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "limber/scene/build/scenario_writer.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

/// Robots that fall, and those whose base is fixed.
namespace limber::scene::fixed_base_test {
namespace {

using test::input_error;
using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::simulate_probes;
using test::time_table;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kArm =
    rigid_link("base", 3.0, 1.0) + rigid_link("upper", 1.0, 0.5, "0.5 0 0") +
    "<joint name='j' type='continuous'><parent link='base'/><child "
    "link='upper'/><origin xyz='0.2 0 0'/><axis xyz='0 1 0'/></joint>\n";
const std::string kHeld =
    "<joint name='h' type='fixed'><parent link='world'/>"
    "<child link='base'/><origin xyz='1 2 3' rpy='0.1 "
    "0.2 0.3'/></joint>\n";
const std::string kGravity = "[gravity]\nacceleration = [0, 0, -9.81]\n";

std::string probe(const std::string& link) {
  return time_table(0.3, 1e-3) + kGravity + "[[probe]]\nname = 'p'\nlink = '" +
         link + "'\nquantity = 'position'\n";
}

const std::string kPose =
    "position = [1, 2, 3]\norientation_rpy = [0.1, 0.2, 0.3]\n";

class FixedBase : public ::testing::Test {
 protected:
  /// With `robot` in place of the file's name.
  [[nodiscard]] Scene load(const std::string& links, const std::string& rest,
                           const std::string& robot,
                           const Overrides& overrides = {}) const {
    std::ofstream(folder_.path() / "r.urdf") << "<robot name='r'>\n"
                                             << links << "</robot>\n";
    std::ofstream(folder_.path() / "s.toml") << rest << robot;
    return load_scene(folder_.path() / "s.toml", overrides);
  }

  SceneFolder folder_;
};

const std::string kFixed = "[robot]\nfile = 'r.urdf'\nbase = 'fixed'\n";

TEST_F(FixedBase, StandsWhereALinkWorldWouldHoldIt) {
  const auto run = [&](const Scene& scene) {
    return simulate_probes(folder_.build(scene));
  };
  const std::vector<double> held = run(load(
      kWorld + kArm + kHeld, probe("upper"), "[robot]\nfile = 'r.urdf'\n"));
  const auto same = ::testing::Pointwise(::testing::DoubleNear(1e-12), held);
  EXPECT_THAT(
      run(load(kArm, probe("upper") + "[initial.base]\n" + kPose, kFixed)),
      same);
  EXPECT_THAT(run(load(kArm, probe("A.upper"),
                       "[[robot]]\nname = 'A'\nfile = 'r.urdf'\nbase = "
                       "'fixed'\n" +
                           kPose)),
              same);
}

TEST_F(FixedBase, IsASettingOfAnyScenario) {
  Overrides overrides;
  overrides.settings = {{"robot.base", "fixed"}};
  const Scene scene =
      load(kArm, "robot = 'r.urdf'\n" + probe("upper"), "", overrides);
  EXPECT_TRUE(scene.robot.has_world_root());
  EXPECT_THAT(scene.scenario.notes, IsEmpty());
  const std::string written = rewrite_scenario(
      folder_.path() / "s.toml", overrides, folder_.path() / "deep");
  EXPECT_THAT(written, HasSubstr("../r.urdf"));
  EXPECT_THAT(written, HasSubstr("fixed"));
}

TEST_F(FixedBase, IsSaidToMissWhereARobotFalls) {
  const auto notes = [&](const std::string& links, const std::string& more) {
    return load(links, "robot = 'r.urdf'\n" + more, "").scenario.notes;
  };
  EXPECT_THAT(notes(kArm, probe("base")),
              ElementsAre(HasSubstr("link 'base' falls freely")));
  EXPECT_THAT(notes(kArm, time_table(1, 1e-2)), IsEmpty());
  EXPECT_THAT(notes(kWorld + kArm + kHeld, probe("base")), IsEmpty());
  EXPECT_THAT(notes(kArm + "<spring name='s' stiffness='1' from='world' "
                           "to='upper'/>",
                    probe("base")),
              IsEmpty());
  EXPECT_THAT(notes(kArm, probe("base") + "[[load]]\nname = 'l'\nlink = "
                                          "'upper'\nforce = [0, 0, 1]\n"),
              IsEmpty());
  const std::string two =
      "[[robot]]\nname = 'A'\nfile = 'r.urdf'\nbase = "
      "'fixed'\n[[robot]]\nname = 'B'\nfile = 'r.urdf'\n";
  EXPECT_THAT(load(kArm, probe("A.upper"), two).scenario.notes,
              ElementsAre(HasSubstr("link 'B.base' falls freely")));
  EXPECT_THAT(load(kArm,
                   probe("A.upper") +
                       "[[coupler]]\ntype = 'tendon'\nname = 't'\nstiffness = "
                       "1\nvia = [{ link = 'A.upper' }, { link = 'B.upper', "
                       "point = [1, 0, 0] }]\n",
                   two)
                  .scenario.notes,
              IsEmpty());
}

TEST_F(FixedBase, IsThatOfARootWithoutMass) {
  const std::string links =
      "<link name='foot'/>" + kArm +
      "<joint name='k' type='continuous'><parent link='foot'/><child "
      "link='base'/><axis xyz='0 1 0'/></joint>\n";
  const Scene scene = load(links, probe("upper"), "[robot]\nfile = 'r.urdf'\n");
  EXPECT_TRUE(scene.robot.has_world_root());
  EXPECT_THAT(scene.scenario.warnings,
              ElementsAre(HasSubstr("'foot' has no mass, so it is fixed")));
  const Scene free =
      load(links, probe("upper"), "[robot]\nfile = 'r.urdf'\nbase = 'free'\n");
  EXPECT_THAT(input_error([&] { (void)folder_.build(free); }),
              HasSubstr("'foot' moves but has no mass"));
}

TEST_F(FixedBase, RefusesWhatDoesNotFit) {
  const auto error = [&](const std::string& links, const std::string& rest,
                         const std::string& robot) {
    return input_error([&] { (void)load(links, rest, robot); });
  };
  EXPECT_THAT(error(kArm, time_table(1, 1e-2),
                    "[robot]\nfile = 'r.urdf'\nbase = 'fix'\n"),
              HasSubstr("unknown base 'fix'"));
  EXPECT_THAT(error(kArm, time_table(1, 1e-2), "[robot]\nbase = 'fixed'\n"),
              HasSubstr("needs 'file'"));
  EXPECT_THAT(
      error(kArm,
            time_table(1, 1e-2) + "[initial.base]\nvelocity = [1, 0, 0]\n",
            kFixed),
      HasSubstr("has a velocity, but the root link is fixed"));
  EXPECT_THAT(error(kArm, time_table(1, 1e-2),
                    "[[robot]]\nname = 'A'\nfile = 'r.urdf'\nbase = 'fixed'\n"
                    "velocity = [1, 0, 0]\n"),
              HasSubstr("has no velocity"));
  EXPECT_THAT(load(kWorld + kArm + kHeld, time_table(1, 1e-2), kFixed)
                  .scenario.warnings,
              ElementsAre(HasSubstr("base changes nothing")));
}

TEST_F(FixedBase, BadInertiasComeAtOnceWithTheirLines) {
  std::string bad = kArm;
  for (const char* izz : {"izz='1'", "izz='0.5'"}) {
    bad.replace(bad.find(izz), std::string(izz).size(), "izz='9'");
  }
  const Scene free =
      load(bad, time_table(0.1, 1e-2), "[robot]\nfile = 'r.urdf'\n");
  const std::string text = input_error([&] { (void)folder_.build(free); });
  EXPECT_THAT(text, HasSubstr("link 'base' at"));
  EXPECT_THAT(text, HasSubstr("r.urdf:2"));
  EXPECT_THAT(text, HasSubstr("link 'upper' at"));
  EXPECT_THAT(text, HasSubstr("r.urdf:3"));
  const Scene repaired =
      load(bad, time_table(0.1, 1e-2) + "[urdf]\nrepair_inertia = true\n",
           "[robot]\nfile = 'r.urdf'\n");
  EXPECT_EQ(folder_.build(repaired).model.bodies.size(), 2U);
  // (1, 1, 9) is off its face by 7.
  EXPECT_THAT(repaired.robot.warnings.at(0),
              HasSubstr("to ixx=3.33333 iyy=3.33333 izz=6.66667"));
}

}  // namespace
}  // namespace limber::scene::fixed_base_test

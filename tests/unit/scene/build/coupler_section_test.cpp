// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/coupler_section.hpp"

#include <gmock/gmock.h>

#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

/// [[coupler]]s of a scenario against the same elements in one robot's file.
namespace limber::scene::coupler_section_test {
namespace {

using test::input_error;
using test::rigid_link;
using test::SceneFolder;
using test::simulate_probes;
using test::time_table;
using ::testing::HasSubstr;

const std::string kChaser =
    rigid_link("hull", 5.0, 0.4) + rigid_link("arm", 1.0, 0.1, "0.3 0 0") +
    "<joint name='shoulder' type='continuous'><parent link='hull'/><child "
    "link='arm'/><origin xyz='0.4 0 0'/><axis xyz='0 0 1'/></joint>\n";
const std::string kTarget =
    rigid_link("body", 2.0, 0.2) + rigid_link("wheel", 0.5, 0.05) +
    "<joint name='axle' type='continuous'><parent link='body'/><child "
    "link='wheel'/><axis xyz='0 0 1'/></joint>\n";
const std::string kFree =
    "<joint name='free' type='floating'><parent link='hull'/><child "
    "link='body'/><origin xyz='2 0.1 0'/></joint>\n";

/// The same coupler in a robot's file and in a scenario, with the names of its
/// links and joints in @ and without.
struct Case {
  std::string element;
  std::string section;
};

const std::vector<Case>& list_cases() {
  static const std::vector<Case> cases = {
      {"<tendon name='c' stiffness='90' damping='3' free_length='0.8'><via "
       "link='arm' point='0.5 0.1 0'/><via link='body' point='0 0.2 0.1'/><via "
       "link='wheel'/></tendon>",
       "type = 'tendon'\nstiffness = 90\ndamping = 3\nfree_length = 0.8\nvia = "
       "[{ link = 'A.arm', point = [0.5, 0.1, 0] }, { link = 'B.body', point = "
       "[0, 0.2, 0.1] }, { link = 'B.wheel' }]\n"},
      {"<spring name='c' stiffness='40' quadratic='3' damping='0.2' "
       "free_length='1' from='arm' from_xyz='0.5 0 0' to='wheel'/>",
       "type = 'spring'\nstiffness = 40\nquadratic = 3\ndamping = 0.2\n"
       "free_length = 1.0\nfrom = 'A.arm'\nfrom_xyz = [0.5, 0, 0]\nto = "
       "'B.wheel'\n"},
      {"<bushing name='c' translational_stiffness='50 20 30' "
       "rotational_stiffness='4' translational_damping='1' "
       "rotational_damping='0'><from link='arm' point='1.4 0.1 0' rpy='0.1 0.2 "
       "0.3'/><to link='body' point='-0.2 0 0'/></bushing>",
       "type = 'bushing'\ntranslational_stiffness = [50, 20, 30]\n"
       "rotational_stiffness = 4\ntranslational_damping = 1\n"
       "rotational_damping = 0\nfrom = { link = 'A.arm', point = [1.4, 0.1, "
       "0], "
       "rpy "
       "= [0.1, 0.2, 0.3] }\nto = { link = 'B.body', point = [-0.2, 0, 0] }\n"},
      {"<loop name='c' kind='revolute' axis='0 0 1'><from link='arm' "
       "point='1.6 0.1 0'/><to link='body'/><friction coulomb='0.3'/><stop "
       "lower='-0.4' upper='0.4'/></loop>",
       "type = 'loop'\nkind = 'revolute'\naxis = [0, 0, 1]\nfrom = { link = "
       "'A.arm', point = [1.6, 0.1, 0] }\nto = { link = 'B.body' }\nfriction = "
       "{ coulomb = 0.3 }\nstop = { lower = -0.4, upper = 0.4 }\n"},
      {"<latch name='c' reach='0.3'><from link='arm' point='1.4 0.1 0'/><to "
       "link='body'/></latch>",
       "type = 'latch'\nreach = 0.3\nfrom = { link = 'A.arm', point = [1.4, "
       "0.1, 0] }\nto = { link = 'B.body' }\n"},
      {"<gear name='c' joint='shoulder' with='axle' ratio='-2' "
       "stiffness='500'/>",
       "type = 'gear'\njoint = 'A.shoulder'\nwith = 'B.axle'\nratio = -2\n"
       "stiffness = 500\n"}};
  return cases;
}

std::string probes(const std::string& a, const std::string& b,
                   const std::string& coupler) {
  std::string text = time_table(0.4, 1e-3);
  for (const std::string& link : {a + "arm", b + "body", b + "wheel"}) {
    text += "[[probe]]\nname = 'x" + link + "'\nlink = '" + link +
            "'\nquantity = 'position'\n";
  }
  return text + "[[probe]]\nname = 'e'\ncoupler = '" + coupler +
         "'\nquantity = 'energy'\n[[load]]\nname = 'l'\nlink = '" + b +
         "wheel'\nforce = [-3, 2, 1]\nmoment = [0.1, 0, 2]\n";
}

class CouplerSection : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_.path() / file) << text;
  }

  void write_robots() const {
    write("a.urdf", "<robot name='a'>" + kChaser + "</robot>");
    write("b.urdf", "<robot name='b'>" + kTarget + "</robot>");
  }

  [[nodiscard]] Scene load_two(const std::string& more, bool is_swapped = false,
                               const Overrides& overrides = {}) const {
    write_robots();
    const std::string A = "[[robot]]\nname = 'A'\nfile = 'a.urdf'\n";
    const std::string B =
        "[[robot]]\nname = 'B'\nfile = 'b.urdf'\nposition = [2, 0.1, 0]\n";
    write("scenario.toml", more + (is_swapped ? B + A : A + B));
    return load_scene(folder_.path() / "scenario.toml", overrides);
  }

  [[nodiscard]] std::vector<double> run_two(const Case& one,
                                            bool is_swapped) const {
    return simulate_probes(folder_.build(load_two(
        probes("A.", "B.", "c") + "[[coupler]]\nname = 'c'\n" + one.section,
        is_swapped)));
  }

  [[nodiscard]] std::string error_of(const std::string& coupler) const {
    return input_error([&] {
      (void)load_two(time_table(1, 1e-2) + "[[coupler]]\n" + coupler);
    });
  }

  SceneFolder folder_;
};

// A gear's default damping, and so on, depend on the bodies alone.
TEST_F(CouplerSection, BetweenRobotsActsAsInOneFile) {
  for (const Case& one : list_cases()) {
    const std::vector<double> expected = simulate_probes(folder_.build(
        kChaser + kTarget + kFree + one.element, probes("", "", "c")));
    const std::vector<double> found = run_two(one, false);
    const std::vector<double> swapped = run_two(one, true);
    ASSERT_EQ(found.size(), expected.size());
    double motion = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], 1e-9) << one.section;
      EXPECT_NEAR(swapped[i], expected[i], 1e-9) << one.section;
      motion += std::abs(expected[i]);
    }
    EXPECT_GT(motion, 1.0);
  }
}

TEST_F(CouplerSection, MovesWhatItJoins) {
  const std::string none = time_table(0.4, 1e-3) +
                           "[[probe]]\nname = 'x'\nlink = 'A.hull'\n"
                           "[[load]]\nname = 'l'\nlink = 'B.body'\n"
                           "force = [-3, 2, 1]\n";
  EXPECT_NEAR(simulate_probes(folder_.build(load_two(none)))[0], 0.0, 1e-12);
  for (const Case& one : list_cases()) {
    if (one.section.find("'gear'") != std::string::npos) continue;
    const Scene scene =
        load_two(none + "[[coupler]]\nname = 'c'\n" + one.section);
    EXPECT_GT(std::abs(simulate_probes(folder_.build(scene))[0]), 1e-5)
        << one.section;
  }
}

TEST_F(CouplerSection, OfTheOnlyRobotNamesItsLinks) {
  const auto x = [&](const std::string& robot, const std::string& more) {
    return simulate_probes(folder_.build(
        kChaser + robot,
        time_table(0.2, 1e-3) +
            "[[probe]]\nname = 'x'\nlink = 'hull'\n[[load]]\nname = "
            "'l'\nlink = 'hull'\nforce = [1, 2, 3]\n" +
            more));
  };
  EXPECT_EQ(x("",
              "[[coupler]]\ntype = 'spring'\nname = 's'\nstiffness = 20\n"
              "from = 'world'\nto = 'hull'\nfrom_xyz = [0, 0, 1]\n"),
            x("<spring name='s' stiffness='20' from='world' to='hull' "
              "from_xyz='0 0 1'/>",
              ""));
}

TEST_F(CouplerSection, IsSetAndReleasedLikeEverythingElse) {
  const std::string tendon = probes("A.", "B.", "c") +
                             "[[coupler]]\nname = 'c'\n" +
                             list_cases().front().section;
  Overrides overrides;
  overrides.settings = {{"coupler.c.stiffness", "180"},
                        {"coupler.c.via.0.point.1", "0.2"}};
  const Robot robot = load_two(tendon, false, overrides).robot;
  EXPECT_EQ(robot.tendons.at(0).stiffness, 180.0);
  EXPECT_EQ(robot.tendons[0].via[0].where.point, Vector3(0.5, 0.2, 0.0));
  const Scene released = load_two(time_table(1, 1e-2) +
                                  "[[release]]\nlatch = 'c'\ntime = 0.5\n"
                                  "[[coupler]]\nname = 'c'\n" +
                                  list_cases()[4].section);
  EXPECT_EQ(released.scenario.releases.at("c"), 0.5);
}

TEST_F(CouplerSection, TellsEveryProblemWithItsLine) {
  const std::string text = error_of(
      "type = 'spring'\nname = 's'\nstiffness = 1\nfrom = 'A.arms'\nto = "
      "'B.body'\n[[coupler]]\ntype = 'sprin'\n[[coupler]]\ntype = "
      "'tendon'\nname = 's'\nstiffness = -1\nmass = 1\nvia = [{ link = 'C.a' "
      "}]\n");
  for (const char* part :
       {"scenario.toml:4: <spring> unknown link 'A.arms'; did you mean 'A.arm'",
        "scenario.toml:10: [[coupler]] type: unknown type 'sprin'; did you "
        "mean "
        "'spring'?",
        "scenario.toml:12: <tendon> stiffness=\"-1\"",
        "scenario.toml:12: <tendon> needs two or more <via>; it has 1",
        "scenario.toml:12: <tendon> unknown link 'C.a'",
        "scenario.toml:12: <tendon> 's' is given twice",
        "scenario.toml:12: <tendon> unknown attribute 'mass'"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST_F(CouplerSection, RefusesWhatIsNoCoupler) {
  EXPECT_THAT(error_of("name = 's'\n"), HasSubstr("unknown type ''"));
  EXPECT_THAT(error_of("type = 'flexible'\nlink = 'A.arm'\n"),
              HasSubstr("unknown type 'flexible'"));
  EXPECT_THAT(error_of("type = 'gear'\nname = 'A.shoulder'\njoint = "
                       "'A.shoulder'\nwith = 'B.axle'\nratio = 1\n"),
              HasSubstr("'A.shoulder' is given twice"));
  EXPECT_THAT(error_of("type = 'gear'\nname = 'g'\njoint = 'A.shoulder'\nwith "
                       "= 'A'\nratio = 1979-05-27\n"),
              HasSubstr("has a value that is not a number"));
  EXPECT_THAT(input_error([&] {
                (void)load_two("coupler = 3\n" + time_table(1, 1e-2));
              }),
              HasSubstr("expected [[coupler]] tables"));
}

}  // namespace
}  // namespace limber::scene::coupler_section_test

// SPDX-License-Identifier: BSD-3-Clause
// --set: the same as a file with that value, in every command.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::settings_test {
namespace {

using ::testing::HasSubstr;

std::string make_scenario(double force, double duration) {
  return "robot = '" LIMBER_SOURCE_DIR
         "/models/beam.urdf'\n[time]\nduration = " +
         std::to_string(duration) +
         "\nstep = 1e-3\n[output]\npictures = false\n"
         "[[load]]\nname = 'push'\nlink = 'beam'\ngroup = 'tip'\n"
         "force = [0.0, 0.0, " +
         std::to_string(force) +
         "]\n[[probe]]\nname = 'p'\nlink = 'beam'\nnode = 1\n";
}

TEST(Settings, GiveTheResultsOfAFileWithTheirValues) {
  const Workspace place;
  place.write("a.toml", make_scenario(1.0, 0.02));
  place.write("b.toml", make_scenario(-200.0, 0.01));
  ASSERT_EQ(place.limber("run b.toml --out b").status, 0);
  const CommandResult set = place.limber(
      "run a.toml --out a --set load.push.force.2=-200 --set "
      "time.duration=0.01");
  ASSERT_EQ(set.status, 0) << set.errors;
  EXPECT_EQ(read_text(place.folder() / "a/probes.csv"),
            read_text(place.folder() / "b/probes.csv"));
  EXPECT_THAT(read_text(place.folder() / "a/summary.json"),
              HasSubstr("\"load.push.force.2\": \"-200\""));
}

TEST(Settings, OfTheRobotChangeItsFrequencies) {
  const Workspace place;
  place.write("a.toml", make_scenario(1.0, 0.02));
  const auto find = [&](const std::string& options) {
    const CommandResult result =
        place.limber("frequencies a.toml --json " + options);
    EXPECT_EQ(result.status, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.out, nullptr, false);
    return json["modes"].back()["frequency"].get<double>();
  };
  // Frequencies go as the square root of Young's modulus.
  const double before =
      find("--set robot.flexible.beam.material.youngs_modulus=1e10");
  const double after =
      find("--set robot.flexible.beam.material.youngs_modulus=4e10");
  EXPECT_NEAR(after, 2.0 * before, 1e-6 * before);
}

TEST(Settings, AreInTheScenarioThatACompareChooses) {
  const Workspace place;
  place.write("a.toml", make_scenario(1.0, 0.02));
  const CommandResult result = place.limber(
      "compare a.toml --fidelity uncoupled,coupled --repeat 1 --tolerance 50% "
      "--out c --set load.push.force.2=-200 --set time.duration=0.01 --set "
      "robot.flexible.beam.material.youngs_modulus=4e10");
  ASSERT_EQ(result.status, 0) << result.errors;
  const std::string chosen = read_text(place.folder() / "c/chosen.toml");
  EXPECT_THAT(chosen, HasSubstr("-200"));
  EXPECT_THAT(chosen, HasSubstr("duration = 0.01"));
  EXPECT_THAT(chosen, HasSubstr("# Run it with --set robot.flexible.beam"));
}

TEST(Settings, AreRefusedByEveryCommandIfTheirPathIsUnknown) {
  const Workspace place;
  place.write("a.toml", make_scenario(1.0, 0.02));
  for (const char* command :
       {"run", "compare", "static", "frequencies", "advise"}) {
    const CommandResult result = place.limber(
        std::string(command) + " a.toml --set load.pusch.force.2=1");
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_THAT(result.errors, HasSubstr("--set load.pusch.force.2=1"));
    EXPECT_THAT(result.errors, HasSubstr("did you mean 'push'?"));
  }
}

TEST(Settings, OfARobotWithoutEffectAreTold) {
  const Workspace place;
  place.write("robot.urdf",
              "<robot name='r'><link name='world'/><link name='arm'><inertial>"
              "<mass value='2'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
              "ixz='0' iyz='0'/></inertial></link><joint name='hinge' "
              "type='revolute'><parent link='world'/><child link='arm'/>"
              "<axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='5' "
              "velocity='5'/></joint></robot>");
  place.write("s.toml",
              "robot = 'robot.urdf'\n[time]\nduration = 0.01\nstep = 1e-3\n"
              "[output]\npictures = false\n");
  const std::string text =
      "--set robot.joint.hinge.limit.effort=9 changes nothing: it limits "
      "drives, and no [[drive]] acts on it";
  const CommandResult told =
      place.limber("run s.toml --out a --set robot.joint.hinge.limit.effort=9");
  EXPECT_EQ(told.status, 0) << told.errors;
  EXPECT_THAT(told.errors, HasSubstr(text));
  EXPECT_THAT(read_text(place.folder() / "a/summary.json"), HasSubstr(text));
  const CommandResult acts =
      place.limber("run s.toml --out b --set robot.joint.hinge.limit.upper=2");
  EXPECT_EQ(acts.status, 0);
  EXPECT_EQ(acts.errors, "");
}

}  // namespace
}  // namespace limber::test::settings_test

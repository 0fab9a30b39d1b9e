// SPDX-License-Identifier: BSD-3-Clause
// What a checkpoint is refused for, and a run that cannot leave one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/run_summary.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::resume_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const char* const kRobot = R"(<robot name='r'><link name='world'/>
<link name='sled'><inertial><mass value='3'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='rail' type='prismatic'><parent link='world'/><child link='sled'/>
  <axis xyz='1 0 0'/><dynamics damping='0.1'/>
  <limit lower='-9' upper='9' effort='0' velocity='0'/></joint>
<spring name='coil' stiffness='10' free_length='1'>
  <from link='world' point='-1 0 0'/><to link='sled'/></spring></robot>)";

std::string make_scenario(const std::string& time) {
  return "robot = 'robot.urdf'\n[time]\n" + time +
         "output_interval = 0.01\n[initial.joints]\nrail = { position = 0.1 }\n"
         "[[load]]\nname = 'push'\nlink = 'sled'\nforce = [1, 0, 0]\n"
         "time = { kind = 'sinusoid', frequency = 2 }\n"
         "[[probe]]\nname = 'sled'\nlink = 'sled'\n"
         "[output]\npictures = false\n";
}

void replace(std::string& text, const std::string& old, const std::string& by) {
  ASSERT_NE(text.find(old), std::string::npos);
  text.replace(text.find(old), old.size(), by);
}

/// Runs s.toml into out/ and kills it when its first checkpoint is there.
void kill_run(const Workspace& place) {
  const CommandResult result = run_shell(
      place,
      "'" LIMBER_COMMAND
      "' run s.toml --out out --checkpoint-interval 0 >run.txt 2>&1 & "
      "pid=$!; while kill -0 $pid 2>/dev/null && [ ! -e out/checkpoint.bin ];"
      " do sleep 0.01; done; kill -9 $pid");
  ASSERT_EQ(result.status, 0) << result.errors;
  ASSERT_TRUE(fs::exists(place.folder() / "out/checkpoint.bin"));
}

/// A folder with the checkpoint of a run that was killed.
class KilledRunOfASled : public ::testing::Test {
 protected:
  KilledRunOfASled() {
    place_.write("robot.urdf", robot_);
    place_.write("s.toml", scenario_);
    kill_run(place_);
  }

  void expect_refused(const std::string& robot, const std::string& scenario,
                      const std::string& text) {
    place_.write("robot.urdf", robot);
    place_.write("s.toml", scenario);
    const CommandResult result = place_.limber("run s.toml --out out --resume");
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.errors, HasSubstr("belongs to another run"));
    EXPECT_THAT(result.errors, HasSubstr(text));
    EXPECT_THAT(result.errors, HasSubstr("run without --resume"));
  }

  Workspace place_;
  std::string robot_ = kRobot;
  std::string scenario_ = make_scenario("duration = 200\nstep = 1e-4\n");
};

TEST_F(KilledRunOfASled, IsNotGoneOnFromWithAnotherSpring) {
  std::string robot = robot_;
  replace(robot, "stiffness='10'", "stiffness='100'");
  expect_refused(robot, scenario_,
                 "coupler 'coil', spring, stiffness: 10 -> 100 N/m");
}

TEST_F(KilledRunOfASled, IsNotGoneOnFromWithAnotherDampingOrLoad) {
  std::string robot = robot_;
  replace(robot, "damping='0.1'", "damping='0.2'");
  expect_refused(robot, scenario_, "coupler 'rail', joint");
  std::string scenario = scenario_;
  replace(scenario, "frequency = 2", "frequency = 3");
  expect_refused(robot_, scenario,
                 "load 'push', sinusoid, frequency: 2 -> 3 Hz");
}

TEST_F(KilledRunOfASled, IsNotGoneOnFromWithOtherSettings) {
  for (const char* option :
       {"--set load.push.time.frequency=3", "--set time.rho_inf=0.5",
        "--set robot.spring.coil.stiffness=100"}) {
    const CommandResult result =
        place_.limber(std::string("run s.toml --out out --resume ") + option);
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.errors, HasSubstr("belongs to another run"));
  }
}

TEST_F(KilledRunOfASled, IsNotGoneOnFromWithOtherProbes) {
  std::string scenario = scenario_;
  replace(scenario, "[[probe]]\nname = 'sled'", "[[probe]]\nname = 'other'");
  expect_refused(robot_, scenario,
                 "probe 'other' is new; probe 'sled' is gone");
}

/// The command with another build-id, as other sources would give it.
fs::path rebuild(const Workspace& place) {
  std::string program = read_text(LIMBER_COMMAND);
  const std::string note("\x04\0\0\0\x14\0\0\0\x03\0\0\0GNU\0", 16);
  const auto at = program.find(note);
  EXPECT_NE(at, std::string::npos);
  program[at + note.size()] ^= 1;
  place.write("limber", program);
  fs::permissions(place.folder() / "limber", fs::perms::owner_all);
  return place.folder() / "limber";
}

TEST_F(KilledRunOfASled, IsNotGoneOnFromByAProgramThatWasRebuilt) {
  const fs::path other = rebuild(place_);
  const CommandResult refused = run_shell(place_, "'" + other.string() +
                                                      "' run s.toml --out out "
                                                      "--resume");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("build of Limber: "));
  EXPECT_THAT(refused.errors, HasSubstr("run without --resume"));
}

TEST_F(KilledRunOfASled, IsReportedByInfo) {
  const CommandResult result = place_.limber("info out/checkpoint.bin");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("checkpoint"));
}

TEST_F(KilledRunOfASled, LeavesItsProbesUntilTheCheckpoint) {
  ASSERT_EQ(place_.limber("export out/checkpoint.bin -o part.csv").status, 0);
  ASSERT_EQ(
      place_.limber("run s.toml --out whole --set time.duration=5").status, 0);
  const std::string part = read_text(place_.folder() / "part.csv");
  const std::string whole = read_text(place_.folder() / "whole/probes.csv");
  EXPECT_GE(std::count(part.begin(), part.end(), '\n'), 4);
  EXPECT_TRUE(whole.starts_with(part));
  const CommandResult other =
      place_.limber("export out/checkpoint.bin -o part.glb");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.errors, HasSubstr("of a checkpoint the probes are"));
}

// It starts far beyond linear elasticity, and swings.
TEST(ResumedRun, HasTheSummaryOfOneThatWasNotKilled) {
  const Workspace place;
  place.write("s.toml",
              "robot = '" LIMBER_SOURCE_DIR
              "/models/beam.urdf'\n[time]\nduration = 0.15\nstep = 1e-5\n"
              "output_interval = 1e-3\n[output]\npictures = false\n"
              "[initial.links]\nbeam = { modes = { position = [60] } }\n"
              "[[probe]]\nname = 'p'\nlink = 'beam'\nnode = 1\n");
  ASSERT_EQ(place.limber("run s.toml --out whole").status, 0);
  ASSERT_NO_FATAL_FAILURE(kill_run(place));
  ASSERT_EQ(place.limber("run s.toml --out out --resume").status, 0);
  const nlohmann::json whole = read_summary(place.folder() / "whole");
  EXPECT_THAT(whole["warnings"].dump(), HasSubstr("beyond 10 %"));
  EXPECT_EQ(read_summary(place.folder() / "out"), whole);
}

// What the folder lacked is no property of the run.
TEST(ResumedRun, WithoutACheckpointHasTheSummaryOfAWholeOne) {
  const Workspace place;
  place.write("robot.urdf", kRobot);
  place.write("s.toml", make_scenario("duration = 0.1\nstep = 1e-3\n"));
  ASSERT_EQ(place.limber("run s.toml --out whole").status, 0);
  const CommandResult result = place.limber("run s.toml --out out --resume");
  ASSERT_EQ(result.status, 0);
  EXPECT_THAT(result.errors, HasSubstr("there is no checkpoint"));
  EXPECT_EQ(read_summary(place.folder() / "out"),
            read_summary(place.folder() / "whole"));
}

TEST(RunThatCannotLeaveCheckpoints, WarnsOnceAndGoesOn) {
  const Workspace place;
  place.write("robot.urdf", kRobot);
  place.write("s.toml", make_scenario("duration = 0.2\nstep = 1e-4\n"));
  fs::create_directories(place.folder() / "out/checkpoint.bin/in the way");
  const CommandResult result =
      place.limber("run s.toml --out out --checkpoint-interval 0");
  EXPECT_EQ(result.status, 0);
  const std::string warning = "no checkpoint at t = 0.0256 s";
  EXPECT_THAT(result.errors, HasSubstr(warning));
  const auto first = result.errors.find("no checkpoint");
  EXPECT_EQ(result.errors.find("no checkpoint", first + 1), std::string::npos);
  EXPECT_THAT(read_text(place.folder() / "out/summary.json"),
              HasSubstr(warning));
}

TEST(StepsTooShortToBeCounted, AreRefused) {
  const Workspace place;
  place.write("robot.urdf", kRobot);
  place.write("s.toml", make_scenario("duration = 1\nstep = 1e-22\n"));
  const CommandResult result = place.limber("run s.toml");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("step 1e-22 s needs 1e+22 steps until 1 "
                                       "s; at most 1e+12 are possible"));
}

TEST(TwoRunsOfOneScene, LeaveTheSameResultsToTheByte) {
  const Workspace place;
  place.write("robot.urdf", kRobot);
  place.write("s.toml", make_scenario("duration = 0.1\nstep = 1e-3\n"));
  ASSERT_EQ(place.limber("run s.toml --out a").status, 0);
  ASSERT_EQ(std::system("sleep 1.1"), 0);
  ASSERT_EQ(place.limber("run s.toml --out b").status, 0);
  EXPECT_TRUE(read_text(place.folder() / "a/results.h5") ==
              read_text(place.folder() / "b/results.h5"));
}

}  // namespace
}  // namespace limber::test::resume_test

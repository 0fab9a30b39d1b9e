// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scenario_reader.hpp"

#include <gmock/gmock.h>

#include "unit/scene/temporary_file.hpp"

namespace limber::scene {
namespace {

using test::input_error;
using test::TemporaryFile;
using testing::HasSubstr;

const std::string kStart =
    "robot = \"r.urdf\"\n[time]\nduration = 1.0\nstep = 0.1\n";

Scenario read(const std::string& text) {
  const TemporaryFile file("scenario.toml", text);
  return read_scenario(file.path());
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)read(text); });
}

TEST(ScenarioReader, FillsInDefaults) {
  const Scenario scenario = read(kStart);
  EXPECT_EQ(scenario.fidelity, dynamics::Fidelity::coupled);
  EXPECT_EQ(scenario.settings.output_times.size(), 11U);
  EXPECT_EQ(scenario.settings.output_times.back(), 1.0);
  EXPECT_EQ(scenario.robot.filename(), "r.urdf");
}

TEST(ScenarioReader, ReadsLoadsAndProbes) {
  const Scenario scenario =
      read(kStart +
           "[[load]]\nname='l'\nlink='a'\ngroup='tip'\ndistribution='equal'\n"
           "force=[1,2.5,3]\nframe='world'\n"
           "time={kind='pulse',shape='half-sine',start=0.1,duration=0.2}\n"
           "[[probe]]\nname='p'\nlink='a'\nnode=7\nquantity='velocity'\n");
  EXPECT_EQ(scenario.loads.at(0).force, Vector3(1, 2.5, 3));
  EXPECT_EQ(scenario.loads[0].frame, dynamics::LoadFrame::world);
  const auto& pulse = std::get<dynamics::Pulse>(scenario.loads[0].time);
  EXPECT_EQ(pulse.shape, dynamics::PulseShape::half_sine);
  EXPECT_EQ(scenario.probes.at(0).quantity, Quantity::velocity);
}

TEST(ScenarioReader, ReadsInitialStateAndLevels) {
  const Scenario scenario = read(
      kStart +
      "[fidelity]\ndefault='rigid'\nlinks={a='one-way'}\n"
      "[initial.joints]\nj={position=0.5,velocity=[2]}\n"
      "[initial.base]\nposition=[1,0,0]\n[gravity]\nacceleration=[0,0,-9.81]");
  EXPECT_EQ(scenario.fidelity_of_link.at("a"), dynamics::Fidelity::one_way);
  EXPECT_EQ(scenario.joints.at("j").position.at(0), 0.5);
  EXPECT_EQ(scenario.base.position, Vector3::UnitX());
  EXPECT_EQ(scenario.gravity.z(), -9.81);
}

TEST(ScenarioReader, NamesTheNearestKeyAndItsLine) {
  const std::string text = error_of(kStart + "rho_info = 0.5\n");
  EXPECT_THAT(text, HasSubstr("scenario.toml:5"));
  EXPECT_THAT(text, HasSubstr("did you mean 'rho_inf'"));
}

TEST(ScenarioReader, TellsEveryProblemAtOnce) {
  const std::string text = error_of(
      "robot = 3\n[time]\nduration = 0.0\nstep = '1 ms'\n[[load]]\nname='l'\n");
  EXPECT_THAT(text, HasSubstr("robot: expected a string, got integer"));
  EXPECT_THAT(text, HasSubstr("time.duration: is 0; expected a number > 0"));
  EXPECT_THAT(text, HasSubstr("time.step: expected a number > 0, got string"));
  EXPECT_THAT(text, HasSubstr("needs 'link'"));
}

TEST(ScenarioReader, RefusesBrokenToml) {
  EXPECT_THAT(error_of("robot = \n"), HasSubstr("scenario.toml:1"));
  EXPECT_THAT(input_error([] { (void)read_scenario("/no/such.toml"); }),
              HasSubstr("/no/such.toml"));
}

TEST(ScenarioReader, RefusesOutputTimesOutsideTheRun) {
  EXPECT_THAT(error_of(kStart + "output_times=[0.0, 2.0]\n"),
              HasSubstr("output_times"));
  EXPECT_THAT(error_of(kStart + "output_times=[0.5, 0.1]\n"),
              HasSubstr("must increase"));
}

}  // namespace
}  // namespace limber::scene

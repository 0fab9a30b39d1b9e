// SPDX-License-Identifier: BSD-3-Clause
// Controllers of scenarios.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/command.hpp"
#include "cli/finger.hpp"
#include "cli/shell.hpp"

namespace limber::test::controller_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kInertia = 0.4;
constexpr double kPeriod = 0.02;
constexpr double kP = 3.0;
constexpr double kD = 1.2;

const char* const kRobot = R"(<robot name='r'><link name='world'/>
<link name='rotor'><inertial><mass value='2'/><inertia ixx='0.3' iyy='0.3'
  izz='0.4' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='hinge' type='continuous'><parent link='world'/>
  <child link='rotor'/><axis xyz='0 0 1'/></joint></robot>)";

const char* const kScenario = R"(robot = 'robot.urdf'
[time]
duration = 1.0
step = 0.001
integrator = 'runge-kutta-4'
output_interval = 0.02
[output]
pictures = false
[initial.joints]
hinge = { position = 0.5 }
[[drive]]
joint = 'hinge'
mode = 'effort'
signal = { kind = 'input', controller = 'pd' }
[[controller]]
name = 'pd'
period = 0.02
measures = 'angle.q'
rate = 'speed.qdot'
proportional = 3.0
derivative = 1.2
[[probe]]
name = 'angle'
coupler = 'hinge'
quantity = 'coordinate'
[[probe]]
name = 'speed'
coupler = 'hinge'
quantity = 'coordinate_rate'
[[probe]]
name = 'torque'
controller = 'pd'
)";

class AController : public ::testing::Test {
 protected:
  AController() { place_.write("robot.urdf", kRobot); }

  json run(const std::string& options = "") {
    place_.write("s.toml", text_);
    const CommandResult result =
        place_.limber("run s.toml --out o --json " + options);
    EXPECT_EQ(result.status, 0) << result.errors;
    errors_ = result.errors;
    return json::parse(result.out, nullptr, false);
  }

  double find_final(const std::string& column,
                    const std::string& options = "") {
    return run(options)["probes"][column]["final"].get<double>();
  }

  void expect_refused(const std::string& old, const std::string& by,
                      const std::string& words) {
    std::string text = kScenario;
    ASSERT_NE(text.find(old), std::string::npos) << old;
    place_.write("s.toml", text.replace(text.find(old), old.size(), by));
    const CommandResult result = place_.limber("run s.toml --out o");
    EXPECT_EQ(result.status, 2) << by;
    EXPECT_THAT(result.errors, HasSubstr(words));
  }

  std::string text_ = kScenario;
  std::string errors_;
  Workspace place_;
};

// Between samples the torque is constant: the sampled double integrator
// (Astrom, Wittenmark 1997, example 2.1).
TEST_F(AController, OfPdLetsARotorMoveAsTheSampledDoubleIntegrator) {
  double q = 0.5;
  double v = 0.0;
  double u = 0.0;
  for (int k = 0; k < 50; ++k) {
    u = -kP * q - kD * v;
    q += kPeriod * v + 0.5 * kPeriod * kPeriod * u / kInertia;
    v += kPeriod * u / kInertia;
  }
  EXPECT_GT(std::abs(q), 1e-3);
  const json probes = run()["probes"];
  EXPECT_NEAR(probes["angle.q"]["final"].get<double>(), q, 1e-11);
  EXPECT_NEAR(probes["speed.qdot"]["final"].get<double>(), v, 1e-11);
  EXPECT_NEAR(probes["torque.u"]["final"].get<double>(), -kP * q - kD * v,
              1e-10);
}

TEST_F(AController, WithAnIntegralHoldsAgainstAConstantMoment) {
  const json probes =
      run("--set time.duration=60 --set time.step=0.02 "
          "--set time.integrator=generalized-alpha "
          "--set controller.pd.integral=4 --set controller.pd.reference=0.3 "
          "--set load='[{name=\"wind\",link=\"rotor\",moment=[0,0,0.7]}]'")
          ["probes"];
  EXPECT_NEAR(probes["angle.q"]["final"].get<double>(), 0.3, 1e-9);
  EXPECT_NEAR(probes["torque.u"]["final"].get<double>(), -0.7, 1e-9);
}

// A load that follows the controller turns the free rotor as the drive did.
TEST_F(AController, MovesALoadAsItMovesADrive) {
  const double driven = find_final("angle.q");
  const std::size_t at = text_.find("[[drive]]");
  text_.replace(at, text_.find("[[controller]]") - at,
                "[[load]]\nname = 'turn'\nlink = 'rotor'\n"
                "moment = [0.0, 0.0, 2.0]\ntime = { kind = 'input', "
                "controller = 'pd', factor = 0.5 }\n");
  EXPECT_NEAR(find_final("angle.q"), driven, 1e-12);
}

TEST_F(AController, GivesAnotherAnswerWithAnyOfItsKeysChanged) {
  const double original = find_final("angle.q");
  for (const char* change :
       {"proportional=2", "derivative=1", "integral=1", "period=0.01",
        "offset=0.005", "filter=0.05", "delay=0.04", "limits=[-1,1]",
        "reference=0.1", "hold=linear", "measures=speed.qdot",
        "reference.kind=constant --set controller.pd.reference.value=0.1"}) {
    EXPECT_GT(
        std::abs(find_final("angle.q",
                            std::string("--set controller.pd.") + change) -
                 original),
        1e-6)
        << change;
  }
  EXPECT_GT(std::abs(find_final("angle.q",
                                "--set controller.pd.delay=0.04 "
                                "--set controller.pd.initial=-1") -
                     find_final("angle.q", "--set controller.pd.delay=0.04")),
            1e-6);
  EXPECT_GT(std::abs(find_final("angle.q", "--set drive.0.signal.factor=0.5") -
                     original),
            1e-6);
  EXPECT_GT(
      std::abs(find_final("angle.q", "--unset controller.pd.rate") - original),
      1e-6);
}

TEST_F(AController, ThatNothingFollowsIsTold) {
  const std::size_t at = text_.find("[[drive]]");
  text_.erase(at, text_.find("[[controller]]") - at);
  text_.erase(text_.find("[[probe]]\nname = 'torque'"));
  (void)run();
  EXPECT_THAT(errors_, HasSubstr("controller 'pd' changes nothing"));
  text_ = kScenario;
  (void)run();
  EXPECT_THAT(errors_, Not(HasSubstr("changes nothing")));
}

TEST_F(AController, IsRefusedBeforeTheRunWithWhatIsWrong) {
  expect_refused("controller = 'pd' }", "controller = 'pdd' }", "'pdd'");
  expect_refused("controller = 'pd'\n", "controller = 'dp'\n", "'dp'");
  expect_refused(", controller = 'pd' }", " }", "controller");
  expect_refused("'angle.q'", "'angle.x'", "angle.q");
  expect_refused("'angle.q'", "'angel.q'", "'angle'");
  expect_refused("'angle.q'", "'angle'", "PROBE.COLUMN");
  expect_refused("period = 0.02", "period = 0.0", "period");
  expect_refused("period = 0.02", "", "period");
  expect_refused("period = 0.02", "period = 1e-9", "samples");
  expect_refused("proportional = 3.0\nderivative = 1.2", "", "no gain");
  expect_refused("proportional = 3.0", "proportional = nan", "proportional");
  expect_refused("proportional = 3.0", "delay = 0.03", "whole number");
  expect_refused("proportional = 3.0", "limits = [1.0, -1.0]", "limits");
  expect_refused("proportional = 3.0", "limits = [1.0]", "limits");
  expect_refused("proportional = 3.0", "limits = [1.0, 2.0]", "initial");
  expect_refused("proportional = 3.0", "filter = -1.0", "filter");
  expect_refused("proportional = 3.0", "hold = 'loose'", "hold");
  expect_refused("proportional = 3.0", "gain = 3.0", "gain");
  expect_refused("proportional = 3.0", "reference = { kind = 'wave' }", "wave");
  expect_refused("proportional = 3.0",
                 "reference = { kind = 'constant', value = 1.0, extra = 2 }",
                 "extra");
  expect_refused("name = 'pd'", "name = 'pd'\nname = 'pe'", "name");
  expect_refused("[[probe]]\nname = 'angle'",
                 "[[controller]]\nname = 'pd'\nperiod = 0.1\nmeasures = "
                 "'angle.q'\nproportional = 1.0\n[[probe]]\nname = 'angle'",
                 "given twice");
}

TEST_F(AController, WhoseLoopIsUnstableHasTheSameWarningInACheck) {
  const std::string gains =
      "--set controller.pd.proportional=300 --set "
      "controller.pd.derivative=100 ";
  const json wild = run(gains);
  const std::vector<std::string> warnings =
      wild["warnings"].get<std::vector<std::string>>();
  const auto unstable = std::find_if(
      warnings.begin(), warnings.end(), [](const std::string& text) {
        return text.find("the sampled loop is unstable") != std::string::npos;
      });
  ASSERT_NE(unstable, warnings.end());
  const CommandResult check = place_.limber("check s.toml --json " + gains);
  const json found = json::parse(check.out, nullptr, false);
  EXPECT_THAT(found["warnings"].get<std::vector<std::string>>(),
              ::testing::Contains(*unstable));
  EXPECT_EQ(found["sample_periods"]["pd"], kPeriod);
}

TEST_F(AController, WhoseLoopIsUnstableIsNamedAfterQuestionsAboutValues) {
  text_ += "[gravity]\nacceleration = [0.0, 0.0, -9810.0]\n";
  (void)run(
      "--set controller.pd.proportional=-3 --set controller.pd.derivative=-1");
  ASSERT_THAT(errors_, HasSubstr("is it in m/s^2"));
  ASSERT_THAT(errors_, HasSubstr("unstable"));
  EXPECT_LT(errors_.find("is it in m/s^2"), errors_.find("unstable"));
}

TEST_F(AController, CutsTheStepsOfACheckAtItsSamples) {
  place_.write("s.toml", text_);
  EXPECT_THAT(place_.limber("check s.toml").out,
              HasSubstr("steps end at samples of controller 'pd', every 0.02 "
                        "s\n"));
  EXPECT_THAT(place_.limber("check s.toml --set controller.pd.period=5e-4").out,
              HasSubstr("every 0.0005 s: none is longer"));
}

// The loop is stable if and only if T < 2 I / kd = 8 ms (Jury's criterion); of
// the halves of 20 ms the first one below is 5 ms.
TEST_F(AController, OfAnUnstableLoopIsNamedWithAPeriodThatIsStable) {
  const std::string gains =
      "--set controller.pd.proportional=300 --set controller.pd.derivative=100 "
      "--set controller.pd.limits=[-5,5] --set time.output_interval=0.1 ";
  const json wild = run(gains);
  EXPECT_THAT(errors_, HasSubstr("controller 'pd' (joint 'hinge', period 0.02 "
                                 "s): the sampled loop is unstable at 25 Hz"));
  EXPECT_THAT(errors_, HasSubstr("with a period of 0.005 s it is stable"));
  EXPECT_THAT(errors_,
              HasSubstr("its output alternates between its limits, -5 and 5"));
  const json calm =
      run(gains + "--set controller.pd.period=0.005 --set time.duration=5");
  EXPECT_THAT(errors_, Not(HasSubstr("unstable")));
  EXPECT_LT(std::abs(calm["probes"]["angle.q"]["final"].get<double>()), 1e-5);
  (void)run(gains + "--set controller.pd.period=0.0079");
  EXPECT_THAT(errors_, Not(HasSubstr("unstable")));
  (void)run(gains + "--set controller.pd.period=0.0081");
  EXPECT_THAT(errors_, HasSubstr("unstable"));
}

TEST_F(AController, WithAWrongSignIsUnstableAtEveryPeriod) {
  (void)run(
      "--set controller.pd.proportional=-3 --set controller.pd.derivative=-1");
  EXPECT_THAT(errors_, HasSubstr("makes it stable: check the signs and sizes"));
}

/// A servo of the angle of a flexible finger, whose rate it takes by
/// differences.
std::string make_finger_scene(const char* step, const char* more) {
  return fmt::format(R"(robot = "claw.urdf"
[time]
duration = 0.1
step = {}
output_interval = 5e-4
[output]
pictures = false
[initial.joints]
hinge = {{ position = 0.299 }}
[[probe]]
name = "angle"
joint = "hinge"
[[probe]]
name = "torque"
controller = "servo"
[[controller]]
name = "servo"
period = 5e-4
measures = "angle.q"
reference = 0.3
proportional = 20.0
derivative = 1.0
limits = [-3, 3]
{}
[[drive]]
joint = "hinge"
mode = "effort"
signal = {{ kind = "input", controller = "servo" }}
)",
                     step, more);
}

class AServoOfAFinger : public ::testing::Test {
 protected:
  AServoOfAFinger() {
    place_.write("finger.geo", kFingerGeometry);
    place_.write("claw.urdf", kFinger);
  }

  /// The last torque, and what is told.
  double run(const char* step, const char* more = "") {
    place_.write("s.toml", make_finger_scene(step, more));
    const CommandResult result =
        place_.limber("run s.toml --json --cache cache --out o");
    EXPECT_EQ(result.status, 0) << result.errors;
    errors_ = result.errors;
    return json::parse(result.out)["probes"]["torque.u"]["peak"].get<double>();
  }

  Workspace place_;
  std::string errors_;
};

// Modes that the steps do not resolve have a wrong phase at the samples, which
// makes them vibrate at single steps and not at shorter or longer ones.
TEST_F(AServoOfAFinger, ThatVibratesByErrorsOfTheStepsIsTold) {
  const double exact = std::abs(run("5e-6"));
  EXPECT_THAT(errors_, Not(HasSubstr("with a step of")));
  EXPECT_LT(exact, 1.0);
  const double vibrating = std::abs(run("2e-5"));
  EXPECT_GT(vibrating, 2.5);
  EXPECT_THAT(errors_, HasSubstr("with a step of 2e-05 s the sampled loop "
                                 "vibrates at"));
}

TEST_F(AServoOfAFinger, ThatNoPeriodMakesStableGetsAFilterThatDoes) {
  run("1e-4", "");
  EXPECT_THAT(errors_, Not(HasSubstr("stable")));  // not within the run
  place_.write("s.toml", make_finger_scene("1e-4", ""));
  const CommandResult longer = place_.limber(
      "run s.toml --json --cache cache --out o --set time.duration=0.5");
  EXPECT_THAT(longer.errors, HasSubstr("the sampled loop is unstable at"));
  const std::string word = "but filter = ";
  const std::size_t at = longer.errors.find(word);
  ASSERT_NE(at, std::string::npos) << longer.errors;
  const std::string filter =
      "filter = " +
      std::to_string(std::stod(longer.errors.substr(at + word.size())));
  place_.write("s.toml", make_finger_scene("1e-4", filter.c_str()));
  EXPECT_THAT(place_
                  .limber("run s.toml --json --cache cache --out o --set "
                          "time.duration=0.5")
                  .errors,
              Not(HasSubstr("loop is unstable")));
}

TEST_F(AController, ThatChangedIsNamedWhenARunIsResumed) {
  text_.replace(text_.find("duration = 1.0"), 14, "duration = 4000.0");
  place_.write("s.toml", text_);
  RunningCommand run(place_, "run s.toml --out o");
  ASSERT_TRUE(wait_for(place_, "o/.limber-lock"));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  run.send(SIGINT);
  ASSERT_EQ(run.wait().status, 130);
  const CommandResult resumed = place_.limber(
      "run s.toml --out o --resume --set controller.pd.proportional=4");
  EXPECT_EQ(resumed.status, 2);
  EXPECT_THAT(resumed.errors, HasSubstr("proportional: 3"));
}

}  // namespace
}  // namespace limber::test::controller_test

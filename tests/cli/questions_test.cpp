// SPDX-License-Identifier: BSD-3-Clause
// Questions about values of scenarios and robots that hardly anyone means,
// which run and check ask alike.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::questions_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kInertia =
    "<inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/>";

/// An arm on a hinge.
void write_robot(const Workspace& place, const std::string& limit = "",
                 const std::string& in_arm = "", const std::string& more = "") {
  place.write(
      "arm.urdf",
      fmt::format("<robot name='r'><link name='world'/><link "
                  "name='arm'><inertial><mass value='0.5'/>{}"
                  "</inertial>{}</link><joint name='hinge' type='{}'>"
                  "<parent link='world'/><child link='arm'/>"
                  "<axis xyz='0 0 1'/>{}</joint>{}</robot>",
                  kInertia, in_arm, limit.empty() ? "continuous" : "revolute",
                  limit, more));
}

std::string make_collision(const std::string& shape,
                           const std::string& rpy = "0 0 0") {
  return fmt::format(
      "<collision><origin rpy='{}'/><geometry>{}</geometry></collision>", rpy,
      shape);
}

/// Warnings of check; expects that run prints the same.
std::string ask(const Workspace& place, const std::string& scenario,
                const std::string& time = "output_interval = 0.01\n") {
  place.write("s.toml",
              "robot = 'arm.urdf'\n[output]\npictures = false\n"
              "[time]\nduration = 0.05\nstep = 1e-3\n" +
                  time + scenario);
  const CommandResult check = place.limber("check s.toml --json");
  EXPECT_EQ(check.status, 0) << check.errors;
  const json found = json::parse(check.out, nullptr, false);
  const CommandResult run = place.limber("run s.toml --out o");
  EXPECT_EQ(run.status, 0) << run.errors;
  std::string warnings;
  for (const json& text : found["warnings"]) {
    EXPECT_THAT(run.errors, HasSubstr(text.get<std::string>()));
    warnings += text.get<std::string>() + "\n";
  }
  return warnings;
}

const std::string kProbe =
    "[[probe]]\nname = 'angle'\ncoupler = 'hinge'\n"
    "quantity = 'coordinate'\n";

std::string make_controller(const std::string& lines) {
  return "[[drive]]\nname = 'motor'\njoint = 'hinge'\nmode = 'effort'\n"
         "max_effort = 2.0\nsignal = { kind = 'input', controller = 'pd', "
         "factor = 0.5 }\n[[controller]]\nname = 'pd'\nmeasures = 'angle.q'\n"
         "proportional = 0.1\nderivative = 0.1\n" +
         lines + kProbe;
}

TEST(Questions, AreAskedAboutAControllerSampledOnceInTheRun) {
  const Workspace place;
  write_robot(place);
  EXPECT_THAT(ask(place, make_controller("period = 2.0\n")),
              HasSubstr("'pd' has a period of 2 s, longer than the run of 0.05 "
                        "s"));
  EXPECT_EQ(ask(place, make_controller("period = 0.01\n")), "");
}

TEST(Questions, AreAskedAboutOutputsFurtherApartThanTheRunIsLong) {
  const Workspace place;
  write_robot(place);
  EXPECT_THAT(ask(place, kProbe, "output_interval = 1.0\n"),
              HasSubstr("output_interval, 1 s, is longer than the run of 0.05 "
                        "s"));
  EXPECT_EQ(ask(place, kProbe, "output_interval = 0.05\n"), "");
}

TEST(Questions, AreAskedAboutDegreesInAReference) {
  const Workspace place;
  write_robot(place);
  EXPECT_THAT(ask(place, make_controller("period = 0.01\nreference = 45.0\n")),
              HasSubstr("reference for joint 'hinge' of up to 45 rad, 7.2 "
                        "turns"));
  EXPECT_THAT(ask(place, make_controller("period = 0.01\nreference = { kind = "
                                         "'sine', amplitude = 0.1, frequency = "
                                         "1.0, phase = 90.0 }\n")),
              HasSubstr("the phase of its sine is 90 rad"));
}

TEST(Questions, AreAskedAboutDegreesThatADriveCommands) {
  const std::string drive =
      "[[drive]]\njoint = 'hinge'\nmode = 'position'\nstiffness = 1.0\n"
      "damping = 0.1\nsignal = { kind = 'ramp', to = 30.0, duration = 1.0 }\n" +
      kProbe;
  const Workspace place;
  write_robot(place, "<limit lower='-3' upper='3' effort='0' velocity='0'/>");
  EXPECT_THAT(ask(place, drive),
              HasSubstr("commands joint 'hinge' up to 30 rad, 4.8 turns"));
  write_robot(place, "<limit lower='-40' upper='40' effort='0' velocity='0'/>");
  EXPECT_EQ(ask(place, drive), "");  // a winch, for one
}

TEST(Questions, AreAskedWhereADriveSaturatesBeforeItsController) {
  const Workspace place;
  write_robot(place);
  EXPECT_THAT(
      ask(place, make_controller("period = 0.01\nlimits = [-10.0, 6.0]\n")),
      HasSubstr("ask drive 'motor' for 5 N m, and its max_effort is 2 N m"));
  EXPECT_EQ(ask(place, make_controller("period = 0.01\nlimits = [-4, 4]\n")),
            "");
}

TEST(Questions, AreAskedAboutMillimetresInARobot) {
  const Workspace place;
  write_robot(place, "", make_collision("<box size='60 10 10'/>"));
  EXPECT_THAT(ask(place, kProbe),
              HasSubstr("link 'arm' is 60 m long and has 0.5 kg"));
  write_robot(place, "", make_collision("<box size='12 0.1 0.1'/>"));
  EXPECT_EQ(ask(place, kProbe), "");  // a light boom
}

TEST(Questions, AreAskedAboutAStartThatIsWithinItsStopsAsDegrees) {
  const Workspace place;
  write_robot(place,
              "<limit lower='-1.5' upper='1.5' effort='0' velocity='0'/>");
  const auto start = [&](double angle) {
    return ask(place, fmt::format("[initial.joints]\nhinge = {{ position = {} "
                                  "}}\n{}",
                                  angle, kProbe));
  };
  EXPECT_THAT(start(5.0), HasSubstr("where 5 degrees are within it"));
  EXPECT_EQ(start(1.4), "");
}

TEST(Questions, AreAskedAboutACommandThatIsWithinItsStopsAsDegrees) {
  const Workspace place;
  write_robot(place,
              "<limit lower='-0.7' upper='0.6' effort='0' velocity='0'/>");
  const auto drive = [&](double to) {
    return ask(place,
               fmt::format("[[drive]]\njoint = 'hinge'\nmode = 'position'\n"
                           "stiffness = 1.0\ndamping = 0.1\nsignal = {{ kind "
                           "= 'ramp', to = {}, duration = 1.0 }}\n{}",
                           to, kProbe));
  };
  EXPECT_THAT(drive(5.0),
              HasSubstr("commands joint 'hinge' up to 5 rad, beyond its stop, "
                        "where 5 degrees are within it"));
  EXPECT_EQ(drive(0.8), "");  // presses against the stop
  EXPECT_THAT(ask(place, make_controller("period = 0.01\nreference = -4.0\n")),
              HasSubstr("reference for joint 'hinge' of up to -4 rad, beyond"));
}

TEST(Questions, AreAskedAboutDegreesInLimits) {
  const Workspace place;
  write_robot(place, "<limit lower='-40' upper='35' effort='0' velocity='0'/>");
  EXPECT_THAT(ask(place, kProbe),
              HasSubstr("joint 'hinge' has a stop at 40 rad, 6.4 turns"));
  write_robot(place, "<limit lower='-12' upper='12' effort='0' velocity='0'/>");
  EXPECT_EQ(ask(place, kProbe), "");
}

TEST(Questions, AreAskedAboutDegreesInOrientations) {
  const Workspace place;
  write_robot(place, "", make_collision("<sphere radius='0.1'/>", "0 0 90"));
  EXPECT_THAT(ask(place, kProbe),
              HasSubstr("link 'arm', <origin>: rpy=\"0 0 90\" has 90 rad, 14.3 "
                        "turns; is it in radians?"));
  write_robot(place, "",
              make_collision("<sphere radius='0.1'/>", "0 6.2832 0"));
  EXPECT_EQ(ask(place, kProbe), "");
  const std::string wall =
      "[[obstacle]]\nname = 'wall'\nshape = 'box'\nsize = [0.1, 0.1, 0.1]\n"
      "position = [0.0, 0.0, 2.0]\norientation_rpy = [0.0, -45.0, 0.0]\n";
  EXPECT_THAT(ask(place, wall + kProbe),
              HasSubstr("obstacle 'wall': orientation_rpy has 45 rad, 7.2"));
}

TEST(Questions, AreAskedAboutGramsInAMass) {
  const Workspace place;
  write_robot(place, "", make_collision("<sphere radius='0.01'/>"));
  EXPECT_THAT(ask(place, kProbe),
              HasSubstr("link 'arm' has 0.5 kg in shapes of 4.19e-06 m^3, "
                        "1.19e+05 kg/m^3; is its mass in kg?"));
  write_robot(place, "", make_collision("<box size='0.2 0.05 0.06'/>"));
  EXPECT_EQ(ask(place, kProbe), "");
  write_robot(place, "", make_collision("<sphere radius='0.05'/>"));
  EXPECT_THAT(ask(place, kProbe),
              HasSubstr("has a radius of gyration of 0.548 m in shapes of 0.1 "
                        "m; is its inertia in kg m^2?"));
}

TEST(Questions, AreAskedAboutAFrictionAboveThree) {
  const Workspace place;
  write_robot(place, "", make_collision("<sphere radius='0.1'/>"),
              "<contact link='arm' youngs_modulus='1e9' "
              "poisson_ratio='0.3'/>");
  const auto touch = [&](const char* friction) {
    return ask(place,
               fmt::format("[[projectile]]\nname = 'ball'\nradius = 0.1\nmass "
                           "= 1.0\nposition = [0.0, 0.0, 2.0]\n[[contact]]\n"
                           "between = ['arm', 'ball']\nrestitution = 0.5\n"
                           "friction = {}\n",
                           friction));
  };
  EXPECT_THAT(touch("30.0"), HasSubstr("has a friction of 30, more than"));
  EXPECT_EQ(touch("0.9"), "");
}

TEST(Questions, NameShapesThatNoContactNames) {
  const Workspace place;
  write_robot(place, "", make_collision("<sphere radius='0.1'/>"),
              "<contact link='arm' youngs_modulus='1e9' "
              "poisson_ratio='0.3'/>");
  const std::string ball =
      "[[projectile]]\nname = 'ball'\nradius = 0.1\nmass = 1.0\n"
      "position = [0.0, 0.0, 2.0]\n";
  const std::string warnings = ask(place, ball);
  EXPECT_THAT(warnings, HasSubstr("<contact> of link 'arm' changes nothing"));
  EXPECT_THAT(place.limber("check s.toml").out,
              HasSubstr("the shape of 'arm' (and of 1 more) has no effect"));
  const std::string contact =
      "[[contact]]\nbetween = ['arm', 'ball']\nfriction = 0.0\n"
      "restitution = 0.5\n";
  EXPECT_EQ(ask(place, ball + contact), "");
  EXPECT_THAT(place.limber("check s.toml").out,
              Not(HasSubstr("has no effect")));
}

TEST(Questions, AreNotAskedInExamples) {
  const Workspace place;
  for (const char* name : {"catch", "claw", "damped_slew", "slew", "spin_up"}) {
    const CommandResult check = place.limber(
        fmt::format("check '{}/examples/{}.toml'", LIMBER_SOURCE_DIR, name));
    EXPECT_EQ(check.status, 0) << check.errors;
    EXPECT_THAT(check.out, Not(HasSubstr("?"))) << name;
  }
}

TEST(Restitution, BeyondZeroToOneIsRefused) {
  const Workspace place;
  for (const char* value : {"1.2", "-0.1"}) {
    write_robot(place, "<limit lower='-1' upper='1' effort='0' velocity='0'/>",
                "",
                fmt::format("<coupler joint='hinge'><stop restitution='{}'/>"
                            "</coupler>",
                            value));
    place.write("s.toml",
                "robot = 'arm.urdf'\n[time]\nduration = 0.05\nstep = 1e-3\n");
    const CommandResult result = place.limber("run s.toml --out o");
    EXPECT_EQ(result.status, 2) << value;
    EXPECT_THAT(result.errors, HasSubstr("restitution"));
  }
}

}  // namespace
}  // namespace limber::test::questions_test
